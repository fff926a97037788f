/// @file
/// A sizing field given by values on the nodes of a mesh, linear in each element.
#pragma once

#include "dovetail/core/box_tree.hpp"
#include "dovetail/core/bytes.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"
#include "dovetail/sizing/bounds.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

/// Interpolates nodal sizes; outside the mesh the value at the nearest point of its boundary, and beside a
/// mesh of triangles at its nearest point. Built in O(n log n), evaluated in O(log n). Throws `sizing_error`
/// when there is not one positive, finite size per node, when the mesh is empty, and when an element is flat
/// or refers to a node that does not exist.
class background_field {
public:
  background_field(simplicial_mesh<3> mesh, std::vector<double> sizes);
  background_field(simplicial_mesh<2> mesh, std::vector<double> sizes)
      : points_(std::move(mesh.points)), sizes_(std::move(sizes)), boundary_(std::move(mesh.elements)) {
    check(boundary_, "triangle");
    plant_trees();
  }

  /// The nodes, elements and sizes, for another process.
  void encode(byte_writer& to) const {
    to.array(points_);
    to.array(elements_);
    to.array(sizes_);
  }
  /// The same field bit for bit, at the cost of building it. Throws `input_error` when the data end early.
  static background_field decode(byte_reader& from);

  double operator()(vec3 p) const;

  double smallest_size_in(const box3& box) const;

private:
  struct nearest_boundary {
    std::size_t side = 0;
    std::array<double, 3> weights{1, 0, 0};
    double distance = std::numeric_limits<double>::infinity();
  };

  vec3 point(local_id i) const { return points_[i]; }
  double size_of(local_id i) const { return sizes_[i]; }

  template <std::size_t N>
  box3 box_of(const std::array<local_id, N>& nodes) const {
    box3 box;
    for (const local_id i : nodes)
      box.include(point(i));
    return box;
  }

  std::array<double, 4> barycentric(const simplex<3>& e, vec3 p) const;

  /// The value in the element that contains p, the one p is deepest in when several do within rounding.
  std::optional<double> interpolated(vec3 p) const;

  nearest_boundary nearest(vec3 p) const;

  /// Lower bound of the linear function of an element over a ball, and over the element.
  double bound_of_element(local_id id, vec3 center, double radius) const;

  template <std::size_t N>
  void check(const std::vector<std::array<local_id, N>>& elements, const char* element) const {
    if (elements.empty())
      throw sizing_error(std::string("the background mesh has no ") + element +
                         "; give one that covers the model");
    if (sizes_.size() != points_.size())
      throw sizing_error("the background mesh has " + std::to_string(points_.size()) + " nodes and " +
                         std::to_string(sizes_.size()) + " sizes; give one size per node");
    for (std::size_t i = 0; i < points_.size(); ++i) {
      sizing::checked_point(points_[i], "node " + std::to_string(i) + " of the background mesh");
      sizing::checked_size(sizes_[i], "the size at node " + std::to_string(i) + " of the background mesh");
    }
    for (std::size_t e = 0; e < elements.size(); ++e)
      for (const local_id i : elements[e])
        if (i < 0 || static_cast<std::size_t>(i) >= points_.size())
          throw sizing_error("element " + std::to_string(e) + " of the background mesh refers to node " +
                             std::to_string(i) + ", which does not exist");
  }

  void plant_trees();

  void collect_boundary();

  std::vector<vec3> points_;
  std::vector<simplex<3>> elements_;
  std::vector<double> sizes_;
  std::vector<simplex<2>> boundary_;
  box_tree element_tree_;
  box_tree boundary_tree_;
};

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/sizing/background.ipp"
#endif
