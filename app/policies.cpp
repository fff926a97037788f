#include "policies.hpp"

#include "named_improver.hpp"
#include "named_policies.hpp"

#include "dovetail/baselines/ito_improvement.hpp"
#include "dovetail/baselines/loehner_improvement.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/geometry/builtin_models.hpp"
#include "dovetail/improver/native.hpp"
#include "dovetail/mesher/tetgen.hpp"
#include "dovetail/parallel/processes.hpp"
#include "dovetail/parallel/ranks.hpp"
#include "dovetail/parallel/serial.hpp"
#include "dovetail/parallel/threads.hpp"
#include "dovetail/partition/greedy.hpp"
#include "dovetail/partition/inertial.hpp"
#include "dovetail/partition/metis.hpp"
#include "dovetail/partition/recursive_coordinate.hpp"
#include "dovetail/partition/space_filling_curve.hpp"
#include "dovetail/simplification/aspect_ratio.hpp"
#include "dovetail/simplification/flow_aligned.hpp"
#include "dovetail/simplification/none.hpp"
#include "dovetail/simplification/paper.hpp"
#include "dovetail/simplification/shape_only.hpp"
#include "dovetail/simplification/wedges_only.hpp"

#ifdef DOVETAIL_DRIVER_WITH_CGAL
#include "background_cgal.hpp"
#include "improver_cgal.hpp"
#endif
#ifdef DOVETAIL_DRIVER_WITH_GMSH
#include "dovetail/improver/gmsh.hpp"
#include "dovetail/mesher/gmsh_delaunay.hpp"
#include "dovetail/mesher/gmsh_hxt.hpp"
#endif
#ifdef DOVETAIL_DRIVER_WITH_NETGEN
#include "dovetail/improver/netgen.hpp"
#include "dovetail/mesher/netgen.hpp"
#endif
#ifdef DOVETAIL_DRIVER_WITH_SCOTCH
#include "dovetail/partition/scotch.hpp"
#endif
#ifdef DOVETAIL_DRIVER_WITH_SPECTRA
#include "dovetail/partition/spectral.hpp"
#endif

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <system_error>
#include <thread>

namespace dovetail::app {
namespace {

std::vector<any_partitioner> partitioners() {
  std::vector<any_partitioner> known{{partition::metis{}, "metis"},
                                     {partition::metis{.recursive = true}, "metis-recursive"},
                                     {partition::greedy{}, "greedy"},
                                     {partition::inertial{}, "inertial"},
                                     {partition::recursive_coordinate{}, "coordinate"},
                                     {partition::space_filling_curve{}, "hilbert"}};
#ifdef DOVETAIL_DRIVER_WITH_SCOTCH
  known.emplace_back(partition::scotch{}, "scotch");
#endif
#ifdef DOVETAIL_DRIVER_WITH_SPECTRA
  known.emplace_back(partition::spectral{}, "spectral");
#endif
  return known;
}

/// Those that draw at random, from this seed, which is in their names.
std::vector<any_partitioner> seeded_partitioners(int seed) {
  const std::string drawn = ':' + std::to_string(seed);
  const auto large_seed = static_cast<std::uint64_t>(seed);
  std::vector<any_partitioner> known{
      {partition::metis{.seed = seed}, "metis" + drawn},
      {partition::metis{.recursive = true, .seed = seed}, "metis-recursive" + drawn},
      {partition::greedy{.seed = large_seed}, "greedy" + drawn}};
#ifdef DOVETAIL_DRIVER_WITH_SCOTCH
  known.emplace_back(partition::scotch{.seed = seed}, "scotch" + drawn);
#endif
#ifdef DOVETAIL_DRIVER_WITH_SPECTRA
  known.emplace_back(partition::spectral{.seed = large_seed}, "spectral" + drawn);
#endif
  return known;
}

std::vector<any_simplification_rule> simplifiers() {
  return {{simplifier::paper{}, "paper"},         {simplifier::none{}, "none"},
          {simplifier::shape_only{}, "shape"},    {simplifier::wedges_only{}, "wedges"},
          {simplifier::aspect_ratio{}, "aspect"}, {simplifier::flow_aligned{}, "flow-x"}};
}

std::vector<any_mesher<3>> meshers() {
  std::vector<any_mesher<3>> known{{mesher::tetgen{}, "tetgen"}};
#ifdef DOVETAIL_DRIVER_WITH_GMSH
  // The others fail on some boundaries that TetGen meshes, such as two parts that touch in an edge.
  known.push_back(any_mesher<3>(mesher::gmsh_hxt{}, "hxt").with_fallback(known.front()));
  known.push_back(any_mesher<3>(mesher::gmsh_delaunay{}, "gmsh-delaunay").with_fallback(known.front()));
#endif
#ifdef DOVETAIL_DRIVER_WITH_NETGEN
  known.push_back(any_mesher<3>(mesher::netgen{}, "netgen").with_fallback(known.front()));
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
  known.push_back(cgal_improver());
#endif
  return known;
}

std::vector<any_line_keeping_mesher> background_meshers() {
  std::vector<any_line_keeping_mesher> known{any_line_keeping_mesher::none("native")};
#ifdef DOVETAIL_DRIVER_WITH_CGAL
  known.push_back(cgal_background_mesher());
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
any_simplification_rule make_simplifier(const std::string& name, std::optional<double> wedge_angle,
                                        int dimension) {
  const any_simplification_rule known = chosen(simplifiers(), name, "--simplifier");
  if (!wedge_angle)
    return known;
  const double angle = *wedge_angle;
  if (!(angle >= 0 && angle <= 90))
    throw command_line_error("--wedge-angle: " + number_text(angle) + " is not between 0 and 90 degrees");
  const std::string called = known.name() + " at " + number_text(angle) + " degrees";
  if (known.name() == "paper")
    return {dimension == 2 ? simplifier::paper{.surface_wedge_deg = angle}
                           : simplifier::paper{.volume_wedge_deg = angle},
            called};
  if (known.name() == "wedges")
    return {dimension == 2 ? simplifier::wedges_only{.surface_deg = angle}
                           : simplifier::wedges_only{.volume_deg = angle},
            called};
  throw command_line_error("--wedge-angle: it is for the simplifiers paper and wedges, not for " +
                           known.name());
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
