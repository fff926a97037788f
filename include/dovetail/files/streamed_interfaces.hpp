/// @file
/// The interfaces of a mesh that was read, and the elements beside them. Readers give no skeleton: sides
/// between elements of two subdomains are found by the numbers of their points.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/mesh/quality_at_interfaces.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace dovetail::io {

/// A piece of a mesh as a reader gives it, or the whole mesh. A view: the arrays live elsewhere.
template <int D>
struct read_piece {
  const simplicial_mesh<D>& mesh;       ///< triangles or tetrahedra
  std::span<const global_id> ids;       ///< the points' global numbers; empty for a whole mesh
  std::span<const local_id> subdomains; ///< per element

  /// The number by which all pieces know a point.
  global_id id_of(local_id v) const { return ids.empty() ? global_id{v} : ids[v]; }
};

/// The points of each subdomain that are on its interfaces.
struct interface_points {
  std::vector<std::pair<local_id, global_id>> of_subdomains; ///< subdomain, number of a point; sorted

  /// Whether this point is on an interface of the subdomain. O(log n).
  bool contains(local_id subdomain, global_id id) const {
    return std::binary_search(of_subdomains.begin(), of_subdomains.end(), std::pair(subdomain, id));
  }
};

/// Finds the interfaces of a mesh that is read piece by piece. They are the sides of exactly two elements,
/// which are of two subdomains and pass the side against each other, as in a skeleton. Further elements at
/// such a side are noticed where they are in the same piece or have the side on the boundary of theirs.
/// Memory: these sides and the boundaries of all pieces.
template <int D>
class streamed_interfaces {
public:
  /// One more piece. About linear. Throws `mesh_error` when an element refers to a point that does not exist.
  void add(const read_piece<D>& piece) {
    for (const local_id s : piece.subdomains) {
      several_ = several_ || s != subdomain_.value_or(s);
      subdomain_ = s;
    }
    const auto table = build_sides(piece.mesh);
    const auto subdomain = [&](local_id e) { return piece.subdomains[e]; };
    for (std::size_t t = 0; t < table.size(); ++t) {
      const auto s = static_cast<local_id>(t);
      const auto [first, second] = table.elements[t];
      if (table.is_interior(s) && subdomain(first) == subdomain(second))
        continue;
      for (const local_id e : table.all_elements(s))
        sides_.push_back(numbered(piece, side_of_element(piece.mesh, table, s, e), subdomain(e)));
    }
  }

  /// Whether there were elements of several subdomains; otherwise there are no interfaces.
  bool has_several_subdomains() const { return several_; }

  /// After all pieces. n log n in the sides.
  interface_points points() {
    sort_all(sides_, [](const side& a, const side& b) { return a.ids < b.ids; });
    interface_points found;
    for (std::size_t i = 0, end; i < sides_.size(); i = end) {
      for (end = i + 1; end < sides_.size() && sides_[end].ids == sides_[i].ids;)
        ++end;
      if (end != i + 2 || sides_[i].subdomain == sides_[i + 1].subdomain ||
          sides_[i].turned == sides_[i + 1].turned)
        continue;
      for (const local_id subdomain : {sides_[i].subdomain, sides_[i + 1].subdomain})
        for (const global_id id : sides_[i].ids)
          found.of_subdomains.emplace_back(subdomain, id);
    }
    sort_unique(found.of_subdomains);
    return found;
  }

private:
  struct side {
    std::array<global_id, D> ids; ///< ascending
    local_id subdomain;           ///< of the element that passes it
    bool turned;                  ///< an odd permutation of the side as this element has it
  };

  static side numbered(const read_piece<D>& piece, const simplex<D - 1>& vertices, local_id subdomain) {
    side result{{}, subdomain, false};
    for (std::size_t k = 0; k < D; ++k)
      result.ids[k] = piece.id_of(vertices[k]);
    for (std::size_t k = 0; k < D; ++k) // each exchange turns it
      for (std::size_t j = k + 1; j < D; ++j)
        result.turned ^= result.ids[j] < result.ids[k];
    std::sort(result.ids.begin(), result.ids.end());
    return result;
  }

  std::vector<side> sides_;           ///< on the boundary of a piece or between subdomains of one
  std::optional<local_id> subdomain_; ///< of the last element
  bool several_ = false;
};

/// Measures the elements of a piece that was read, each subdomain by itself: as `finish_mesh` measures the
/// pieces that were written. n log n.
/// Throws nothing but for a lack of memory.
/// \param piece one of those, or the one, whose interfaces were found
/// \param interfaces of the whole mesh
template <int D>
quality_at_interfaces measure_at_interfaces(const read_piece<D>& piece, const interface_points& interfaces) {
  const auto subdomain = [&](local_id e) { return piece.subdomains[e]; };
  std::vector<local_id> order(piece.subdomains.size());
  std::iota(order.begin(), order.end(), 0);
  stable_sort_all(order, [&](local_id a, local_id b) { return subdomain(a) < subdomain(b); });
  quality_at_interfaces found;
  std::vector<local_id> place(piece.mesh.points.size(), no_id); // of each point in the subdomain
  for (std::size_t i = 0, end; i < order.size(); i = end) {
    simplicial_mesh<D> mesh;
    std::vector<std::uint8_t> on_interface;
    for (end = i; end < order.size() && subdomain(order[end]) == subdomain(order[i]); ++end) {
      simplex<D> element = piece.mesh.elements[order[end]];
      for (local_id& v : element) {
        local_id& placed = place[v];
        if (placed == no_id) {
          placed = static_cast<local_id>(mesh.points.size());
          mesh.points.push_back(piece.mesh.points[v]);
          on_interface.push_back(interfaces.contains(subdomain(order[i]), piece.id_of(v)) ? 1 : 0);
        }
        v = placed;
      }
      mesh.elements.push_back(element);
    }
    for (std::size_t k = i; k < end; ++k)
      for (const local_id v : piece.mesh.elements[order[k]])
        place[v] = no_id;
    found.merge(measure_at_interfaces<D>(mesh, on_interface));
  }
  return found;
}

} // namespace dovetail::io
