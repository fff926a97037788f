/// @file
/// What `quality_at_interfaces.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/quality.ipp"
#include "dovetail/mesh/quality_at_interfaces.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace dovetail {

namespace detail {

/// Per point of a piece whether it is on one of its interfaces. A side with the piece on both of its sides is
/// none.
template <int D>
std::vector<std::uint8_t> points_on_interfaces(const simplicial_piece<D>& piece,
                                               const simplicial_skeleton<D>& skeleton,
                                               std::span<const local_id> listed) {
  std::vector<local_id> on_interfaces; // by their numbers in the skeleton
  for (const local_id s : listed) {
    const auto [behind, front] = skeleton.subdomains[s];
    if (front == no_id || front == behind)
      continue;
    const auto& side = skeleton.sides[s];
    on_interfaces.insert(on_interfaces.end(), side.begin(), side.end());
  }
  sort_all(on_interfaces);
  std::vector<std::uint8_t> marked(piece.mesh.points.size(), 0);
  for (std::size_t v = 0; v < piece.skeleton_points.size(); ++v)
    marked[v] =
        std::binary_search(on_interfaces.begin(), on_interfaces.end(), piece.skeleton_points[v]) ? 1 : 0;
  return marked;
}

/// The elements of a piece by their distance from its interfaces.
template <int D>
class interface_rings {
public:
  interface_rings(const simplicial_mesh<D>& mesh, std::vector<std::uint8_t> on_interface)
      : mesh_(mesh), on_interface_(std::move(on_interface)), reached_(on_interface_) {
    for (const simplex<D>& element : mesh.elements)
      if (has_one_in(element, on_interface_))
        for (const local_id v : element)
          reached_[v] = 1;
  }

  void add(std::size_t element, double smallest_angle) {
    const simplex<D>& vertices = mesh_.elements[element];
    ring_quality& ring = has_one_in(vertices, on_interface_) ? found_.touching
                         : has_one_in(vertices, reached_)    ? found_.next_ring
                                                             : found_.rest;
    ring.add(smallest_angle);
  }

  const quality_at_interfaces& found() const { return found_; }

private:
  static bool has_one_in(const simplex<D>& element, const std::vector<std::uint8_t>& marked) {
    return std::any_of(element.begin(), element.end(), [&](local_id v) { return marked[v] != 0; });
  }

  const simplicial_mesh<D>& mesh_;
  std::vector<std::uint8_t> on_interface_; ///< per point
  std::vector<std::uint8_t> reached_;      ///< per point: of an element that touches
  quality_at_interfaces found_;
};

} // namespace detail

template <int D>
quality_at_interfaces measure_at_interfaces(const simplicial_mesh<D>& mesh,
                                            const std::vector<std::uint8_t>& on_interface) {
  detail::interface_rings<D> rings(mesh, on_interface);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    rings.add(e, extreme_dihedral_angles(corners(span_of(mesh.points), mesh.elements[e]))[0]);
  return rings.found();
}

template <int D>
piece_quality measure_piece(const simplicial_mesh<D>& mesh, std::vector<std::uint8_t> on_interface) {
  if (on_interface.empty())
    return {measure_quality(mesh)};
  on_interface.resize(mesh.points.size(), 0);
  detail::interface_rings<D> rings(mesh, std::move(on_interface));
  auto all =
      detail::measure_each(mesh, [&](std::size_t e, double smallest_angle) { rings.add(e, smallest_angle); });
  return {std::move(all), rings.found()};
}

template <int D>
quality_at_interfaces measure_at_interfaces(const simplicial_piece<D>& piece,
                                            const simplicial_skeleton<D>& skeleton,
                                            std::span<const local_id> listed) {
  return measure_at_interfaces<D>(piece.mesh, detail::points_on_interfaces(piece, skeleton, listed));
}

#ifdef DOVETAIL_COMPILED
template piece_quality measure_piece<2>(const simplicial_mesh<2>& mesh,
                                        std::vector<std::uint8_t> on_interface);
template piece_quality measure_piece<3>(const simplicial_mesh<3>& mesh,
                                        std::vector<std::uint8_t> on_interface);
template quality_at_interfaces measure_at_interfaces<2>(const simplicial_mesh<2>& mesh,
                                                        const std::vector<std::uint8_t>& on_interface);
template quality_at_interfaces measure_at_interfaces<3>(const simplicial_mesh<3>& mesh,
                                                        const std::vector<std::uint8_t>& on_interface);
template quality_at_interfaces measure_at_interfaces<2>(const simplicial_piece<2>& piece,
                                                        const simplicial_skeleton<2>& skeleton,
                                                        std::span<const local_id> listed);
template quality_at_interfaces measure_at_interfaces<3>(const simplicial_piece<3>& piece,
                                                        const simplicial_skeleton<3>& skeleton,
                                                        std::span<const local_id> listed);
#endif

} // namespace dovetail
