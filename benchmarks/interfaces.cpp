// The fine interface angles of models, of all that comes before pieces are meshed: at 0.2 and 1 million
// elements (TetGen makes the background mesh, METIS the parts) how many angles of interface faces and of the
// dihedrals beside them are under 30 degrees and not forced by the CAD, and what it took. Each of them is
// listed. Ends with status 1 when there is one.
//
//   interfaces [MODEL...]
//
// MODEL is a CAD file or the name of a built-in model; by default all of the latter and what is in the folder
// `models` of $DOVETAIL_SHARED. Files have a uniform size, built-in models their own, scaled.
#include "dovetail/adapters/metis.hpp"
#include "dovetail/adapters/tetgen.hpp"
#include "dovetail/distributed/processes.hpp"
#include "dovetail/experiments/builtin_models.hpp"
#include "dovetail/models/occt/read.hpp"
#include "dovetail/pipeline/background.hpp"
#include "dovetail/pipeline/divide.hpp"
#include "dovetail/pipeline/rounds.hpp"
#include "dovetail/sizing/compose.hpp"
#include "dovetail/sizing/uniform.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

using namespace dovetail;

namespace {

struct sized_model {
  any_geometry model;
  any_sizing size;
};

sized_model load(const std::string& name) {
  const auto known = builtin_models();
  if (std::any_of(known.begin(), known.end(), [&](const auto& info) { return info.name == name; })) {
    auto built = builtin_model(name);
    return {any_geometry(std::move(built.model)),
            keep_bounds(source_field(built.size, std::move(built.sources)))};
  }
  any_geometry model(read_occt_model(name).model);
  return {model, keep_bounds(uniform_size(model.bounds().diagonal() / 25))};
}

std::vector<std::string> all_models() {
  std::vector<std::string> names;
  for (const auto& info : builtin_models())
    names.emplace_back(info.name);
  if (const char* shared = std::getenv("DOVETAIL_SHARED")) {
    for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(shared) / "models"))
      if (const auto kind = entry.path().extension(); kind == ".step" || kind == ".stp" || kind == ".brep")
        names.push_back(entry.path().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// The number of small angles that are not forced.
std::size_t measure(const std::string& name, const sized_model& given, double elements) {
  const any_parameters<3> policies(parameters<>{}
                                       .with_mesher(mesher::tetgen{})
                                       .with_partitioner(partition::metis{})
                                       .with_executor(parallel::processes{}));
  const auto plan_times = plan_multiples<3>(given.model, given.size, policies);
  double scale = 1;
  for (int step = 0; step < 3; ++step)
    scale *= std::cbrt(plan_times(scale).predicted_elements / elements);
  const auto background = make_background<3>(given.model, keep_bounds(scaled(given.size, scale)), policies);
  const auto divided = divide<3>(background.mesh, background.size, background.plan.subdomains, policies);
  const stopwatch clock;
  decomposition_rounds rounds(given.model, background.mesh, divided, background.size, policies);
  const report skeleton = rounds.realize_boundaries().value().summary;
  const double seconds = clock.seconds();
  const interface_angles angles = rounds.take_fine_angles();
  std::array<std::size_t, 2> small{};
  for (const angle_violation& v : angles.violations)
    if (v.cause != violation_cause::forced)
      ++small[v.is_dihedral() ? 1 : 0];
  std::printf("| %s | %.3g | %d | %zu | %zu, %.1f | %zu, %.1f | %zu | %.0f | %.0f | %.2f |\n", name.c_str(),
              elements, rounds.merges().subdomains(), angles.interface_faces, small[0],
              angles.face_angle.angle_deg, small[1], angles.min_dihedral_deg(),
              angles.count(violation_cause::forced), skeleton.get("repartition_rounds"),
              skeleton.get("repartitioned"), seconds);
  for (const angle_violation& v : angles.violations)
    if (v.cause != violation_cause::forced)
      std::printf("    %s of %.2f degrees at %.6g %.6g %.6g\n", v.is_dihedral() ? "dihedral" : "face angle",
                  v.angle_deg, v.place.x, v.place.y, v.place.z);
  std::fflush(stdout);
  return small[0] + small[1];
}

} // namespace

int main(int argc, char** argv) {
  std::vector<std::string> names(argv + 1, argv + argc);
  std::size_t small = 0;
  std::printf(
      "| model | elements | subdomains | interface triangles | face angles under 30, least | dihedrals "
      "under 30, least | forced | rounds of local repartition | super-elements moved | seconds |\n"
      "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
  for (const std::string& name : names.empty() ? all_models() : names)
    for (const double elements : {2e5, 1e6}) {
      const std::string shown = std::filesystem::path(name).filename().string();
      try {
        small += measure(shown, load(name), elements);
      } catch (const std::exception& error) {
        std::printf("| %s | %.3g | %s |\n", shown.c_str(), elements, error.what());
      }
    }
  return small > 0 ? 1 : 0;
}
