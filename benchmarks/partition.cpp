/// All partitioners on the same coarse meshes, with and without simplification: cut, balance, the angles of
/// the interfaces, and time. Prints Markdown tables.
/// Usage: partition [subdomains (default 32)] [background elements (default 75000)] [models...]
/// Models are names of built-in ones or CAD files; by default the aircraft and, when DOVETAIL_SHARED is set,
/// models/linkrods.step in that folder.
#include "dovetail/adapters/metis.hpp"
#include "dovetail/adapters/scotch.hpp"
#include "dovetail/adapters/spectral.hpp"
#include "dovetail/adapters/tetgen.hpp"
#include "dovetail/decomposition/decompose.hpp"
#include "dovetail/experiments/builtin_models.hpp"
#include "dovetail/partition/greedy.hpp"
#include "dovetail/partition/inertial.hpp"
#include "dovetail/partition/recursive_coordinate.hpp"
#include "dovetail/partition/space_filling_curve.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/simplification/none.hpp"
#include "dovetail/simplification/paper.hpp"
#include "dovetail/simplification/simplify_coupled.hpp"
#include "dovetail/sizing/sources.hpp"
#include "dovetail/sizing/uniform.hpp"
#include "timed_partitioner.hpp"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace dovetail;

/// A coarse mesh with what its decomposition needs.
struct coarse_model {
  simplicial_background<3> mesh;
  side_table<3> sides;
  std::vector<double> weights;
};

class comparison {
public:
  comparison(const coarse_model& coarse, int subdomains) : coarse_(coarse), subdomains_(subdomains) {
    std::vector<simplex<1>> on_curves;
    for (const auto& edge : coarse.mesh.surface.curve_edges)
      on_curves.push_back(edge.vertices);
    const auto add = [&](const auto& rule) {
      simplified_.push_back(
          simplify_coupled({coarse.mesh.surface.mesh, {.fixed_sides = span_of(on_curves)}},
                           {coarse.mesh.volume, coarse.sides, {.element_weights = coarse.weights}}, rule,
                           {.subdomains = static_cast<double>(subdomains)})
              .volume);
    };
    add(simplifier::paper{});
    add(simplifier::none{});
  }

  void print_head() const {
    std::printf("%zu tetrahedra, %d super-elements after simplification, %d subdomains\n\n",
                coarse_.mesh.volume.elements.size(), simplified_[0].super_count, subdomains_);
    std::printf("| partitioner | simplified | cut | interface faces | imbalance | least face angle | "
                "least dihedral | time, s |\n|---|---|---|---|---|---|---|---|\n");
  }

  template <graph_partitioner P>
  void print_rows(const char* name, const P& policy) const {
    for (const bool simplify : {true, false}) {
      const simplification& simplified = simplified_[simplify ? 0 : 1];
      double seconds = 0;
      const auto pieces =
          decompose<3>(coarse_.mesh.volume, coarse_.sides, simplified.super_of_element, simplified.graph,
                       coarse_.mesh.volume.tags, dovetail_benchmark::timed<P>{policy, &seconds}, subdomains_);
      const auto angles = measure_interface_angles<3>(
          {coarse_.mesh.volume, coarse_.sides, simplified.side_states, pieces.part_of_element},
          wanted_angles_of<3>(simplifier::paper{}));
      std::printf("| %s | %s | %.0f | %zu | %.3f | %.1f | %.1f | %.2f |\n", name, simplify ? "yes" : "no",
                  pieces.summary.get("cut_of_partitioner"), angles.interface_faces,
                  pieces.summary.get("imbalance"), angles.face_angle.angle_deg, angles.min_dihedral_deg(),
                  seconds);
      std::fflush(stdout);
    }
  }

private:
  const coarse_model& coarse_;
  int subdomains_;
  std::vector<simplification> simplified_; ///< with, without
};

template <geometry_model G, sizing_field H>
void compare(const G& model, const H& size, int subdomains, double background_elements) {
  const auto given = parameters<>{}.with_mesher(mesher::tetgen{});
  auto options = given.options;
  options.subdomains = subdomains;
  options.background_elements = background_elements;
  coarse_model coarse;
  coarse.mesh = make_background<3>(model, size, given.with_options(options)).mesh;
  coarse.sides = build_sides(coarse.mesh.volume);
  coarse.weights = predict_elements<3>(coarse.mesh.volume, size).per_element;
  const comparison table(coarse, subdomains);
  table.print_head();
  table.print_rows("metis", partition::metis{});
  table.print_rows("metis, recursive", partition::metis{.recursive = true});
  table.print_rows("scotch", partition::scotch{});
  table.print_rows("spectral", partition::spectral{});
  table.print_rows("greedy", partition::greedy{});
  table.print_rows("inertial", partition::inertial{});
  table.print_rows("inertial, not refined", partition::inertial{.refinement_passes = 0});
  table.print_rows("coordinate", partition::recursive_coordinate{});
  table.print_rows("Hilbert curve", partition::space_filling_curve{});
  table.print_rows("Hilbert curve, not refined", partition::space_filling_curve{.refinement_passes = 0});
}

void compare_model(const std::string& name, int subdomains, double background_elements) {
  std::printf("\n### %s\n", std::filesystem::path(name).filename().string().c_str());
  if (std::filesystem::exists(name)) {
    const auto model = read_occt_model(name).model;
    compare(model, uniform_size(model.bounds().diagonal() / 150), subdomains, background_elements);
  } else {
    auto built = builtin_model(name);
    compare(built.model, source_field(built.size, std::move(built.sources)), subdomains, background_elements);
  }
}

} // namespace

int main(int argc, char** argv) try {
  const int subdomains = argc > 1 ? std::atoi(argv[1]) : 32;
  const double elements = argc > 2 ? std::atof(argv[2]) : 75000;
  std::vector<std::string> models(argv + std::min(argc, 3), argv + argc);
  if (models.empty()) {
    models.emplace_back("aircraft");
    if (const char* shared = std::getenv("DOVETAIL_SHARED"))
      models.push_back(std::string(shared) + "/models/linkrods.step");
  }
  for (const std::string& model : models)
    compare_model(model, subdomains, elements);
  return 0;
} catch (const dovetail::error& problem) {
  std::fprintf(stderr, "%s\n", problem.what());
  return 1;
}
