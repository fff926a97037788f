#include "view_sides.hpp"

#include "dovetail/core/error.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/mesh/simplex_grouping.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

namespace dovetail::app {
namespace {

constexpr std::size_t sides_of_one = 4;

/// The triangles of a file, to be found by their vertices.
class tagged_triangles {
public:
  tagged_triangles(std::span<const simplex<2>> triangles, std::span<const local_id> tags) {
    known_.reserve(triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t)
      known_.emplace_back(sorted_vertices(triangles[t]), t < tags.size() ? tags[t] : 0);
    sort_all(known_);
  }
  std::optional<local_id> tag_of(const simplex<2>& triangle) const {
    const auto vertices = sorted_vertices(triangle);
    const auto found = std::lower_bound(known_.begin(), known_.end(),
                                        std::pair(vertices, std::numeric_limits<local_id>::min()));
    if (found == known_.end() || found->first != vertices)
      return std::nullopt;
    return found->second;
  }

private:
  std::vector<std::pair<simplex<2>, local_id>> known_;
};

/// The vertices of a side by its number, outwards of its element.
simplex<2> side_of(std::span<const simplex<3>> elements, std::size_t number) {
  const simplex<3>& element = elements[number / sides_of_one];
  const auto& local = numbering::sides<3>[number % sides_of_one];
  return {element[local[0]], element[local[1]], element[local[2]]};
}

void require_points(std::span<const simplex<3>> elements, std::size_t points) {
  if (elements.size() > std::numeric_limits<std::uint32_t>::max() / sides_of_one)
    throw mesh_error("a mesh of " + std::to_string(elements.size()) +
                     " elements is too large to be shown from one file; write it in pieces");
  for (std::size_t e = 0; e < elements.size(); ++e)
    for (const local_id v : elements[e])
      if (v < 0 || static_cast<std::size_t>(v) >= points)
        throw mesh_error("element " + std::to_string(e) + " refers to point " + std::to_string(v) +
                         ", but the mesh has " + std::to_string(points) + " points");
}

/// Calls `f(number, first)` for each side of each element, with the least vertex of the side.
template <class F>
void for_each_least(std::span<const simplex<3>> elements, const F& f) {
  for (std::size_t number = 0; number < sides_of_one * elements.size(); ++number) {
    const simplex<2> side = side_of(elements, number);
    f(number, static_cast<std::size_t>(std::min({side[0], side[1], side[2]})));
  }
}

} // namespace

void for_each_side(std::span<const simplex<3>> elements, std::size_t points,
                   const std::function<void(std::span<const std::uint32_t>)>& visit, std::size_t most) {
  require_points(elements, points);
  std::vector<std::uint32_t> counts(points); // of the sides by their least vertex
  for_each_least(elements, [&](std::size_t, std::size_t least) { ++counts[least]; });
  std::vector<std::uint32_t> numbers, members;
  for (std::size_t first = 0, last = 0; first < points; first = last) {
    std::size_t held = counts[first];
    for (last = first + 1; last < points && held + counts[last] <= most; ++last)
      held += counts[last];
    if (held == 0)
      continue;
    numbers.clear();
    numbers.reserve(held);
    for_each_least(elements, [&](std::size_t number, std::size_t least) {
      if (least >= first && least < last)
        numbers.push_back(static_cast<std::uint32_t>(number));
    });
    for_each_group<3>(
        numbers.size(), points, [&](std::size_t i) { return sorted_vertices(side_of(elements, numbers[i])); },
        [&](const auto&, std::span<const std::uint32_t> equal) {
          members.clear();
          for (const std::uint32_t i : equal)
            members.push_back(numbers[i]);
          visit(span_of(std::as_const(members)));
        });
  }
}

seen_sides find_seen_sides(const io::loaded_mesh& mesh, std::span<const local_id> pieces,
                           std::span<const local_id> materials) {
  const std::span<const simplex<3>> elements = span_of(mesh.mesh.elements);
  const tagged_triangles tagged(mesh.triangles, mesh.triangle_tags);
  const auto differ = [](std::span<const local_id> of, std::size_t a, std::size_t b) {
    return !of.empty() && of[a] != of[b];
  };
  seen_sides found;
  for_each_side(elements, mesh.mesh.points.size(), [&](std::span<const std::uint32_t> members) {
    const simplex<2> side = side_of(elements, members[0]);
    const auto tag = mesh.triangles.empty() ? std::nullopt : tagged.tag_of(side);
    const std::size_t a = members.front() / sides_of_one, b = members.back() / sides_of_one;
    if (members.size() == 2 && !tag && !differ(pieces, a, b) && !differ(materials, a, b))
      return;
    for (const std::uint32_t member : members)
      (members.size() == 1 ? found.outer : found.inner)
          .push_back({side_of(elements, member), static_cast<local_id>(member / sides_of_one), tag});
  });
  return found;
}

} // namespace dovetail::app
