#include "compare_pictures.hpp"

#include "colours.hpp"
#include "compare_rows.hpp"

#include "dovetail/mesh/quality.hpp"
#include "raster_render.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <vector>

namespace dovetail::app {
namespace {

constexpr int picture_width = 1120; // the page shows them at half of that, a browser's zoom all of it
constexpr int picture_height = 800;
constexpr rgb red{205, 40, 40};
constexpr rgb orange{240, 150, 30};
constexpr rgb blue{70, 120, 200};
constexpr rgb drawn_outline{120, 125, 135};

raster_image rendered(const raster_scene& scene, vec3 from = oblique_direction()) {
  const raster_view view = fitted(view_from(from), scene, picture_width, picture_height);
  return render(scene, view, picture_width, picture_height, 2);
}

vec3 center_of(const std::array<vec3, 3>& p) {
  return (p[0] + p[1] + p[2]) / 3;
}

/// The middle of each subdomain's boundary.
std::vector<vec3> centers_of_subdomains(const fine_skeleton& skeleton) {
  std::vector<vec3> sums;
  std::vector<double> areas;
  for (std::size_t t = 0; t < skeleton.sides.size(); ++t) {
    const auto p = corners(std::span(skeleton.points), skeleton.sides[t]);
    const double area = norm(cross(p[1] - p[0], p[2] - p[0]));
    for (const local_id s : skeleton.subdomains[t]) {
      if (s == no_id)
        continue;
      const auto at = static_cast<std::size_t>(s);
      if (at >= sums.size()) {
        sums.resize(at + 1);
        areas.resize(at + 1, 0);
      }
      sums[at] += area * center_of(p);
      areas[at] += area;
    }
  }
  for (std::size_t s = 0; s < sums.size(); ++s)
    sums[s] = areas[s] > 0 ? sums[s] / areas[s] : vec3{};
  return sums;
}

/// A triangle and its edges, in a dark shade of its colour: where triangles are too small to be told apart
/// the colour is left.
void add_with_edges(raster_scene& scene, const std::array<vec3, 3>& p, rgb colour) {
  scene.triangles.push_back({p, colour});
  for (std::size_t k = 0; k < 3; ++k)
    scene.lines.push_back({{p[k], p[(k + 1) % 3]}, darkened(colour, 0.4), 0.6});
}

/// The edges on CAD curves.
void add_outline(raster_scene& scene, const fine_skeleton& skeleton) {
  for (const auto& [a, b] : skeleton.curve_edges)
    scene.lines.push_back({{skeleton.points[a], skeleton.points[b]}, drawn_outline, 1.6});
}

void add_outline(raster_scene& scene, const simplicial_skeleton<2>& skeleton) {
  for (std::size_t e = 0; e < skeleton.sides.size(); ++e)
    if (skeleton.side_hosts[e] != no_id)
      scene.lines.push_back({corners(std::span(skeleton.points), skeleton.sides[e]), drawn_outline, 1.6});
}

/// Without perspective a line moved towards the viewer is seen at the same place, and nothing hides it.
raster_line lifted(raster_line line, vec3 towards) {
  for (vec3& p : line.ends)
    p += towards;
  return line;
}

template <int D>
struct ranked_element {
  double angle;
  local_id piece;
  local_id element;
  std::array<vec3, D + 1> corners;

  friend bool operator<(const ranked_element& a, const ranked_element& b) {
    return std::tie(a.angle, a.piece, a.element) < std::tie(b.angle, b.piece, b.element);
  }
};

/// The elements with the smallest angles, the worst first.
template <int D>
std::vector<ranked_element<D>> worst_elements(const distributed_simplicial_mesh<D>& mesh) {
  std::vector<ranked_element<D>> worst; // a heap, the best of them on top
  for (std::size_t p = 0; p < mesh.counts.size(); ++p) {
    const auto piece = mesh.load(static_cast<local_id>(p));
    for (std::size_t e = 0; e < piece.mesh.elements.size(); ++e) {
      const auto at = corners(std::span(piece.mesh.points), piece.mesh.elements[e]);
      const auto angles = dihedral_angles(at);
      const ranked_element<D> here{*std::min_element(angles.begin(), angles.end()), static_cast<local_id>(p),
                                   static_cast<local_id>(e), at};
      if (worst.size() == worst_elements_shown) {
        if (!(here < worst.front()))
          continue;
        std::pop_heap(worst.begin(), worst.end());
        worst.pop_back();
      }
      worst.push_back(here);
      std::push_heap(worst.begin(), worst.end());
    }
  }
  std::sort(worst.begin(), worst.end());
  return worst;
}

/// The triangles that bound an element: its sides, or itself.
void add_faces(raster_scene& scene, const std::array<vec3, 4>& p, rgb colour) {
  for (const auto& side : numbering::sides<3>)
    add_with_edges(scene, {p[side[0]], p[side[1]], p[side[2]]}, colour);
}
void add_faces(raster_scene& scene, const std::array<vec3, 3>& p, rgb colour) {
  add_with_edges(scene, p, colour);
}

/// An element, scaled about its middle if it is smaller than `least` across.
template <int D>
void add_element(raster_scene& scene, const ranked_element<D>& element, double least) {
  const element_words words = words_of(D);
  auto p = element.corners;
  vec3 middle{};
  for (const vec3 corner : p)
    middle += corner / static_cast<double>(D + 1);
  double radius = 0;
  for (const vec3 corner : p)
    radius = std::max(radius, distance(corner, middle));
  const double factor = std::max(1.0, least / std::max(2 * radius, 1e-300));
  for (vec3& corner : p)
    corner = middle + factor * (corner - middle);
  add_faces(scene, p, element.angle < words.bad ? red : element.angle < words.low ? orange : blue);
}

} // namespace

raster_image picture_of_decomposition(const generated<3>& result) {
  const fine_skeleton& skeleton = result.mesh.skeleton;
  constexpr double explosion = 0.35; // of the way from the middle of all to one's own
  box3 box;
  for (const vec3 p : skeleton.points)
    box.include(p);
  const std::vector<vec3> centers = centers_of_subdomains(skeleton);
  raster_scene scene;
  for (std::size_t t = 0; t < skeleton.sides.size(); ++t)
    for (const local_id s : skeleton.subdomains[t]) {
      if (s == no_id)
        continue;
      auto p = corners(std::span(skeleton.points), skeleton.sides[t]);
      for (vec3& corner : p)
        corner += explosion * (centers[s] - box.center());
      add_with_edges(scene, p, colour_of_number(s));
    }
  return rendered(scene);
}

raster_image picture_of_decomposition(const generated<2>& result) {
  raster_scene scene;
  for (std::size_t s = 0; s < result.mesh.counts.size(); ++s) {
    const auto piece = result.mesh.load(static_cast<local_id>(s));
    for (const simplex<2>& triangle : piece.mesh.elements)
      add_with_edges(scene, corners(std::span(piece.mesh.points), triangle),
                     colour_of_number(static_cast<local_id>(s)));
  }
  add_outline(scene, result.mesh.skeleton);
  return rendered(scene, direction_to_viewer(scene.bounds()));
}

raster_image picture_of_interfaces(const generated<3>& result) {
  const fine_skeleton& skeleton = result.mesh.skeleton;
  const interface_angles& angles = result.fine_angles;
  raster_scene scene;
  add_outline(scene, skeleton);
  for (std::size_t t = 0; t < skeleton.sides.size(); ++t)
    if (skeleton.side_hosts[t] == no_id) {
      const auto& [first, second] = skeleton.subdomains[t];
      add_with_edges(scene, corners(std::span(skeleton.points), skeleton.sides[t]),
                     colour_of_number(first + 3 * second));
    }
  const vec3 before_all = 2 * scene.bounds().diagonal() * oblique_direction();
  const auto mark = [&](local_id a, local_id b) {
    scene.lines.push_back(lifted({{skeleton.points[a], skeleton.points[b]}, red, 5}, before_all));
  };
  for (const angle_violation& violation : angles.violations) {
    if (violation.is_dihedral()) {
      mark(violation.edge[0], violation.edge[1]);
      continue;
    }
    const auto& triangle = skeleton.sides[violation.sides[0]];
    for (std::size_t k = 0; k < 3; ++k)
      mark(triangle[k], triangle[(k + 1) % 3]);
  }
  return rendered(scene);
}

raster_image picture_of_interfaces(const generated<2>& result) {
  constexpr double arm = 0.012; // of the model's diagonal
  const simplicial_skeleton<2>& skeleton = result.mesh.skeleton;
  raster_scene scene;
  add_outline(scene, skeleton);
  for (std::size_t e = 0; e < skeleton.sides.size(); ++e)
    if (skeleton.side_hosts[e] == no_id)
      scene.lines.push_back({corners(std::span(skeleton.points), skeleton.sides[e]), blue, 3});
  const vec3 from = direction_to_viewer(scene.bounds());
  const double diagonal = scene.bounds().diagonal();
  const raster_view view = view_from(from);
  for (const angle_violation& violation : result.fine_angles.violations) {
    // The vertices of lines are those of the background mesh.
    const vec3 at = result.background.surface.mesh.points[violation.edge[0]];
    for (const vec3 along : {view.right + view.up, view.right - view.up})
      scene.lines.push_back(
          lifted({{at - arm * diagonal * along, at + arm * diagonal * along}, red, 5}, 2 * diagonal * from));
  }
  return rendered(scene, from);
}

template <int D>
raster_image picture_of_worst_elements(const generated<D>& result) {
  constexpr double least_across = 0.016; // of the model's diagonal
  raster_scene scene;
  add_outline(scene, result.mesh.skeleton);
  box3 box;
  for (const vec3 p : result.mesh.skeleton.points)
    box.include(p);
  const vec3 from = D == 3 ? oblique_direction() : direction_to_viewer(scene.bounds());
  for (const auto& element : worst_elements(result.mesh))
    add_element<D>(scene, element, least_across * box.diagonal());
  return rendered(scene, from);
}

template raster_image picture_of_worst_elements(const generated<2>&);
template raster_image picture_of_worst_elements(const generated<3>&);

} // namespace dovetail::app
