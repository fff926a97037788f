// Gmsh itself rereads what the MSH writer writes, and the MSH reader reads what Gmsh writes.
#include "dovetail/files/read_mesh.hpp"
#include "dovetail/mesh/distributed_validity.hpp"
#include "dovetail/mesh/mesh_hash.hpp"
#include "files/msh_kinds.hpp"
#include "files/scratch_folder.hpp"
#include "files/stacked_cubes.hpp"

#include <doctest/doctest.h>

#include <cstdio>
#include <gmsh.h>
#include <map>
#include <random>
#include <set>

using namespace dovetail;

namespace {

/// A file opened in Gmsh, with Gmsh's messages.
class gmsh_session {
public:
  explicit gmsh_session(const std::filesystem::path& path) {
    gmsh::initialize();
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::logger::start();
    gmsh::open(path.string());
    gmsh::logger::get(log_);
    gmsh::logger::stop();
  }
  ~gmsh_session() { gmsh::finalize(); }

  /// All messages but information, one per line.
  std::string complaints() const {
    std::string found;
    for (const auto& line : log_)
      if (!line.starts_with("Info") && !line.starts_with("Progress"))
        found += line + "\n";
    return found;
  }

private:
  std::vector<std::string> log_;
};

std::vector<int> partitions_of(int dimension, int tag) {
  std::vector<int> partitions;
  gmsh::model::getPartitions(dimension, tag, partitions);
  return partitions;
}

bool is_ghost(int dimension, int tag) {
  std::string type;
  gmsh::model::getType(dimension, tag, type);
  return type == "Ghost volume";
}

gmsh::vectorpair entities(int dimension) {
  gmsh::vectorpair found;
  gmsh::model::getEntities(found, dimension);
  return found;
}

std::size_t element_count(int dimension, int tag) {
  std::vector<int> types;
  std::vector<std::vector<std::size_t>> tags, nodes;
  gmsh::model::mesh::getElements(types, tags, nodes, dimension, tag);
  std::size_t count = 0;
  for (const auto& of_type : tags)
    count += of_type.size();
  return count;
}

std::set<std::size_t> own_nodes(int dimension, int tag) {
  std::vector<std::size_t> tags;
  std::vector<double> coordinates, parameters;
  gmsh::model::mesh::getNodes(tags, coordinates, parameters, dimension, tag, false, false);
  return {tags.begin(), tags.end()};
}

/// The nodes of an entity and of all entities on its boundary.
std::set<std::size_t> closure_nodes(int dimension, int tag) {
  auto nodes = own_nodes(dimension, tag);
  if (dimension == 0)
    return nodes;
  std::vector<int> upward, downward;
  gmsh::model::getAdjacencies(dimension, tag, upward, downward);
  for (const int side : downward)
    nodes.merge(closure_nodes(dimension - 1, std::abs(side)));
  return nodes;
}

std::set<std::size_t> element_nodes(int dimension, int tag) {
  std::vector<int> types;
  std::vector<std::vector<std::size_t>> tags, nodes;
  gmsh::model::mesh::getElements(types, tags, nodes, dimension, tag);
  std::set<std::size_t> all;
  for (const auto& of_type : nodes)
    all.insert(of_type.begin(), of_type.end());
  return all;
}

/// A node is filed under the lowest-dimensional entity it lies on: an entity's elements use all of its own
/// nodes, and besides those of its boundary. (A face may also touch other entities in a vertex.)
bool nodes_are_filed_right(int dimension, int tag) {
  const auto own = own_nodes(dimension, tag);
  const auto used = element_nodes(dimension, tag);
  auto closure = closure_nodes(dimension, tag);
  for (const auto& vertex : entities(0))
    closure.merge(own_nodes(0, vertex.second));
  return std::includes(closure.begin(), closure.end(), used.begin(), used.end()) &&
         std::includes(used.begin(), used.end(), own.begin(), own.end());
}

const testing::stacked_cubes smooth_cubes{.cells = 6, .cuts = 2, .solids = 2, .jitter = 0.2};

} // namespace

TEST_CASE("Gmsh rereads a whole mesh without complaint, with its groups and counts") {
  const testing::scratch_folder folder("msh_whole");
  for (const bool binary : {true, false}) {
    io::msh_writer{.binary = binary}(smooth_cubes.distributed(), folder);
    const gmsh_session session(folder / "mesh.msh");
    CHECK(session.complaints() == std::string());
    CHECK(entities(0).size() == 12);
    CHECK(entities(1).size() == 20);
    CHECK(entities(2).size() == 11);
    CHECK(entities(3).size() == 2);
    CHECK(element_count(3, 1) == 6 * 6 * 6 * 6 / 2);
    CHECK(element_count(3, 2) == 6 * 6 * 6 * 6 / 2);
    CHECK(element_count(2, 1) == 2 * 6 * 6);
    CHECK(element_count(2, 2) == 2 * 6 * 6); // the material interface
    CHECK(element_count(1, 1) == 6);
    CHECK(own_nodes(3, 1).size() == 5 * 5 * 2);
    CHECK(own_nodes(2, 2).size() == 5 * 5);
    CHECK(own_nodes(1, 1).size() == 5);

    gmsh::vectorpair groups;
    gmsh::model::getPhysicalGroups(groups);
    std::set<std::string> names;
    for (const auto& [dimension, tag] : groups) {
      std::string name;
      gmsh::model::getPhysicalName(dimension, tag, name);
      names.insert(std::to_string(dimension) + " " + name);
    }
    CHECK(names == std::set<std::string>{"2 floor", "2 cad face 1", "2 roof", "2 side walls",
                                         "3 solid '0' <&>", "3 solid '1' <&>"});
  }
}

TEST_CASE("faces of the model are closed by their curves, and volumes by their faces, with signs") {
  const testing::scratch_folder folder("msh_boundary");
  for (const bool partitioned : {false, true}) {
    testing::write_kind_of_msh(smooth_cubes.distributed(), folder, partitioned);
    const gmsh_session session(folder / "mesh.msh");
    for (int dimension = 1; dimension <= 3; ++dimension)
      for (const auto& [d, tag] : entities(dimension)) {
        gmsh::vectorpair boundary;
        gmsh::model::getBoundary({{d, tag}}, boundary, false, true, false);
        CHECK(boundary.size() == (dimension == 1 ? 2U : dimension == 2 ? 4U : 6U));
        // The boundary of the boundary vanishes.
        std::map<int, int> sum;
        for (const auto& side : boundary)
          if (dimension > 1) {
            gmsh::vectorpair ridges;
            gmsh::model::getBoundary({{side.first, std::abs(side.second)}}, ridges, false, true, false);
            // Gmsh forgets the orientation of a curve's ends, and knows their order instead.
            int at = 0;
            for (const auto& ridge : ridges) {
              const int sign = dimension == 2 ? (at++ == 0 ? -1 : 1) : ridge.second < 0 ? -1 : 1;
              sum[std::abs(ridge.second)] += sign * (side.second < 0 ? -1 : 1);
            }
          }
        for (const auto& [ridge, total] : sum)
          CHECK(total == 0);
      }
  }
}

TEST_CASE("Gmsh rereads a partitioned mesh without complaint and with equal counts per partition") {
  const testing::scratch_folder folder("msh_partitioned");
  const auto mesh = smooth_cubes.distributed();
  for (const bool binary : {true, false})
    for (const bool ghosts : {false, true}) {
      testing::write_kind_of_msh(mesh, folder, true, ghosts, binary);
      const gmsh_session session(folder / "mesh.msh");
      CHECK(session.complaints() == std::string());
      std::map<int, std::size_t> elements;
      std::array<std::size_t, 4> partitioned{};
      std::set<std::size_t> all_nodes;
      std::size_t node_sum = 0;
      for (int dimension = 0; dimension <= 3; ++dimension)
        for (const auto& [d, tag] : entities(dimension)) {
          const auto partitions = partitions_of(d, tag);
          const auto own = own_nodes(d, tag);
          all_nodes.insert(own.begin(), own.end());
          node_sum += own.size();
          if (partitions.empty())
            continue;
          if (is_ghost(d, tag))
            continue;
          ++partitioned[dimension];
          if (dimension == 3)
            elements[partitions.front()] += element_count(d, tag);
          int parent_dimension = -1, parent = -1;
          gmsh::model::getParent(d, tag, parent_dimension, parent);
          CHECK(parent_dimension >= dimension);
          CHECK(parent > 0);
          CHECK(nodes_are_filed_right(d, tag));
        }
      // 3 levels in each direction: a grid of 3^3 points.
      const bool right_counts = partitioned == std::array<std::size_t, 4>{27, 54, 36, 8};
      CHECK(right_counts);
      REQUIRE(elements.size() == 8);
      for (std::size_t s = 0; s < 8; ++s)
        CHECK(elements[static_cast<int>(s) + 1] == static_cast<std::size_t>(mesh.counts[s].elements));
      CHECK(all_nodes.size() == 7 * 7 * 7);
      CHECK(node_sum == all_nodes.size());
    }
}

TEST_CASE("ghosts are the elements that touch another partition in a point") {
  const testing::scratch_folder folder("msh_ghosts");
  const auto mesh = smooth_cubes.distributed();
  testing::write_kind_of_msh(mesh, folder, true, true);
  const gmsh_session session(folder / "mesh.msh");
  std::map<int, std::set<std::size_t>> nodes_of_partition; // of own elements
  std::map<int, std::map<std::size_t, std::set<std::size_t>>> elements_of_partition;
  std::map<int, std::set<std::size_t>> ghosts_of_partition;
  for (const auto& [d, tag] : entities(3)) {
    const auto partitions = partitions_of(d, tag);
    if (partitions.empty())
      continue;
    if (is_ghost(d, tag)) {
      std::vector<std::size_t> tags;
      std::vector<int> owners;
      gmsh::model::mesh::getGhostElements(d, tag, tags, owners);
      ghosts_of_partition[partitions.front()] = {tags.begin(), tags.end()};
      continue;
    }
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> element_tags, nodes;
    gmsh::model::mesh::getElements(types, element_tags, nodes, d, tag);
    REQUIRE(types == std::vector<int>{4});
    nodes_of_partition[partitions.front()].insert(nodes[0].begin(), nodes[0].end());
    for (std::size_t e = 0; e < element_tags[0].size(); ++e)
      elements_of_partition[partitions.front()][element_tags[0][e]] = {
          nodes[0].begin() + static_cast<std::ptrdiff_t>(4 * e),
          nodes[0].begin() + static_cast<std::ptrdiff_t>(4 * e + 4)};
  }
  REQUIRE(elements_of_partition.size() == 8);
  for (const auto& at : nodes_of_partition) {
    const int partition = at.first;
    const auto& own = at.second;
    std::set<std::size_t> expected;
    for (const auto& [other, elements] : elements_of_partition)
      if (other != partition)
        for (const auto& [element, nodes] : elements)
          if (std::any_of(nodes.begin(), nodes.end(), [&](std::size_t n) { return own.count(n) > 0; }))
            expected.insert(element);
    CHECK_FALSE(expected.empty());
    CHECK(ghosts_of_partition[partition] == expected);
  }
}

TEST_CASE("gmsh -check finds no fault") {
  if (std::system("gmsh -version > /dev/null 2>&1") != 0) {
    MESSAGE("skipped: the gmsh command is not installed");
    return;
  }
  const testing::scratch_folder folder("msh_check");
  for (const bool partitioned : {false, true}) {
    testing::write_kind_of_msh(smooth_cubes.distributed(), folder, partitioned);
    const auto command =
        "gmsh -check '" + (folder / "mesh.msh").string() + "' > '" + (folder / "log").string() + "' 2>&1";
    CHECK(std::system(command.c_str()) == 0);
    const auto log = testing::file_content(folder / "log");
    CHECK(log.find("Done checking mesh coherence") != std::string::npos);
    CHECK(log.find("Warning") == std::string::npos);
    CHECK(log.find("Error") == std::string::npos);
  }
}

TEST_CASE("long and odd names survive as far as Gmsh allows") {
  const testing::scratch_folder folder("msh_names");
  auto mesh = smooth_cubes.distributed();
  mesh.group_names[0] = std::string(400, 'x');
  mesh.group_names[2] = "line\nbreak \"quoted\" \xc3\xa4";
  io::msh_writer{}(mesh, folder);
  const gmsh_session session(folder / "mesh.msh");
  CHECK(session.complaints() == std::string());
  std::string name;
  gmsh::model::getPhysicalName(2, 1, name);
  CHECK(name == std::string(120, 'x'));
  gmsh::model::getPhysicalName(2, 3, name);
  CHECK(name == "line break 'quoted' \xc3\xa4");
}

TEST_CASE("what Gmsh writes is read: versions 2.2 and 4.1, text and binary, whole and partitioned") {
  const testing::scratch_folder folder("msh_by_gmsh");
  const auto mesh = smooth_cubes.distributed();
  for (const bool partitioned : {false, true}) {
    testing::write_kind_of_msh(mesh, folder, partitioned);
    for (const double version : {2.2, 4.1})
      for (const int binary : {0, 1}) {
        {
          const gmsh_session session(folder / "mesh.msh");
          gmsh::option::setNumber("Mesh.MshFileVersion", version);
          gmsh::option::setNumber("Mesh.Binary", binary);
          gmsh::option::setNumber("Mesh.SaveAll", version == 2.2 ? 0 : 1);
          gmsh::write((folder / "by_gmsh.msh").string());
        }
        CAPTURE(version);
        CAPTURE(binary);
        const auto read = io::read_mesh(folder / "by_gmsh.msh");
        CHECK(read.mesh.elements.size() == 6 * 6 * 6 * 6);
        CHECK(std::count(read.mesh.tags.begin(), read.mesh.tags.end(), 1) == 3 * 6 * 6 * 6);
        CHECK(read.subdomains.size() == (partitioned ? read.mesh.elements.size() : 0));
        CHECK(read.material_names.size() == 2);
        // Text has 16 digits, and Gmsh renumbers nodes for version 2.2.
        if (binary == 1 && version == 4.1)
          CHECK(io::mesh_hash(read) == io::mesh_hash(mesh));
      }
  }
}

TEST_CASE("a mesh that Gmsh made is read, with names and node data, and quadratic elements are refused") {
  const testing::scratch_folder folder("msh_made_by_gmsh");
  for (const double version : {2.2, 4.1})
    for (const int binary : {0, 1}) {
      gmsh::initialize();
      gmsh::option::setNumber("General.Terminal", 0);
      gmsh::model::add("ball");
      gmsh::model::occ::addSphere(0, 0, 0, 1, 5);
      gmsh::model::occ::synchronize();
      gmsh::model::addPhysicalGroup(3, {5}, 42);
      gmsh::model::setPhysicalName(3, 42, "a ball");
      gmsh::option::setNumber("Mesh.MeshSizeMax", 0.4);
      gmsh::model::mesh::generate(3);
      gmsh::option::setNumber("Mesh.MshFileVersion", version);
      gmsh::option::setNumber("Mesh.Binary", binary);
      gmsh::write((folder / "ball.msh").string());
      std::vector<std::size_t> nodes;
      std::vector<double> coordinates, parameters;
      gmsh::model::mesh::getNodes(nodes, coordinates, parameters);
      const int view = gmsh::view::add("size");
      std::vector<std::vector<double>> values;
      for (const auto n : nodes)
        values.push_back({static_cast<double>(n)});
      gmsh::view::addModelData(view, 0, "ball", "NodeData", nodes, values);
      gmsh::view::write(view, (folder / "size.msh").string());
      gmsh::model::mesh::setOrder(2);
      gmsh::write((folder / "quadratic.msh").string());
      gmsh::finalize();

      const auto read = io::read_mesh(folder / "ball.msh");
      CHECK(read.mesh.elements.size() > 100);
      CHECK(std::count(read.mesh.tags.begin(), read.mesh.tags.end(), 41) ==
            static_cast<std::ptrdiff_t>(read.mesh.elements.size()));
      CHECK(read.material_names == std::vector{std::pair(local_id{41}, std::string("a ball"))});
      const auto sizes = io::read_mesh(folder / "size.msh");
      REQUIRE(sizes.scalars("size") != nullptr);
      REQUIRE(sizes.scalars("size")->size() == nodes.size());
      for (std::size_t v = 0; v < nodes.size(); ++v)
        CHECK((*sizes.scalars("size"))[v] == static_cast<double>(sizes.node_ids[v] + 1));
      CHECK_THROWS_WITH_AS(io::read_mesh(folder / "quadratic.msh"), doctest::Contains("elements of type"),
                           input_error);
    }
}

TEST_CASE("a single subdomain, and subdomains without inner points") {
  const testing::scratch_folder folder("msh_corner_cases");
  for (const auto& cut : {testing::stacked_cubes{.cells = 3, .cuts = 1, .solids = 1},
                          testing::stacked_cubes{.cells = 2, .cuts = 2, .solids = 2}})
    for (const bool partitioned : {false, true}) {
      const auto mesh = cut.distributed();
      testing::write_kind_of_msh(mesh, folder, partitioned, true);
      const gmsh_session session(folder / "mesh.msh");
      CHECK(session.complaints() == std::string());
      std::set<std::size_t> nodes;
      for (int dimension = 0; dimension <= 3; ++dimension)
        for (const auto& [d, tag] : entities(dimension))
          nodes.merge(own_nodes(d, tag));
      CHECK(nodes.size() == io::number_globally(mesh).points());
    }
}

TEST_CASE("partitions of any shape: elements dealt out at random, interfaces that touch themselves") {
  const testing::scratch_folder folder("msh_random");
  std::mt19937 random(5);
  for (const local_id subdomains : {2, 3, 6}) {
    const testing::stacked_cubes cut{.cells = 4, .cuts = 1, .solids = 2};
    const auto whole = cut.whole();
    std::vector<local_id> parts;
    for (const auto tag : whole.tags) // an even number for one material, an odd one for the other
      parts.push_back(2 * static_cast<local_id>(random() % static_cast<unsigned>(subdomains)) + tag);
    const auto mesh = cut.distributed(parts);
    REQUIRE(io::check_distributed(mesh).valid());
    testing::write_kind_of_msh(mesh, folder, true, true);
    CHECK(io::mesh_hash(io::read_mesh(folder / "mesh.msh")) == io::mesh_hash(mesh));
    const gmsh_session session(folder / "mesh.msh");
    CHECK(session.complaints() == std::string());
    std::map<int, std::size_t> elements;
    std::size_t misfiled = 0;
    for (int dimension = 0; dimension <= 3; ++dimension)
      for (const auto& [d, tag] : entities(dimension)) {
        const auto partitions = partitions_of(d, tag);
        if (partitions.empty() || is_ghost(d, tag))
          continue;
        misfiled += nodes_are_filed_right(d, tag) ? 0 : 1;
        if (dimension == 3)
          elements[partitions.front()] += element_count(d, tag);
      }
    CHECK(misfiled == 0);
    for (std::size_t s = 0; s < mesh.counts.size(); ++s)
      CHECK(elements[static_cast<int>(s) + 1] == static_cast<std::size_t>(mesh.counts[s].elements));
  }
}
