/// The dual graph of a mesh that was read from a file, for the algorithms of Boost.Graph.
/// Usage: 11_graphs_of_a_file [MESH (VTU, PVTU or MSH; default: two balls, written to two_balls.msh)]
#include "dovetail/adapters/boost_graph.hpp"
#include "dovetail/files/msh_writer.hpp"
#include "dovetail/files/read_mesh.hpp"
#include "dovetail/models/implicit/shapes.hpp"
#include "dovetail/models/implicit_model.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/simplification/mesh_duals.hpp"
#include "dovetail/sizing/uniform.hpp"

#include <boost/graph/breadth_first_search.hpp>
#include <boost/graph/connected_components.hpp>

#include <algorithm>
#include <cstdio>
#include <vector>

namespace {

using namespace dovetail;

void write_two_balls() {
  const auto two_balls = [](vec3 p) {
    return std::min(implicit::sphere{{-1.5, 0, 0}, 1}(p), implicit::sphere{{1.5, 0, 0}, 1.2}(p));
  };
  const implicit_model model(two_balls, {{-3, -2, -2}, {3, 2, 2}});
  // part write
  const auto made = generate<3>(model, uniform_size(0.3), parameters<>{});
  io::msh_writer{.stem = "two_balls"}(made.mesh, ".");
  // end
}

} // namespace

int main(int argc, char** argv) try {
  if (argc < 2)
    write_two_balls();
  // part graphs
  const auto mesh = io::read_mesh(argc > 1 ? argv[1] : "two_balls.msh").mesh;
  const auto sides = build_sides(mesh);
  const element_dual<3> dual(sides); // a view: node = element, edge = side between two
  const auto graph = to_boost(dual);

  std::vector<int> part(num_vertices(graph));
  const int parts = boost::connected_components(graph, part.data());
  std::vector<int> steps(num_vertices(graph), 0); // through sides, from the first element
  boost::breadth_first_search(
      graph, 0,
      boost::visitor(boost::make_bfs_visitor(boost::record_distances(steps.data(), boost::on_tree_edge()))));
  // end
  std::printf("%zu elements, %zu sides between two, %d connected parts\n", mesh.elements.size(),
              num_edges(graph), parts);
  std::printf("from the first element to the farthest one that is connected: %d sides\n",
              *std::max_element(steps.begin(), steps.end()));
} catch (const dovetail::error& problem) {
  std::fprintf(stderr, "%s\n", problem.what());
  return 1;
}
