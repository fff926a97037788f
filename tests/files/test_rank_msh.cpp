// Gmsh itself reads the MSH file of each rank, and all of them as one mesh.
#include "dovetail/mesh/mesh_hash.hpp"
#include "dovetail/solver/rank_files.hpp"
#include "dovetail/solver/rank_msh_format.hpp"
#include "files/bent_edges.hpp"
#include "files/scratch_folder.hpp"
#include "files/stacked_cubes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <gmsh.h>
#include <map>
#include <set>
#include <string>
#include <vector>

using namespace dovetail;
using testing::cubes_in_27;

namespace {

/// What Gmsh has after reading some files.
class gmsh_model {
public:
  explicit gmsh_model(const std::vector<std::filesystem::path>& files) {
    gmsh::initialize();
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::logger::start();
    gmsh::open(files.front().string());
    for (std::size_t f = 1; f < files.size(); ++f)
      gmsh::merge(files[f].string());
    std::vector<std::string> log;
    gmsh::logger::get(log);
    gmsh::logger::stop();
    for (const auto& line : log)
      if (!line.starts_with("Info") && !line.starts_with("Progress"))
        complaints += line + "\n";
    std::vector<std::size_t> tags;
    std::vector<double> at, parameters;
    gmsh::model::mesh::getNodes(tags, at, parameters, -1, -1, false, false);
    node_count = tags.size();
    for (std::size_t i = 0; i < tags.size(); ++i)
      nodes[tags[i]] = {at[3 * i], at[3 * i + 1], at[3 * i + 2]};
    gmsh::model::mesh::getNodes(tags, at, parameters, 3, -1, false, false);
    const std::set<std::size_t> in_volumes(tags.begin(), tags.end());
    for (int d = 0; d < 4; ++d) {
      std::vector<int> types;
      std::vector<std::vector<std::size_t>> of_type, corners;
      gmsh::model::mesh::getElements(types, of_type, corners, d);
      for (std::size_t t = 0; t < types.size(); ++t) {
        count[d] += of_type[t].size();
        if (d < 3)
          misfiled += std::count_if(corners[t].begin(), corners[t].end(),
                                    [&](std::size_t node) { return in_volumes.count(node) > 0; });
        for (std::size_t e = 0; e < of_type[t].size(); ++e)
          if (types[t] == 4 || types[t] == 11)
            for (std::size_t nodes_each = types[t] == 4 ? 4 : 10, k = 0; k < nodes_each; ++k)
              tetrahedra[of_type[t][e]].push_back(corners[t][nodes_each * e + numbering::gmsh_nodes<3>[k]]);
      }
    }
    gmsh::vectorpair groups;
    gmsh::model::getPhysicalGroups(groups);
    for (const auto& [dimension, tag] : groups) {
      std::string name;
      gmsh::model::getPhysicalName(dimension, tag, name);
      names.insert(name);
    }
    gmsh::vectorpair volumes;
    gmsh::model::getEntities(volumes, 3);
    for (const auto& [dimension, tag] : volumes) {
      std::vector<int> of_volume;
      gmsh::model::getPartitions(dimension, tag, of_volume);
      partitions.insert(of_volume.begin(), of_volume.end());
      std::string type;
      gmsh::model::getType(dimension, tag, type);
      if (type != "Ghost volume")
        continue;
      std::vector<std::size_t> elements;
      std::vector<int> owners;
      gmsh::model::mesh::getGhostElements(dimension, tag, elements, owners);
      for (std::size_t e = 0; e < elements.size(); ++e)
        ghosts[of_volume.at(0)][elements[e]] = owners[e];
    }
  }
  ~gmsh_model() { gmsh::finalize(); }

  std::string complaints;
  std::size_t node_count = 0;
  std::map<std::size_t, vec3> nodes;
  std::map<std::size_t, std::vector<std::size_t>> tetrahedra; ///< nodes in VTK's order
  std::map<int, std::size_t> count;                           ///< of elements by dimension
  std::ptrdiff_t misfiled = 0; ///< nodes of triangles, lines and points that are filed under a volume
  std::set<std::string> names;
  std::set<int> partitions;
  std::map<int, std::map<std::size_t, int>> ghosts; ///< of a partition: elements, and whose they are
};

void check_files(bool binary, bool quadratic) {
  const auto mesh =
      quadratic ? testing::with_bent_edges(cubes_in_27.distributed()) : cubes_in_27.distributed();
  const std::size_t nodes = quadratic ? 2197 : 343;
  const testing::scratch_folder folder("ranks_msh");
  io::rank_writer<io::rank_msh_format>{.ranks = 4, .format = {.binary = binary}}(mesh, folder);
  std::vector<std::filesystem::path> files;
  std::size_t elements = 0, triangles = 0;
  for (int q = 1; q <= 4; ++q) {
    files.push_back(folder / ("ranks_" + std::to_string(q) + ".msh"));
    const gmsh_model one({files.back()});
    CHECK(one.complaints == "");
    CHECK(one.node_count == one.nodes.size());
    CHECK(one.misfiled == 0);
    for (const auto& [tag, corners] : one.tetrahedra)
      for (const std::size_t v : corners)
        CHECK(one.nodes.count(v) == 1); // each rank's file stands by itself
    elements += one.tetrahedra.size();
    triangles += one.count.at(2);
  }
  CHECK(elements == 1296);
  const gmsh_model all(files);
  CHECK(all.complaints == "");
  CHECK(all.nodes.size() == nodes);
  CHECK(all.nodes.begin()->first == 1);
  CHECK(all.nodes.rbegin()->first == nodes);
  CHECK(all.tetrahedra.size() == 1296);
  CHECK(all.tetrahedra.begin()->first == 1);
  CHECK(all.tetrahedra.rbegin()->first == 1296);
  CHECK(all.count.at(2) == triangles); // no triangle is in two files
  CHECK(all.partitions == std::set<int>{1, 2, 3, 4});
  CHECK(all.names.count("side walls") == 1);
  CHECK(all.names.count("solid '2' <&>") == 1);
  double volume = 0;
  for (const auto& [tag, v] : all.tetrahedra) {
    const auto at = [&, v = v](std::size_t k) { return all.nodes.at(v[k]); };
    const double of_element = dot(cross(at(1) - at(0), at(2) - at(0)), at(3) - at(0)) / 6;
    CHECK(of_element > 0);
    volume += of_element;
  }
  CHECK(volume == doctest::Approx(1));
}

} // namespace

TEST_CASE("Gmsh reads the binary file of each rank, and all of them together") {
  check_files(true, false);
  check_files(true, true);
}

TEST_CASE("Gmsh reads text files of ranks") {
  check_files(false, false);
  check_files(false, true);
}

TEST_CASE("Gmsh reads the ghosts of each rank, and whose they are") {
  for (const bool binary : {true, false}) {
    const bool quadratic = !binary;
    const auto mesh =
        quadratic ? testing::with_bent_edges(cubes_in_27.distributed()) : cubes_in_27.distributed();
    const testing::scratch_folder folder("ranks_msh");
    io::rank_writer<io::rank_msh_format>{.ranks = 4, .format = {.binary = binary}, .ghosts = true}(mesh,
                                                                                                   folder);
    const auto numbers = io::number_by_ranks(mesh, redistribution_by::pieces{}(mesh, 4).rank_of_piece, 4);
    for (int q = 1; q <= 4; ++q) {
      const gmsh_model one({folder / ("ranks_" + std::to_string(q) + ".msh")});
      CHECK(one.complaints == "");
      const auto rank = io::make_rank_mesh<3>(mesh, numbers, q - 1, true);
      CHECK(one.nodes.size() == rank.mesh.points.size());
      REQUIRE(one.tetrahedra.size() == rank.mesh.elements.size());
      std::map<int, std::map<std::size_t, int>> ghosts;
      bool same = true;
      for (std::size_t e = 0; e < rank.mesh.elements.size(); ++e) {
        const auto tag = static_cast<std::size_t>(rank.element_ids[e] + 1);
        if (e >= rank.owned_elements)
          ghosts[q][tag] = rank.element_owners[e] + 1;
        std::vector<std::size_t> nodes;
        for_each_node(rank, e, [&](local_id vertex) {
          const auto v = static_cast<std::size_t>(vertex);
          nodes.push_back(static_cast<std::size_t>(rank.vertex_ids[v] + 1));
          same = same && one.nodes.at(nodes.back()) == rank.mesh.points[v];
        });
        same = same && one.tetrahedra.at(tag) == nodes;
      }
      CHECK(same);
      CHECK(one.ghosts == ghosts);
    }
  }
}
