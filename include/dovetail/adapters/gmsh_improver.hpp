/// @file
/// Gmsh's optimiser of tetrahedra as an improver.
#pragma once

#include "dovetail/adapters/library_pieces.hpp"
#include "dovetail/distributed/run_in_child.hpp"

#include <gmsh.h>

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

namespace dovetail {

namespace improvement {

/// Gmsh's own optimiser: swaps of edges and sides and moves of vertices, by the radius ratio. Models
/// `improver<gmsh, 3>`. It knows neither sizes nor inner frozen sides: a result that lost one is not used
/// (see `improve_by_library`). Each call forks a child, which is the only process to call Gmsh: the calling
/// one must have one thread only (`usage_error` otherwise).
struct gmsh {
  static constexpr improver_traits traits{.thread_safe = false};

  double threshold = 0.5;      ///< elements with a smaller radius ratio are worked on; 0.3 is Gmsh's default
  int repeats = 1;             ///< runs of the optimiser
  double limit_seconds = 3600; ///< the child's wall clock; the last resort

  report operator()(simplicial_mesh<3>& mesh, const frozen_entities<3>& frozen = {},
                    const any_sizing& = {}) const;
};

namespace detail {

/// One use of Gmsh, in a process that ends right after it.
inline simplicial_mesh<3> optimise_with_gmsh(const gmsh& parameters, const library_piece& piece) {
  ::gmsh::initialize(0, nullptr, false);
  const auto set = [](const char* option, double value) { ::gmsh::option::setNumber(option, value); };
  set("General.Terminal", 0);
  set("General.NumThreads", 1);
  set("Mesh.OptimizeThreshold", parameters.threshold);
  ::gmsh::model::add("piece");

  constexpr int triangle_type = 2, tetrahedron_type = 4;
  const auto flat = [](const auto& elements) {
    std::vector<std::size_t> nodes;
    for (const auto& element : elements)
      for (const local_id v : element)
        nodes.push_back(static_cast<std::size_t>(v) + 1);
    return nodes;
  };
  const auto add_nodes = [&](int dimension, int entity, std::size_t begin, std::size_t end) {
    std::vector<std::size_t> tags(end - begin);
    std::iota(tags.begin(), tags.end(), begin + 1);
    std::vector<double> coordinates;
    for (std::size_t v = begin; v < end; ++v)
      for (int axis = 0; axis < 3; ++axis)
        coordinates.push_back(piece.mesh.points[v][axis]);
    ::gmsh::model::mesh::addNodes(dimension, entity, tags, coordinates);
  };
  const auto count_from = [](std::size_t first, std::size_t count) {
    std::vector<std::size_t> tags(count);
    std::iota(tags.begin(), tags.end(), first);
    return tags;
  };
  // Nodes of the surface are not moved.
  const int surface = ::gmsh::model::addDiscreteEntity(2);
  const int volume = ::gmsh::model::addDiscreteEntity(3, -1, {surface});
  add_nodes(2, surface, 0, piece.fixed_points);
  add_nodes(3, volume, piece.fixed_points, piece.mesh.points.size());
  ::gmsh::model::mesh::addElementsByType(surface, triangle_type, count_from(1, piece.boundary.size()),
                                         flat(piece.boundary));
  ::gmsh::model::mesh::addElementsByType(volume, tetrahedron_type,
                                         count_from(piece.boundary.size() + 1, piece.mesh.elements.size()),
                                         flat(piece.mesh.elements));
  const bool also_discrete = true;
  for (int k = 0; k < parameters.repeats; ++k)
    ::gmsh::model::mesh::optimize("", also_discrete);

  simplicial_mesh<3> made;
  std::vector<std::size_t> nodes;
  std::vector<double> coordinates, unused;
  ::gmsh::model::mesh::getNodes(nodes, coordinates, unused, -1, -1, false, false);
  std::vector<local_id> index(nodes.empty() ? 0 : *std::max_element(nodes.begin(), nodes.end()) + 1, no_id);
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    index[nodes[k]] = static_cast<local_id>(k);
    made.points.push_back({coordinates[3 * k], coordinates[3 * k + 1], coordinates[3 * k + 2]});
  }
  std::vector<std::size_t> tags, corners;
  ::gmsh::model::mesh::getElementsByType(tetrahedron_type, tags, corners);
  made.elements.resize(tags.size());
  for (std::size_t e = 0; e < tags.size(); ++e)
    for (std::size_t k = 0; k < 4; ++k)
      made.elements[e][k] = index[corners[4 * e + k]];
  return made;
}

} // namespace detail

inline report gmsh::operator()(simplicial_mesh<3>& mesh, const frozen_entities<3>& frozen,
                               const any_sizing&) const {
  return improve_by_library("Gmsh", mesh, frozen, [this](const library_piece& piece) {
    return run_in_child("its process", limit_seconds, [&] {
      try {
        return detail::optimise_with_gmsh(*this, piece);
      } catch (const std::string& text) { // what Gmsh throws
        throw mesher_error(text);
      }
    });
  });
}

} // namespace improvement

static_assert(improver<improvement::gmsh, 3>);

} // namespace dovetail
