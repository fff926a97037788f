#include "policies.hpp"

#include "named_policies.hpp"

#include "dovetail/geometry/builtin_models.hpp"
#include "dovetail/improver/native.hpp"
#include "dovetail/mesher/tetgen.hpp"
#include "dovetail/parallel/processes.hpp"
#include "dovetail/parallel/serial.hpp"
#include "dovetail/parallel/threads.hpp"
#include "dovetail/partition/greedy.hpp"
#include "dovetail/partition/inertial.hpp"
#include "dovetail/partition/metis.hpp"
#include "dovetail/partition/recursive_coordinate.hpp"
#include "dovetail/partition/space_filling_curve.hpp"

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
#ifdef DOVETAIL_DRIVER_WITH_EIGEN
#include "dovetail/partition/spectral.hpp"
#endif

#include <algorithm>
#include <thread>

namespace dovetail::app {
namespace {

std::vector<any_partitioner> partitioners() {
  std::vector<any_partitioner> known{{"metis", partition::metis{}},
                                     {"metis-recursive", partition::metis{.recursive = true}},
                                     {"greedy", partition::greedy{}},
                                     {"inertial", partition::inertial{}},
                                     {"coordinate", partition::recursive_coordinate{}},
                                     {"hilbert", partition::space_filling_curve{}}};
#ifdef DOVETAIL_DRIVER_WITH_SCOTCH
  known.emplace_back("scotch", partition::scotch{});
#endif
#ifdef DOVETAIL_DRIVER_WITH_EIGEN
  known.emplace_back("spectral", partition::spectral{});
#endif
  return known;
}

std::vector<any_mesher> meshers() {
  std::vector<any_mesher> known{{"tetgen", mesher::tetgen{}}};
#ifdef DOVETAIL_DRIVER_WITH_GMSH
  // The others fail on some boundaries that TetGen meshes, such as two parts that touch in an edge.
  known.push_back(any_mesher("hxt", mesher::gmsh_hxt{}).with_fallback(known.front()));
  known.push_back(any_mesher("gmsh-delaunay", mesher::gmsh_delaunay{}).with_fallback(known.front()));
#endif
#ifdef DOVETAIL_DRIVER_WITH_NETGEN
  known.push_back(any_mesher("netgen", mesher::netgen{}).with_fallback(known.front()));
#endif
  return known;
}

/// The driver measures meshes itself: what the improver counts for its report is shown nowhere.
improvement::native uncounted(improvement::native preset) {
  preset.statistics = false;
  return preset;
}

std::vector<any_improver> improvers() {
  std::vector<any_improver> known{{"native", uncounted(improvement::native{})},
                                  {"fast", uncounted(improvement::native::fast())},
                                  {"fine", uncounted(improvement::native::fine())},
                                  {"finest", uncounted(improvement::native::finest())},
                                  {"none", improvement::none{}}};
#ifdef DOVETAIL_DRIVER_WITH_GMSH
  known.emplace_back("gmsh", improvement::gmsh{});
#endif
#ifdef DOVETAIL_DRIVER_WITH_NETGEN
  known.emplace_back("netgen", improvement::netgen{});
#endif
#ifdef DOVETAIL_DRIVER_WITH_CGAL
  known.push_back(cgal_improver());
#endif
  return known;
}

std::vector<any_background_mesher> background_meshers() {
  std::vector<any_background_mesher> known(1);
#ifdef DOVETAIL_DRIVER_WITH_CGAL
  known.push_back(cgal_background_mesher());
#endif
  return known;
}

} // namespace

std::vector<std::string> partitioner_names() {
  return names_of(partitioners());
}
std::vector<std::string> mesher_names() {
  return names_of(meshers());
}
std::vector<std::string> improver_names() {
  return names_of(improvers());
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
  return chosen(partitioners(), name, "--partitioner");
}
any_mesher make_mesher(const std::string& name) {
  return chosen(meshers(), name, "--mesher");
}
any_improver make_improver(const std::string& name) {
  return chosen(improvers(), name, "--improver");
}
any_background_mesher make_background_mesher(const std::string& name) {
  return chosen(background_meshers(), name, "--background-mesher");
}

any_executor make_executor(const std::string& name, int workers, const std::string& mesher,
                           const mesher_traits& traits) {
  if (workers < 0)
    throw command_line_error("--workers: " + std::to_string(workers) + " is negative");
  if (workers == 0)
    workers = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  if (name == "threads") {
    if (!traits.thread_safe)
      throw command_line_error("--executor: the mesher " + mesher +
                               " cannot run in several threads of one process; use processes");
    return {"threads", parallel::threads{.worker_count = workers}};
  }
  if (name == "serial")
    return {"serial", parallel::serial{}};
  if (name.empty() || name == "processes")
    return {"processes", parallel::processes{.worker_count = workers}};
  throw command_line_error("--executor: there is no '" + name + "'; there are: processes, threads, serial");
}

} // namespace dovetail::app
