/// @file
/// Adapter: the partitions of a file of VTK's HDF format, read one at a time.
#pragma once

#include "dovetail/files/hdf5_input.hpp"
#include "dovetail/files/second_order_nodes.hpp"
#include "dovetail/mesh/loaded_mesh.hpp"
#include "dovetail/mesh/quadratic_element.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::io::detail {

/// Throws `input_error` naming the file and the dataset. What is wrong with how much there is it says at
/// once, about values when they are read.
class hdf5_partitions {
public:
  explicit hdf5_partitions(const std::filesystem::path& path, element_order elements = element_order::first)
      : file_(path) {
    points_ = starts("NumberOfPoints", file_.require_stored(root("Points"), 3, sizeof(double)).rows);
    const auto connectivity = file_.require_stored(root("Connectivity"), 1, sizeof(local_id)).rows;
    const auto ids = starts("NumberOfConnectivityIds", connectivity);
    cells_ = starts("NumberOfCells", file_.extent_of(root("Types")).rows);
    if (cells_.size() != points_.size() || ids.size() != points_.size())
      file_.fail(root("NumberOfCells"), "it is not of as many partitions as NumberOfPoints");
    if (cells_.back() > 0)
      find_nodes(file_.read<std::uint8_t>(root("Types"), 0, 1)[0], elements);
    for (std::size_t p = 0; p < ids.size(); ++p)
      if (ids[p] % nodes_ != 0 || ids[p] / nodes_ != cells_[p])
        file_.fail(root("NumberOfConnectivityIds"), "it is not " + std::to_string(nodes_) +
                                                        " per element as their type, " +
                                                        std::to_string(type_) + ", asks for");
    file_.require(root("Offsets"), {cells_.back() + partitions(), 1});
    has_ghosts_ = file_.has(root("CellData/vtkGhostType"));
    for (const char* of_cells : {"CellData/region", "CellData/subdomain", "CellData/vtkGhostType"})
      if (file_.has(root(of_cells)))
        file_.require(root(of_cells), {cells_.back(), 1});
    file_.require(root("PointData/GlobalNodeIds"), {points_.back(), 1});
    if (has_ghosts_)
      file_.require(root("PointData/vtkGhostType"), {points_.back(), 1});
  }

  const hdf5_input& file() const { return file_; }
  std::size_t partitions() const { return points_.size() - 1; }
  std::uint64_t nodes() const { return nodes_; } ///< per element
  bool has_tetrahedra() const { return nodes_ == 4 || nodes_ == quadratic_nodes<3>; }
  bool has_middles() const { return nodes_ > 4; }
  std::uint64_t first_point(std::size_t p) const { return points_[p]; }
  std::uint64_t first_cell(std::size_t p) const { return cells_[p]; }
  static std::string root(const std::string& name) { return "VTKHDF/" + name; }

  /// Tetrahedra or triangles with their points, as they stand; ghosts are left out.
  loaded_mesh read(std::size_t p) const {
    loaded_mesh mesh;
    const auto points = points_[p + 1] - points_[p], cells = cells_[p + 1] - cells_[p];
    if (std::max(points, nodes_ * cells) > std::numeric_limits<local_id>::max())
      file_.fail(root("NumberOfPoints"), "partition " + std::to_string(p) + " is too large to be read");
    read_points(p, mesh);
    check_types(p);
    const auto nodes = file_.read<std::int64_t>(root("Connectivity"), nodes_ * cells_[p], nodes_ * cells);
    for (const std::int64_t v : nodes)
      if (v < 0 || static_cast<std::uint64_t>(v) >= points)
        file_.fail(root("Connectivity"), "partition " + std::to_string(p) + " has the point " +
                                             std::to_string(v) + ", and " + std::to_string(points) +
                                             " points");
    const auto ghost = has_ghosts_ ? file_.read<std::uint8_t>(root("CellData/vtkGhostType"), cells_[p], cells)
                                   : std::vector<std::uint8_t>();
    const auto region = of_cells("region", p), subdomain = of_cells("subdomain", p);
    const bool is_skeleton = file_.has(root("CellData/front_subdomain")); // subdomains are those behind
    for (std::size_t c = 0; c < cells; ++c) {
      if (has_ghosts_ && ghost[c] != 0)
        continue;
      const std::span of_element(&nodes[nodes_ * c], nodes_);
      if (has_tetrahedra()) {
        add_element<3>(of_element, mesh.mesh.elements, mesh.middles);
        mesh.mesh.tags.push_back(region.empty() ? 0 : region[c]);
        if (!subdomain.empty())
          mesh.subdomains.push_back(subdomain[c]);
      } else {
        add_element<2>(of_element, mesh.triangles, mesh.triangle_middles);
        mesh.triangle_tags.push_back(region.empty() ? 0 : region[c]);
        if (!subdomain.empty() && !is_skeleton) {
          mesh.triangle_subdomains.push_back(subdomain[c]);
          mesh.pass_over("the subdomains of triangles");
        }
      }
    }
    if (has_ghosts_)
      drop_points_of_ghosts(p, mesh);
    return mesh;
  }
  /// An array of the elements of a partition; empty where the file has none of that name.
  std::vector<local_id> of_cells(const std::string& name, std::size_t p) const {
    const std::string array = root("CellData/" + name);
    if (!file_.has(array))
      return {};
    return file_.read<local_id>(array, cells_[p], cells_[p + 1] - cells_[p]);
  }

private:
  /// Where each partition begins, and the end.
  std::vector<std::uint64_t> starts(const std::string& name, std::uint64_t all) const {
    std::vector<std::uint64_t> begins{0};
    for (const std::int64_t count : file_.read_list<std::int64_t>(root(name))) {
      if (count < 0 || static_cast<std::uint64_t>(count) > all - begins.back())
        file_.fail(root(name), "partition " + std::to_string(begins.size() - 1) + " has " +
                                   std::to_string(count) + " entries, more than there are");
      begins.push_back(begins.back() + static_cast<std::uint64_t>(count));
    }
    if (begins.back() != all || begins.size() < 2)
      file_.fail(root(name), "the partitions do not add up to what there is");
    return begins;
  }
  void find_nodes(std::uint8_t type, element_order elements) {
    type_ = type;
    const bool quadratic = type == 24 || type == 22;
    if (quadratic && elements == element_order::first)
      file_.fail(root("Types"), "elements of second order are not read, and without --order 2 they are of "
                                "first order");
    if (!quadratic && type != 10 && type != 5)
      file_.fail(root("Types"), "elements of type " + std::to_string(type) +
                                    " are not read; those of tetrahedra and triangles, 10 and 5, are");
    nodes_ = quadratic ? (type == 24 ? quadratic_nodes<3> : quadratic_nodes<2>) : (type == 10 ? 4 : 3);
  }
  void check_types(std::size_t p) const {
    const auto cells = cells_[p + 1] - cells_[p];
    for (const auto type : file_.read<std::uint8_t>(root("Types"), cells_[p], cells))
      if (type != type_)
        file_.fail(root("Types"),
                   "it has elements of the types " + std::to_string(type_) + " and " + std::to_string(type));
    const auto offsets = file_.read<std::int64_t>(root("Offsets"), cells_[p] + p, cells + 1);
    for (std::size_t c = 0; c < offsets.size(); ++c)
      if (offsets[c] < 0 || static_cast<std::uint64_t>(offsets[c]) != nodes_ * c)
        file_.fail(root("Offsets"), "element " + std::to_string(c) + " of partition " + std::to_string(p) +
                                        " begins at " + std::to_string(offsets[c]) + ", not at " +
                                        std::to_string(nodes_ * c));
  }
  void read_points(std::size_t p, loaded_mesh& mesh) const {
    const auto points = points_[p + 1] - points_[p];
    const auto values = file_.read<double>(root("Points"), points_[p], points);
    for (std::size_t v = 0; v < points; ++v)
      mesh.mesh.points.push_back({values[3 * v], values[3 * v + 1], values[3 * v + 2]});
    if (!std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); }))
      file_.fail(root("Points"), "a coordinate in partition " + std::to_string(p) + " is not finite");
    mesh.node_ids = file_.read<global_id>(root("PointData/GlobalNodeIds"), points_[p], points);
    for (const global_id id : mesh.node_ids)
      if (id < 0)
        file_.fail(root("PointData/GlobalNodeIds"), "the number " + std::to_string(id) + " is negative");
  }
  template <int D>
  static void add_element(std::span<const std::int64_t> nodes, std::vector<simplex<D>>& elements,
                          std::vector<std::array<local_id, edges_per_element<D>>>& middles) {
    quadratic_simplex<D> vertices{};
    std::transform(nodes.begin(), nodes.end(), vertices.begin(),
                   [](std::int64_t v) { return static_cast<local_id>(v); });
    append_element<D>(vertices, nodes.size() == vertices.size(), elements, middles);
  }
  /// Points that another rank owns, and that no element which is left has.
  void drop_points_of_ghosts(std::size_t p, loaded_mesh& mesh) const {
    auto& points = mesh.mesh.points;
    const auto of_other = file_.read<std::uint8_t>(root("PointData/vtkGhostType"), points_[p], points.size());
    std::vector<local_id> place(points.size(), no_id);
    const auto use = [&](const auto& simplices) {
      for (const auto& vertices : simplices)
        for (const local_id v : vertices)
          place[v] = 0;
    };
    use(mesh.mesh.elements);
    use(mesh.triangles);
    use(mesh.middles);
    use(mesh.triangle_middles);
    std::size_t kept = 0;
    for (std::size_t v = 0; v < points.size(); ++v) {
      if (place[v] == no_id && of_other[v] != 0)
        continue;
      points[kept] = points[v];
      mesh.node_ids[kept] = mesh.node_ids[v];
      place[v] = static_cast<local_id>(kept++);
    }
    points.resize(kept);
    mesh.node_ids.resize(kept);
    const auto renumber = [&](auto& simplices) {
      for (auto& vertices : simplices)
        for (local_id& v : vertices)
          v = place[v];
    };
    renumber(mesh.mesh.elements);
    renumber(mesh.triangles);
    renumber(mesh.middles);
    renumber(mesh.triangle_middles);
  }

  hdf5_input file_;
  std::vector<std::uint64_t> points_, cells_; ///< where each partition begins, and the end
  std::uint64_t nodes_ = 4;                   ///< per element
  std::uint8_t type_ = 10;
  bool has_ghosts_ = false;
};

} // namespace dovetail::io::detail
