#include "view_pieces.hpp"

#include "any_mesh_file.hpp"
#include "mesh_files.hpp"
#include "view_groups.hpp"
#include "view_sides.hpp"

#include "dovetail/core/error.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/files/streamed_validity.hpp"
#include "dovetail/mesh/element_angles.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

namespace dovetail::app {
namespace {

/// Of what a file may say for each element, or for none.
local_id tag_at(const std::vector<local_id>& tags, std::size_t element) {
  return element < tags.size() ? tags[element] : 0;
}

/// An element of a piece, without its mesh.
lone_element lone(const io::loaded_mesh& piece, std::size_t e, const std::array<vec3, 4>& corners,
                  float angle) {
  const simplex<3>& vertices = piece.mesh.elements[e];
  lone_element element{{}, corners, tag_at(piece.subdomains, e), tag_at(piece.mesh.tags, e), angle, 0};
  for (std::size_t k = 0; k < 4; ++k)
    element.ids[k] = piece.node_ids[vertices[k]];
  return element;
}

/// A side without its mesh.
struct lone_side {
  std::array<global_id, 3> ids; ///< of its points, oriented outwards of its element
  local_id piece, material;     ///< tags of its element
  float angle;                  ///< of its element
  bool open;                    ///< there is no other element at it in the same file
  std::optional<local_id> tag;
};

struct numbered_point {
  global_id id;
  vec3 at;
};

/// The points that are kept of all pieces, in the order of their numbers.
class point_table {
public:
  void add(global_id id, vec3 at) { points_.push_back({id, at}); }
  /// When all are there. Throws `input_error` where one number is at two places.
  void finish() {
    sort_all(points_, [](const numbered_point& a, const numbered_point& b) { return a.id < b.id; });
    std::size_t kept = 0;
    for (const numbered_point& point : points_) {
      if (kept == 0 || points_[kept - 1].id != point.id)
        points_[kept++] = point;
      else if (points_[kept - 1].at != point.at)
        throw input_error("two points have the global number " + std::to_string(point.id) +
                          " but not the same coordinates");
    }
    points_.erase(points_.begin() + static_cast<std::ptrdiff_t>(kept), points_.end());
  }
  /// Of a point that is there.
  local_id at(global_id id) const {
    return static_cast<local_id>(
        std::lower_bound(points_.begin(), points_.end(), id,
                         [](const numbered_point& p, global_id value) { return p.id < value; }) -
        points_.begin());
  }
  template <std::size_t N>
  std::array<local_id, N> at(const std::array<global_id, N>& ids) const {
    std::array<local_id, N> found;
    for (std::size_t k = 0; k < N; ++k)
      found[k] = at(ids[k]);
    return found;
  }
  std::vector<vec3> places() const {
    std::vector<vec3> places;
    places.reserve(points_.size());
    for (const numbered_point& point : points_)
      places.push_back(point.at);
    return places;
  }

private:
  std::vector<numbered_point> points_;
};

/// Whether sides at the same place are seen, and have a group: taken together they are known for what they
/// are in the whole mesh.
void join(std::vector<lone_side>& outer, std::vector<lone_side>& inner, std::span<lone_side*> same) {
  std::optional<local_id> tag;
  for (const lone_side* side : same)
    if (side->tag && (!tag || *side->tag < *tag))
      tag = side->tag;
  const lone_side& first = *same.front();
  const lone_side& last = *same.back();
  const bool is_between =
      !first.open || same.size() > 2 || tag || first.piece != last.piece || first.material != last.material;
  if (same.size() > 1 && !is_between)
    return;
  for (lone_side* side : same) {
    side->tag = tag;
    (same.size() == 1 && side->open ? outer : inner).push_back(*side);
  }
}

/// What is kept of pieces while others are read.
class piece_collector {
public:
  /// \param surface whose groups the mesh gets if it has none and this is its surface
  piece_collector(std::size_t elements, surface_groups surface)
      : elements_(elements), surface_(std::move(surface)) {}

  /// \param piece whose elements may be of second order
  void add(const io::loaded_mesh& piece) {
    numbers_.add(piece);
    if (io::detail::has_middles(piece)) {
      second_order_ = true;
      for (const global_id id : piece.node_ids)
        nodes_.add(id);
    }
    with_corners(piece, [&](const io::loaded_mesh& corners) { add_corners(corners); });
  }

  /// Whether in all files the same tells pieces.
  bool agree() const { return agree_; }
  bool has_subdomains() const { return has_subdomains_; }

  /// All of a scene but its points, groups, outline and centres; in the order of the sides' vertices.
  void fill(view_scene& scene, tag_labels& pieces, tag_labels& materials) {
    std::vector<lone_side> sides = joined_sides(scene.outer);
    if (!has_triangles_ && has_surface_)
      add_groups(std::span(sides).first(scene.outer));
    materials_.finish(material_names_, "material");
    subdomains_.finish({}, "piece");
    groups_.finish(triangle_names_, "group");
    materials = materials_;
    pieces = has_subdomains_ ? subdomains_ : materials_;
    scene.pieces.names = pieces.names();
    scene.materials.names = materials.names();
    scene.count = elements_.seen();
    scene.second_order = second_order_;
    scene.least_angle = least_angle_;
    scene.box = box_;
    sort_unique(boundary_);
    scene.vertices = inner_points_ + boundary_.size();
    boundary_ = {};
    for (const lone_side& side : sides) {
      scene.element_of.push_back(static_cast<local_id>(scene.element_of.size()));
      scene.angles.push_back(side.angle);
      scene.pieces.of.push_back(pieces.label(has_subdomains_ ? side.piece : side.material));
      scene.materials.of.push_back(materials.label(side.material));
    }
    group_labels groups(scene, std::move(groups_), has_triangles_);
    for (std::size_t t = 0; t < sides.size(); ++t)
      groups.add(sides[t].tag, t < scene.outer, static_cast<local_id>(t));
    groups.sort();
    sides_ = std::move(sides);
  }

  /// The elements and the points of a scene that has all else.
  std::vector<lone_element> fill_points(view_scene& scene, std::size_t elements,
                                        std::vector<simplex<3>>& tetrahedra) {
    std::vector<lone_element> kept = elements_.take(elements);
    for (const lone_element& element : kept)
      for (std::size_t k = 0; k < 4; ++k)
        points_.add(element.ids[k], element.corners[k]);
    points_.finish();
    for (const lone_element& element : kept)
      tetrahedra.push_back(points_.at(element.ids));
    for (const lone_side& side : sides_)
      scene.triangles.push_back(points_.at(side.ids));
    scene.points = points_.places();
    return kept;
  }

  std::string elsewhere(std::size_t corners) {
    return numbers_.elsewhere(second_order_ ? nodes_.count() : corners);
  }

private:
  /// Of a point in its piece: the last that holds.
  enum class place : std::uint8_t { unused, within, at_side, on_boundary };

  void add_corners(const io::loaded_mesh& piece) {
    const std::size_t count = piece.mesh.elements.size();
    const bool has_subdomains = piece.subdomains.size() == count;
    agree_ = agree_ && (elements_.seen() == 0 || has_subdomains == has_subdomains_);
    has_subdomains_ = has_subdomains;
    add_tags(piece);
    const auto if_complete = [&](const std::vector<local_id>& tags) {
      return tags.size() == count ? span_of(tags) : std::span<const local_id>();
    };
    const seen_sides sides =
        find_seen_sides(piece, if_complete(piece.subdomains), if_complete(piece.mesh.tags));
    const std::vector<float> angles = add_elements(piece);
    std::vector<place> places(piece.mesh.points.size(), place::unused);
    for (const simplex<3>& element : piece.mesh.elements)
      for (const local_id v : element)
        places[v] = place::within;
    for (const auto* some : {&sides.inner, &sides.outer})
      for (const seen_side& side : *some) {
        add_side(piece, side, angles[side.element], some == &sides.outer);
        for (const local_id v : side.vertices)
          places[v] = some == &sides.outer ? place::on_boundary : place::at_side;
      }
    add_points(piece, places);
  }

  void add_tags(const io::loaded_mesh& piece) {
    for (std::size_t e = 0; e < piece.mesh.elements.size(); ++e) {
      subdomains_.note(tag_at(piece.subdomains, e));
      materials_.note(tag_at(piece.mesh.tags, e));
    }
    for (const local_id tag : piece.triangle_tags)
      groups_.note(tag);
    has_triangles_ = has_triangles_ || !piece.triangles.empty();
    if (material_names_.empty()) // they are those of the whole mesh
      material_names_ = piece.material_names;
    if (triangle_names_.empty())
      triangle_names_ = piece.triangle_names;
  }

  /// \return their angles
  std::vector<float> add_elements(const io::loaded_mesh& piece) {
    std::vector<float> angles;
    angles.reserve(piece.mesh.elements.size());
    for (std::size_t e = 0; e < piece.mesh.elements.size(); ++e) {
      const auto at = corners(span_of(piece.mesh.points), piece.mesh.elements[e]);
      const float angle = least_angle_of(at);
      angles.push_back(angle);
      least_angle_ = std::min(least_angle_, angle);
      elements_.add(angle, [&] { return lone(piece, e, at, angle); });
    }
    return angles;
  }

  void add_side(const io::loaded_mesh& piece, const seen_side& side, float angle, bool open) {
    const std::size_t e = static_cast<std::size_t>(side.element);
    lone_side made{{}, tag_at(piece.subdomains, e), tag_at(piece.mesh.tags, e), angle, open, side.tag};
    for (std::size_t k = 0; k < 3; ++k)
      made.ids[k] = piece.node_ids[side.vertices[k]];
    sides_.push_back(made);
  }

  void add_points(const io::loaded_mesh& piece, const std::vector<place>& places) {
    for (std::size_t v = 0; v < places.size(); ++v) {
      if (places[v] == place::unused)
        continue;
      box_.include(piece.mesh.points[v]);
      if (places[v] == place::on_boundary) { // which other pieces may have too
        boundary_.push_back(piece.node_ids[v]);
        has_surface_ = has_surface_ && surface_.agrees(piece.node_ids[v], piece.mesh.points[v]);
      } else {
        ++inner_points_;
      }
      if (places[v] != place::within)
        points_.add(piece.node_ids[v], piece.mesh.points[v]);
    }
  }

  /// Those of the surface, where it has all of the outer sides.
  void add_groups(std::span<lone_side> outer) {
    std::vector<local_id> groups;
    for (const lone_side& side : outer)
      if (const auto group = surface_.group_of(side.ids))
        groups.push_back(*group);
    if (groups.size() != outer.size())
      return;
    has_triangles_ = true;
    triangle_names_ = surface_.names();
    for (std::size_t s = 0; s < outer.size(); ++s)
      if (groups[s] != no_id) {
        outer[s].tag = groups[s];
        groups_.note(groups[s]);
      }
  }

  /// Those that are seen of the whole mesh, the outer ones first.
  std::vector<lone_side> joined_sides(std::size_t& outer_ones) {
    struct keyed {
      std::array<global_id, 3> key;
      std::size_t side;
    };
    std::vector<keyed> order;
    order.reserve(sides_.size());
    for (std::size_t s = 0; s < sides_.size(); ++s) {
      order.push_back({sides_[s].ids, s});
      std::sort(order.back().key.begin(), order.back().key.end());
    }
    sort_all(order,
             [](const keyed& a, const keyed& b) { return a.key != b.key ? a.key < b.key : a.side < b.side; });
    std::vector<lone_side> outer, inner;
    std::vector<lone_side*> same;
    for (std::size_t i = 0, end; i < order.size(); i = end) {
      same.clear();
      for (end = i; end < order.size() && order[end].key == order[i].key; ++end)
        same.push_back(&sides_[order[end].side]);
      join(outer, inner, same);
    }
    sides_ = {};
    outer_ones = outer.size();
    append(outer, inner);
    return outer;
  }

  element_sample elements_;
  surface_groups surface_;
  bool has_surface_ = true; ///< as far as its points say
  std::vector<lone_side> sides_;
  point_table points_; ///< of these sides
  std::vector<global_id> boundary_;
  std::size_t inner_points_ = 0;
  box3 box_;
  float least_angle_ = 180;
  numbers_of_pieces numbers_;
  io::number_ranges nodes_; ///< of points of second order, those in the middle of edges too
  tag_labels subdomains_, materials_, groups_;
  tag_names material_names_, triangle_names_;
  bool has_triangles_ = false;
  bool has_subdomains_ = false;
  bool second_order_ = false;
  bool agree_ = true;
};

/// What is said per element of the first ones of a scene, in place of what is there.
template <class T, class Of>
void replace_first(std::vector<T>& items, std::size_t old, std::span<const lone_element> elements,
                   const Of& of) {
  std::vector<T> made;
  made.reserve(elements.size() + items.size() - old);
  for (const lone_element& element : elements)
    made.push_back(of(element));
  made.insert(made.end(), items.begin() + static_cast<std::ptrdiff_t>(old), items.end());
  items = std::move(made);
}

} // namespace

std::optional<view_pieces> view_pieces::read(const std::filesystem::path& mesh, std::int64_t most) {
  constexpr std::size_t any = std::numeric_limits<std::uint32_t>::max();
  piece_collector collector(view_room(0, 0, any, most).elements, surface_groups::beside(mesh));
  const auto add = [&](const io::loaded_mesh& piece, const std::filesystem::path& file) {
    try {
      collector.add(piece);
    } catch (const mesh_error& problem) {
      throw input_error(file.string() + ": " + problem.what());
    }
  };
  if (!for_each_piece_of_any(mesh, add, io::element_order::any) || !collector.agree())
    return std::nullopt;
  view_pieces read;
  read.mesh_ = mesh;
  view_scene& scene = read.scene;
  collector.fill(scene, read.pieces_, read.materials_);
  read.has_subdomains_ = collector.has_subdomains();
  std::vector<simplex<3>> tetrahedra;
  try {
    const view_room room(scene.outer, scene.element_of.size() - scene.outer, scene.count, most);
    const auto elements = collector.fill_points(scene, room.elements, tetrahedra);
    read.set_elements(elements, std::move(tetrahedra));
  } catch (const input_error& problem) {
    throw input_error(mesh.string() + ": " + problem.what());
  }
  read.elsewhere = collector.elsewhere(scene.vertices);
  finish_scene(scene);
  return read;
}

std::size_t view_pieces::take_elements(double apart, std::size_t most,
                                       const std::function<bool(float, const std::array<vec3, 4>&)>& wanted) {
  std::vector<lone_element> elements;
  std::uint64_t count = 0;
  const auto leave_worst = [&] {
    if (elements.size() <= most)
      return;
    const auto end = elements.begin() + static_cast<std::ptrdiff_t>(most);
    std::nth_element(elements.begin(), end, elements.end(), is_worse);
    elements.erase(end, elements.end());
    std::sort(elements.begin(), elements.end(), // as they were read
              [](const lone_element& a, const lone_element& b) { return a.number < b.number; });
  };
  const auto add = [&](const io::loaded_mesh& piece) {
    for (std::size_t e = 0; e < piece.mesh.elements.size(); ++e) {
      const auto at = corners(span_of(piece.mesh.points), piece.mesh.elements[e]);
      const float angle = least_angle_of(at);
      auto moved = at;
      if (apart > 0) {
        const local_id tag = tag_at(has_subdomains_ ? piece.subdomains : piece.mesh.tags, e);
        for (vec3& p : moved)
          p += apart * (scene.centres[pieces_.label(tag)] - scene.box.center());
      }
      if (!wanted(angle, moved))
        continue;
      elements.push_back(lone(piece, e, at, angle));
      elements.back().number = count++;
      if (elements.size() >= 2 * most + 1)
        leave_worst();
    }
  };
  const auto add_corners = [&](const io::loaded_mesh& piece, const std::filesystem::path&) {
    with_corners(piece, add);
  };
  if (!for_each_piece_of_any(mesh_, add_corners, io::element_order::any))
    throw input_error(mesh_.string() + ": the file has changed while it was read");
  leave_worst();
  // They have points of their own: what is drawn does not ask which are the same.
  std::vector<simplex<3>> vertices;
  vertices.reserve(elements.size());
  if (4 * elements.size() + scene.points.size() >
      static_cast<std::size_t>(std::numeric_limits<local_id>::max()))
    throw input_error(mesh_.string() + ": too many elements to be drawn at once");
  for (const lone_element& element : elements) {
    const auto first = static_cast<local_id>(scene.points.size());
    append(scene.points, element.corners);
    vertices.push_back({first, first + 1, first + 2, first + 3});
  }
  set_elements(elements, std::move(vertices));
  return count;
}

void view_pieces::set_elements(std::span<const lone_element> elements, std::vector<simplex<3>> vertices) {
  const std::size_t old = scene.tetrahedra.size();
  replace_first(scene.angles, old, elements, [](const lone_element& e) { return e.angle; });
  replace_first(scene.materials.of, old, elements,
                [&](const lone_element& e) { return materials_.label(e.material); });
  replace_first(scene.pieces.of, old, elements,
                [&](const lone_element& e) { return pieces_.label(has_subdomains_ ? e.piece : e.material); });
  for (local_id& element : scene.element_of)
    element += static_cast<local_id>(vertices.size()) - static_cast<local_id>(old);
  scene.tetrahedra = std::move(vertices);
}

} // namespace dovetail::app
