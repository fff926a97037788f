/// @file
/// Adapter: reads the HDF5 file of all ranks as `xdmf_format` writes it, and finds out whether the ranks'
/// numbers are right.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/files/hdf5_input.hpp"
#include "dovetail/files/piece_visitor.hpp"
#include "dovetail/files/second_order_nodes.hpp"
#include "dovetail/files/xdmf_input.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/mesh/loaded_mesh.hpp"
#include "dovetail/mesh/quadratic_element.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace dovetail::io {

namespace detail {

/// Reads the arrays into one mesh.
class hdf5_rank_arrays {
public:
  hdf5_rank_arrays(const std::filesystem::path& path, element_order elements) : file_(path) {
    const auto cells = file_.extent_of(cells_name);
    const bool quadratic = cells.columns == quadratic_nodes<3> || cells.columns == quadratic_nodes<2>;
    if (quadratic && elements == element_order::first)
      file_.fail(cells_name, "elements of second order are not read, and without --order 2 they are of first "
                             "order");
    if (!quadratic && cells.columns != 4 && cells.columns != 3)
      file_.fail(cells_name, "elements of " + std::to_string(cells.columns) + " vertices are not read");
    nodes_ = cells.columns;
    corners_ = nodes_ == 4 || nodes_ == quadratic_nodes<3> ? 4 : 3;
    elements_ = file_.require_stored(cells_name, nodes_, sizeof(global_id)).rows;
    vertices_ = file_.require_stored("geometry/vertices", 3, sizeof(double)).rows;
    sides_ = file_.require_stored("sides/vertices", corners_ - 1, sizeof(global_id)).rows;
    for (const std::uint64_t count : {elements_, vertices_, sides_})
      if (count > std::numeric_limits<local_id>::max() / 4)
        file_.fail(cells_name, "the mesh is too large to be read at once");
    first_vertex_ = starts("ranks/first_vertex", vertices_);
    first_cell_ = starts("ranks/first_cell", elements_);
    first_side_ = starts("ranks/first_side", sides_);
    if (first_cell_.size() != first_vertex_.size() || first_side_.size() != first_vertex_.size())
      file_.fail("ranks/first_cell", "it has other ranks than ranks/first_vertex");
  }

  loaded_mesh read() {
    mesh_.node_ids = numbers("vertices/mesh_node", vertices_);
    const auto elements = numbers("cells/mesh_element", elements_);
    const auto values = file_.read<double>("geometry/vertices", 0, vertices_);
    for (std::size_t v = 0; v < vertices_; ++v) {
      mesh_.mesh.points.push_back({values[3 * v], values[3 * v + 1], values[3 * v + 2]});
      if (!std::isfinite(values[3 * v]) || !std::isfinite(values[3 * v + 1]) ||
          !std::isfinite(values[3 * v + 2]))
        file_.fail("geometry/vertices", "a coordinate of vertex " + std::to_string(v) + " is not finite");
    }
    auto tags = array("cells/region", elements_, file_.extent_of("names/regions").rows);
    mesh_.pass_over(names_in_hdf5);
    auto subdomains = array("cells/subdomain", elements_, any_number);
    check_subdomains(elements, subdomains);
    if (corners_ == 4) {
      read_elements<3>(mesh_.mesh.elements, mesh_.middles);
      mesh_.mesh.tags = std::move(tags);
      mesh_.subdomains = std::move(subdomains);
      check_sides();
    } else {
      read_elements<2>(mesh_.triangles, mesh_.triangle_middles);
      mesh_.triangle_tags = std::move(tags);
      mesh_.triangle_subdomains = std::move(subdomains);
      mesh_.pass_over("the subdomains of triangles");
      vertices_of<2>("sides/vertices", sides_);
    }
    return std::move(mesh_);
  }

  /// Compares the XDMF file beside it.
  void check_index(const std::filesystem::path& path) const {
    const xdmf_input index(path);
    const auto grids = index.read();
    if (grids.size() != 1 || grids[0].elements != elements_)
      index.fail("it has not one grid of " + std::to_string(elements_) + " elements");
    for (const xdmf_slab& slab : grids[0].arrays) {
      if (slab.file != file_.path() || slab.rows != slab.all)
        index.fail("its grid is not of the whole of " + file_.path().filename().string());
      if (file_.extent_of(slab.dataset) != hdf5_input::extent{slab.all, slab.columns})
        index.fail(slab.dataset + " has other dimensions in " + file_.path().filename().string());
    }
  }

private:
  static constexpr const char* cells_name = "viz/topology/cells";
  static constexpr const char* pieces_name = "pieces/first_element";
  static constexpr std::uint64_t any_number = std::numeric_limits<local_id>::max();

  std::uint64_t rows_or(const std::string& name, std::uint64_t otherwise) const {
    return file_.has(name) ? file_.extent_of(name).rows : otherwise;
  }

  std::vector<global_id> starts(const std::string& name, std::uint64_t end) const {
    auto firsts = file_.read_list<global_id>(name);
    if (firsts.size() < 2 || firsts.front() != 0 || static_cast<std::size_t>(firsts.back()) != end ||
        !std::is_sorted(firsts.begin(), firsts.end()))
      file_.fail(name, "the numbers do not grow from 0 to " + std::to_string(end));
    return firsts;
  }
  /// Those of the mesh that was shared out, each once.
  std::vector<global_id> numbers(const std::string& name, std::uint64_t count) const {
    file_.require(name, {count, 1});
    auto all = file_.read<global_id>(name, 0, count);
    auto sorted = all;
    sort_all(sorted);
    if (!sorted.empty() && sorted.front() < 0)
      file_.fail(name, "the number " + std::to_string(sorted.front()) + " is negative");
    if (const auto twice = std::adjacent_find(sorted.begin(), sorted.end()); twice != sorted.end())
      file_.fail(name, "the number " + std::to_string(*twice) + " is there twice");
    return all;
  }
  std::vector<local_id> array(const std::string& name, std::uint64_t count, std::uint64_t end) const {
    file_.require(name, {count, 1});
    auto values = file_.read<local_id>(name, 0, count);
    for (std::size_t i = 0; i < values.size(); ++i)
      if (values[i] < 0 || static_cast<std::uint64_t>(values[i]) >= end)
        file_.fail(name, "entry " + std::to_string(i) + " is " + std::to_string(values[i]) +
                             ", and there are " + std::to_string(end));
    return values;
  }
  /// Rows of N vertices each.
  template <std::size_t N>
  std::vector<std::array<local_id, N>> vertices_of(const std::string& name, std::uint64_t count) const {
    const auto ids = file_.read<global_id>(name, 0, count);
    std::vector<std::array<local_id, N>> result(count);
    for (std::size_t i = 0; i < ids.size(); ++i) {
      if (ids[i] < 0 || static_cast<std::uint64_t>(ids[i]) >= vertices_)
        file_.fail(name, "row " + std::to_string(i / N) + " has the vertex " + std::to_string(ids[i]) +
                             ", and there are " + std::to_string(vertices_));
      result[i / N][i % N] = static_cast<local_id>(ids[i]);
    }
    return result;
  }
  template <int D>
  void read_elements(std::vector<simplex<D>>& elements,
                     std::vector<std::array<local_id, edges_per_element<D>>>& middles) const {
    if (nodes_ == corners_) {
      elements = vertices_of<D + 1>(cells_name, elements_);
      return check_owners(elements);
    }
    const auto nodes = vertices_of<quadratic_nodes<D>>(cells_name, elements_);
    check_owners(nodes);
    for (const auto& of_element : nodes)
      append_element<D>(of_element, true, elements, middles);
  }

  /// An element is of the subdomain that has its number. Older files have no table of that.
  void check_subdomains(const std::vector<global_id>& elements,
                        const std::vector<local_id>& subdomains) const {
    if (!file_.has(pieces_name))
      return;
    const auto first = file_.read_list<global_id>(pieces_name);
    const auto of_piece = [&](global_id element) {
      return static_cast<std::ptrdiff_t>(std::upper_bound(first.begin(), first.end(), element) -
                                         first.begin()) -
             1;
    };
    for (std::size_t e = 0; e < elements.size(); ++e)
      if (of_piece(elements[e]) != subdomains[e])
        file_.fail("cells/subdomain", "entry " + std::to_string(e) + " is " + std::to_string(subdomains[e]) +
                                          ", and by its number the element is of " +
                                          std::to_string(of_piece(elements[e])));
  }

  /// The lowest rank that has an element at a vertex owns it.
  template <class Simplices>
  void check_owners(const Simplices& elements) const {
    std::vector<bool> seen(vertices_, false);
    for (std::size_t q = 0; q + 1 < first_cell_.size(); ++q)
      for (global_id e = first_cell_[q]; e < first_cell_[q + 1]; ++e)
        for (const local_id v : elements[e])
          if (!seen[v]) {
            seen[v] = true;
            if (v < first_vertex_[q] || v >= first_vertex_[q + 1])
              file_.fail("ranks/first_vertex", "vertex " + std::to_string(v) + " is not of rank " +
                                                   std::to_string(q) +
                                                   ", the lowest that has an element at it");
          }
  }

  /// Each is a side of an element of its rank, turned outwards of one.
  void check_sides() {
    mesh_.triangles = vertices_of<3>("sides/vertices", sides_);
    mesh_.triangle_tags = array("sides/cad", sides_, rows_or("names/faces", any_number));
    array("sides/patch", sides_, file_.extent_of("names/patches").rows);
    const auto table = build_sides(mesh_.mesh);
    const auto fail = [&](std::size_t s, const std::string& what) {
      file_.fail("sides/vertices", "side " + std::to_string(s) + " " + what);
    };
    for (std::size_t q = 0; q + 1 < first_side_.size(); ++q) {
      std::vector<local_id> sides;
      for (auto s = static_cast<std::size_t>(first_side_[q]);
           s < static_cast<std::size_t>(first_side_[q + 1]); ++s) {
        const local_id side = find_side<3>(table, mesh_.triangles[s]);
        if (side == no_id)
          fail(s, "is none of an element");
        sides.push_back(side);
        bool outwards = false;
        for (const local_id e : table.all_elements(side))
          outwards = outwards || (e >= first_cell_[q] && e < first_cell_[q + 1] &&
                                  same_turn(side_of_element(mesh_.mesh, table, side, e), mesh_.triangles[s]));
        if (!outwards)
          fail(s, "is not turned outwards of an element of its rank, " + std::to_string(q));
      }
      sort_all(sides);
      if (const auto twice = std::adjacent_find(sides.begin(), sides.end()); twice != sides.end())
        fail(static_cast<std::size_t>(first_side_[q]),
             "or a later one is twice in rank " + std::to_string(q));
    }
  }

  hdf5_input file_;
  loaded_mesh mesh_;
  std::uint64_t nodes_ = 0, corners_ = 0; ///< per element
  std::uint64_t elements_ = 0, vertices_ = 0, sides_ = 0;
  std::vector<global_id> first_vertex_, first_cell_, first_side_; ///< per rank, and the end
};

} // namespace detail

/// Reads `<stem>.h5` of `xdmf_format`, and compares `<stem>.xdmf` beside it, where there is one. Numbers of
/// points are those of the mesh that was shared out (`mesh_node`). The vertices of a rank must be those that
/// it has to own, and sides on the CAD model, the triangles of the result, sides of its elements.
///
/// Throws `input_error` naming the file and the dataset for whatever is not so, and for elements of second
/// order unless they are asked for. n log n. Memory: the whole mesh.
/// \param file either of the two
/// \param elements whether elements of second order are taken
inline loaded_mesh read_hdf5_ranks(const std::filesystem::path& file,
                                   element_order elements = element_order::first) {
  auto arrays = file, index = file;
  arrays.replace_extension(".h5");
  index.replace_extension(".xdmf");
  std::error_code failure;
  detail::hdf5_rank_arrays input(arrays, elements);
  if (file == index || std::filesystem::exists(index, failure))
    input.check_index(index);
  loaded_mesh mesh = input.read();
  mesh.files = {arrays};
  return mesh;
}

} // namespace dovetail::io
