/// @file
/// The policies that the driver knows by name. The first name of each list is the default.
#pragma once

#include "dovetail/distributed/improve_pieces.hpp"
#include "dovetail/improver/any_improver.hpp"
#include "dovetail/mesher/any_line_keeping_mesher.hpp"
#include "dovetail/mesher/any_mesher.hpp"
#include "dovetail/parallel/any_communicator.hpp"
#include "dovetail/parallel/any_executor.hpp"
#include "dovetail/partition/any_partitioner.hpp"
#include "dovetail/remesh/any_surface_mesher.hpp"
#include "dovetail/simplification/any_simplification_rule.hpp"

#include <optional>
#include <string>
#include <vector>

namespace dovetail::app {

/// How the domain becomes subdomains: a simplified background mesh is partitioned, the fine surface is
/// bisected, or a fine mesh of the whole is partitioned.
std::vector<std::string> decomposition_names();
inline constexpr const char* by_bisection = "bisection";
inline constexpr const char* by_fine_partition = "fine-partition";
std::vector<std::string> partitioner_names();
std::vector<std::string> simplifier_names();
/// Of meshers of elements of dimension D.
template <int D>
std::vector<std::string> mesher_names();
template <>
std::vector<std::string> mesher_names<2>();
template <>
std::vector<std::string> mesher_names<3>();
std::vector<std::string> surface_mesher_names();
std::vector<std::string> improver_names();
/// What is done to the pieces of ranks after redistribution by elements.
std::vector<std::string> improving_strategy_names();
std::vector<std::string> background_mesher_names();
std::vector<std::string> executor_names();
std::vector<std::string> builtin_model_names();

/// Each throws `command_line_error` listing the names when there is none such. An empty name means the
/// default. After a colon the name of a partitioner that draws at random may have a seed: "metis:2".
any_partitioner make_partitioner(const std::string& name);
/// Another angle than the rule's own: the least between interfaces, for D = 2 between lines. Also thrown
/// where the rule has none.
any_simplification_rule make_simplifier(const std::string& name, std::optional<double> dihedral_angle = {},
                                        int dimension = 3);
/// These two are named alike in both dimensions; also thrown for an improver that does not take elements of
/// D.
template <int D>
any_mesher<D> make_mesher(const std::string& name);
template <>
any_mesher<2> make_mesher(const std::string& name);
template <>
any_mesher<3> make_mesher(const std::string& name);
template <int D>
any_improver<D> make_improver(const std::string& name, const std::string& option = "--improver");
template <>
any_improver<2> make_improver(const std::string& name, const std::string& option);
template <>
any_improver<3> make_improver(const std::string& name, const std::string& option);
improving_strategy make_improving_strategy(const std::string& name);
any_surface_mesher make_surface_mesher(const std::string& name);
any_line_keeping_mesher make_background_mesher(const std::string& name);
/// Holds nothing for an empty name.
any_improver<3> make_background_improver(const std::string& name);

/// `workers`: 0 for as many as the machine has processors. Throws `command_line_error` also when a mesher of
/// these traits cannot run in this executor.
any_executor make_executor(const std::string& name, int workers, const std::string& mesher,
                           const mesher_traits& traits, const std::optional<any_communicator>& network = {});

} // namespace dovetail::app
