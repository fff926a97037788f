#include "policies.hpp"

#include "named_improver.hpp"
#include "named_policies.hpp"

#include "dovetail/adapters/metis.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/distributed/processes.hpp"
#include "dovetail/distributed/ranks.hpp"
#include "dovetail/experiments/baselines/ito_improvement.hpp"
#include "dovetail/experiments/baselines/loehner_improvement.hpp"
#include "dovetail/experiments/builtin_models.hpp"
#include "dovetail/improver/native.hpp"
#include "dovetail/mesher/native.hpp"
#include "dovetail/parallel/serial.hpp"
#include "dovetail/parallel/threads.hpp"
#include "dovetail/partition/all.hpp"
#include "dovetail/simplification/all.hpp"

#ifdef DOVETAIL_DRIVER_WITH_CGAL
#include "dovetail/adapters/cgal_improver.hpp"
#include "dovetail/adapters/cgal_mesh_3.hpp"
#endif
#ifdef DOVETAIL_DRIVER_WITH_GMSH
#include "dovetail/adapters/gmsh_delaunay.hpp"
#include "dovetail/adapters/gmsh_hxt.hpp"
#include "dovetail/adapters/gmsh_improver.hpp"
#endif
#ifdef DOVETAIL_DRIVER_WITH_NETGEN
#include "dovetail/adapters/netgen.hpp"
#include "dovetail/adapters/netgen_improver.hpp"
#endif
#ifdef DOVETAIL_DRIVER_WITH_SCOTCH
#include "dovetail/adapters/scotch.hpp"
#endif
#ifdef DOVETAIL_DRIVER_WITH_SPECTRA
#include "dovetail/adapters/spectral.hpp"
#endif
#ifdef DOVETAIL_DRIVER_WITH_TETGEN
#include "dovetail/adapters/tetgen.hpp"
#endif

#include <algorithm>
#include <charconv>
#include <system_error>
#include <thread>

namespace dovetail::app {
namespace {

std::string at_degrees(double angle) {
  return " at " + number_text(angle) + " degrees";
}

/// Calls `visit(name, partitioner)` for all that were built, the default first.
template <class Visit>
void for_each_partitioner(const Visit& visit) {
  visit("metis", partition::metis{});
  visit("metis-recursive", partition::metis{.recursive = true});
  for_each_policy(partition::all(), visit);
#ifdef DOVETAIL_DRIVER_WITH_SCOTCH
  visit("scotch", partition::scotch{});
#endif
#ifdef DOVETAIL_DRIVER_WITH_SPECTRA
  visit("spectral", partition::spectral{});
#endif
}

std::vector<any_partitioner> partitioners() {
  std::vector<any_partitioner> known;
  for_each_partitioner(
      [&](const char* name, const auto& partitioner) { known.emplace_back(partitioner, name); });
  return known;
}

/// Those that draw at random, from this seed, which is in their names.
std::vector<any_partitioner> seeded_partitioners(int seed) {
  std::vector<any_partitioner> known;
  for_each_partitioner([&](const std::string& name, auto partitioner) {
    if constexpr (requires { partitioner.seed; }) {
      partitioner.seed = static_cast<decltype(partitioner.seed)>(seed);
      known.emplace_back(partitioner, name + ':' + std::to_string(seed));
    }
  });
  return known;
}

std::vector<any_simplification_rule> simplifiers() {
  std::vector<any_simplification_rule> known;
  for_each_policy(simplifier::all(),
                  [&](const char* name, const auto& rule) { known.emplace_back(rule, name); });
  return known;
}

/// The rules that have an angle between interfaces, with this one in place of their own, named as it is
/// given: "paper at 40 degrees".
std::vector<any_simplification_rule> simplifiers_at(double angle, int dimension) {
  std::vector<any_simplification_rule> known;
  for_each_policy(simplifier::all(), [&](const std::string& name, auto rule) {
    if constexpr (requires { rule.volume_dihedral_deg; }) {
      (dimension == 2 ? rule.surface_dihedral_deg : rule.volume_dihedral_deg) = angle;
      known.emplace_back(rule, name + at_degrees(angle));
    }
  });
  return known;
}

/// What a mesher fails on, such as two parts that touch in an edge, the native one meshes, and then TetGen.
std::vector<any_mesher<3>> meshers() {
  const any_mesher<3> native(mesher::native{}, "native");
  std::vector<any_mesher<3>> known{native};
#ifdef DOVETAIL_DRIVER_WITH_GMSH
  known.push_back(any_mesher<3>(mesher::gmsh_hxt{}, "hxt").with_fallback(native));
  known.push_back(any_mesher<3>(mesher::gmsh_delaunay{}, "gmsh-delaunay").with_fallback(native));
#endif
#ifdef DOVETAIL_DRIVER_WITH_NETGEN
  known.push_back(any_mesher<3>(mesher::netgen{}, "netgen").with_fallback(native));
#endif
#ifdef DOVETAIL_DRIVER_WITH_TETGEN
  const any_mesher<3> tetgen(mesher::tetgen{}, "tetgen");
  for (any_mesher<3>& one : known)
    one = one.with_fallback(tetgen);
  known.insert(known.begin() + 1, tetgen);
#endif
  return known;
}

/// The driver measures meshes itself: what the improver counts for its report is shown nowhere.
improvement::native uncounted(improvement::native preset) {
  preset.statistics = false;
  return preset;
}

std::vector<named_improver> improvers() {
  std::vector<named_improver> known{
      {uncounted(improvement::native{}), "native"},     {uncounted(improvement::native::fast()), "fast"},
      {uncounted(improvement::native::fine()), "fine"}, {uncounted(improvement::native::finest()), "finest"},
      {uncounted(improvement::native::hard()), "hard"}, {improvement::none{}, "none"}};
#ifdef DOVETAIL_DRIVER_WITH_GMSH
  known.emplace_back(improvement::gmsh{}, "gmsh");
#endif
#ifdef DOVETAIL_DRIVER_WITH_NETGEN
  known.emplace_back(improvement::netgen{}, "netgen");
#endif
#ifdef DOVETAIL_DRIVER_WITH_CGAL
  // CGAL 5.5 flips some pieces without end; others take seconds. A piece beyond the limit stays as it was.
  known.emplace_back(improvement::cgal{.limit_seconds = 30}, "cgal");
#endif
  return known;
}

std::vector<any_line_keeping_mesher> background_meshers() {
  std::vector<any_line_keeping_mesher> known{any_line_keeping_mesher::none("native")};
#ifdef DOVETAIL_DRIVER_WITH_CGAL
  known.emplace_back(mesher::cgal_mesh_3{}, "cgal");
#endif
  return known;
}

/// A strategy with its name.
struct named_strategy {
  std::string known_as;
  improving_strategy improve;

  const std::string& name() const { return known_as; }
};

std::vector<named_strategy> improving_strategies() {
  return {{"pieces", improve_pieces},
          {"ito", baselines::ito_improvement{}},
          {"loehner", baselines::loehner_improvement{}},
          {"none", nullptr}};
}

} // namespace

std::vector<std::string> decomposition_names() {
  return {"simplification", by_bisection, by_fine_partition};
}
std::vector<std::string> partitioner_names() {
  return names_of(partitioners());
}
std::vector<std::string> simplifier_names() {
  return names_of(simplifiers());
}
template <>
std::vector<std::string> mesher_names<3>() {
  return names_of(meshers());
}
std::vector<std::string> improver_names() {
  return names_of(improvers());
}
std::vector<std::string> improving_strategy_names() {
  return names_of(improving_strategies());
}
std::vector<std::string> background_mesher_names() {
  return names_of(background_meshers());
}
std::vector<std::string> executor_names() {
  return {"processes", "threads", "serial"};
}
std::vector<std::string> builtin_model_names() {
  std::vector<std::string> names;
  for (const auto& info : builtin_models())
    names.emplace_back(info.name);
  return names;
}

any_partitioner make_partitioner(const std::string& name) {
  const std::size_t colon = name.find(':');
  if (colon == std::string::npos)
    return chosen(partitioners(), name, "--partitioner");
  const char* const end = name.data() + name.size();
  int seed = 0;
  if (const auto read = std::from_chars(name.data() + colon + 1, end, seed);
      read.ec != std::errc() || read.ptr != end || seed < 0)
    throw command_line_error("--partitioner: after the colon of '" + name + "' there is no seed");
  return chosen(seeded_partitioners(seed), name, "--partitioner");
}
any_simplification_rule make_simplifier(const std::string& name, std::optional<double> dihedral_angle,
                                        int dimension) {
  const any_simplification_rule known = chosen(simplifiers(), name, "--simplifier");
  if (!dihedral_angle)
    return known;
  const double angle = *dihedral_angle;
  if (!(angle >= 0 && angle <= 90))
    throw command_line_error("--dihedral-angle: " + number_text(angle) + " is not between 0 and 90 degrees");
  for (const any_simplification_rule& rule : simplifiers_at(angle, dimension))
    if (rule.name() == known.name() + at_degrees(angle))
      return rule;
  throw command_line_error("--dihedral-angle: the simplifier " + known.name() +
                           " has no angle between interfaces; one that has is paper");
}
template <>
any_mesher<3> make_mesher<3>(const std::string& name) {
  return chosen(meshers(), name, "--mesher");
}
template <>
any_improver<3> make_improver<3>(const std::string& name, const std::string& option) {
  return chosen(improvers(), name, option).of_tetrahedra();
}
template <>
any_improver<2> make_improver<2>(const std::string& name, const std::string& option) {
  const named_improver improver = chosen(improvers(), name, option);
  if (!improver.of_triangles())
    throw command_line_error(option + ": " + improver.name() +
                             " does not take meshes of triangles; use fine");
  return improver.of_triangles();
}
improving_strategy make_improving_strategy(const std::string& name) {
  return chosen(improving_strategies(), name, "--improve-again").improve;
}
any_improver<3> make_background_improver(const std::string& name) {
  return name.empty() ? any_improver<3>{} : make_improver<3>(name, "--background-improver");
}
any_line_keeping_mesher make_background_mesher(const std::string& name) {
  return chosen(background_meshers(), name, "--background-mesher");
}

any_executor make_executor(const std::string& name, int workers, const std::string& mesher,
                           const mesher_traits& traits, const std::optional<any_communicator>& network) {
  if (workers < 0)
    throw command_line_error("--workers: " + std::to_string(workers) + " is negative");
  const std::string kind = chosen_name(executor_names(), name, "--executor");
  if (network && kind == "threads")
    throw command_line_error("--executor: on several ranks it is processes or serial");
  if (network)
    return {parallel::ranks(*network, kind == "serial" ? 0 : std::max(1, workers)), "ranks"};
  if (workers == 0)
    workers = parallel::available_processors();
  if (kind == "threads") {
    if (!traits.thread_safe)
      throw command_line_error("--executor: the mesher " + mesher +
                               " cannot run in several threads of one process; use processes");
    return {parallel::threads{.worker_count = workers}, kind};
  }
  if (kind == "serial")
    return {parallel::serial{}, kind};
  return {parallel::processes{.worker_count = workers}, kind};
}

} // namespace dovetail::app
