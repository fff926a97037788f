/// @file
/// Writes a mesh held in memory to one file: VTU, MSH, or, for a surface, STL and OFF.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/output_file.hpp"
#include "dovetail/io/loaded_mesh.hpp"
#include "dovetail/io/msh_encoder.hpp"
#include "dovetail/io/vtk_xml_output.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::io {

static_assert(std::endian::native == std::endian::little,
              "binary files are written as on little-endian machines");

/// Names of tags.
using tag_names = std::vector<std::pair<local_id, std::string>>;

namespace detail {

/// VTK's list of names, the tag being the index; tags without a name get an empty one. Tags beyond any
/// sensible count are left out.
inline std::vector<std::string> names_by_tag(const tag_names& names) {
  constexpr local_id most = 1 << 16;
  std::vector<std::string> list;
  for (const auto& [tag, name] : names)
    if (tag >= 0 && tag < most) {
      list.resize(std::max(list.size(), static_cast<std::size_t>(tag) + 1));
      list[static_cast<std::size_t>(tag)] = name;
    }
  return list;
}

} // namespace detail

namespace detail {

/// What the writers of VTU and MSH take: tetrahedra, triangles or both, on one set of points. What a mesh
/// does not have is empty.
struct mesh_document {
  std::span<const vec3> points;
  std::span<const global_id> ids = {};
  std::span<const simplex<3>> tetrahedra = {};
  std::span<const local_id> regions = {};
  std::span<const local_id> subdomains = {};
  std::span<const simplex<2>> triangles = {};
  std::span<const local_id> patches = {};
  tag_names region_names = {};
  tag_names patch_names = {};
};

/// Throws `mesh_error` when there is not one tag per element.
template <int D>
mesh_document document_of(const simplicial_mesh<D>& mesh, const tag_names& names) {
  if (!mesh.tags.empty() && mesh.tags.size() != mesh.elements.size())
    throw mesh_error("the mesh does not have one tag per element");
  mesh_document document{.points = mesh.points};
  if constexpr (D == 3) {
    document.tetrahedra = mesh.elements;
    document.regions = mesh.tags;
    document.region_names = names;
  } else {
    static_assert(D == 2, "meshes of triangles and of tetrahedra are written");
    document.triangles = mesh.elements;
    document.patches = mesh.tags;
    document.patch_names = names;
  }
  return document;
}
inline mesh_document document_of(const loaded_mesh& mesh) {
  mesh_document document = document_of(mesh.mesh, mesh.region_names);
  document.ids = mesh.node_ids;
  document.subdomains = mesh.subdomains;
  document.triangles = mesh.triangles;
  document.patches = mesh.triangle_tags;
  document.patch_names = mesh.triangle_names;
  return document;
}

inline void write_vtu_document(const mesh_document& mesh, const std::filesystem::path& path,
                               const std::vector<point_array>& arrays) {
  for (const auto& array : arrays)
    if (array.values.size() != mesh.points.size())
      throw io_error("the array \"" + array.name + "\" for " + path.string() + " has " +
                     std::to_string(array.values.size()) + " values for " +
                     std::to_string(mesh.points.size()) + " points");
  const auto solid = mesh.tetrahedra.size();
  const auto cells = solid + mesh.triangles.size();
  // Where there are no tetrahedra, triangles have regions.
  const bool flat = solid == 0;
  struct cell_array {
    const char* name;
    std::span<const local_id> of_tetrahedra, of_triangles;
  };
  std::vector<cell_array> tags;
  for (const cell_array& each :
       {cell_array{"region", mesh.regions, flat ? mesh.patches : mesh.patches.first(0)},
        cell_array{"subdomain", mesh.subdomains, {}},
        cell_array{"patch", {}, flat ? mesh.patches.first(0) : mesh.patches}})
    if (!each.of_tetrahedra.empty() || !each.of_triangles.empty())
      tags.push_back(each);

  output_file file(path);
  appended_layout layout(file);
  file.text(vtk_xml_opening("UnstructuredGrid"));
  file.text("<UnstructuredGrid>\n" +
            vtk_field_data({{"region_names", names_by_tag(flat ? mesh.patch_names : mesh.region_names)},
                            {"patch_names", names_by_tag(flat ? tag_names{} : mesh.patch_names)}}));
  file.text("<Piece NumberOfPoints=\"" + std::to_string(mesh.points.size()) + "\" NumberOfCells=\"" +
            std::to_string(cells) + "\">\n<Points>\n");
  layout.array<double>("Points", mesh.points.size(), 3);
  file.text("</Points>\n<PointData>\n");
  if (!mesh.ids.empty())
    layout.array<global_id>("GlobalNodeIds", mesh.ids.size());
  for (const auto& array : arrays)
    layout.array<double>(xml_escaped(array.name), mesh.points.size());
  file.text("</PointData>\n<Cells>\n");
  layout.array<local_id>("connectivity", 4 * solid + 3 * mesh.triangles.size());
  layout.array<std::int64_t>("offsets", cells);
  layout.array<std::uint8_t>("types", cells);
  file.text("</Cells>\n<CellData>\n");
  for (const cell_array& each : tags)
    layout.array<local_id>(each.name, cells);
  file.text("</CellData>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_");

  append_values(file, mesh.points);
  if (!mesh.ids.empty())
    append_values(file, mesh.ids);
  for (const auto& array : arrays)
    append_values(file, std::span(array.values));
  file.value<std::uint64_t>(mesh.tetrahedra.size_bytes() + mesh.triangles.size_bytes());
  file.array(mesh.tetrahedra);
  file.array(mesh.triangles);
  append_computed<std::int64_t>(file, cells, [&](std::uint64_t i) {
    return static_cast<std::int64_t>(i < solid ? 4 * (i + 1) : 4 * solid + 3 * (i - solid + 1));
  });
  append_computed<std::uint8_t>(
      file, cells, [&](std::uint64_t i) { return i < solid ? std::uint8_t{10} : std::uint8_t{5}; });
  for (const cell_array& each : tags)
    append_computed<local_id>(file, cells, [&](std::uint64_t i) {
      const auto values = i < solid ? each.of_tetrahedra : each.of_triangles;
      return values.empty() ? no_id : values[static_cast<std::size_t>(i < solid ? i : i - solid)];
    });
  file.text("\n</AppendedData>\n</VTKFile>\n");
  file.commit();
}

} // namespace detail

/// Writes a VTU file with cell data `region` (the tags, where there are any), their names as field data
/// `region_names`, and the given point arrays, of one value per point. Throws `io_error` naming the path,
/// `mesh_error` when the tags are not one per element.
template <int D>
void write_vtu(const simplicial_mesh<D>& mesh, const std::filesystem::path& path,
               const std::vector<point_array>& arrays = {}, const tag_names& names = {}) {
  detail::write_vtu_document(detail::document_of(mesh, names), path, arrays);
}
/// All that was read: also point data `GlobalNodeIds`, cell data `subdomain`, and triangles with cell data
/// `patch` and field data `patch_names` (where there are no tetrahedra: `region`). A cell that an array says
/// nothing of has -1 there.
inline void write_vtu(const loaded_mesh& mesh, const std::filesystem::path& path) {
  detail::write_vtu_document(detail::document_of(mesh), path, mesh.point_scalars);
}

namespace detail {

/// The elements of one dimension that have one tag and one subdomain: an entity of an MSH file.
struct tagged_part {
  std::vector<local_id> points; ///< that no part before uses
  std::vector<local_id> elements;
  box3 box;
};
using part_key = std::array<local_id, 3>; ///< dimension, tag, and subdomain or no_id

/// Sorts elements into parts. Points without elements go with the first part, so that none is lost.
class part_sorter {
public:
  explicit part_sorter(std::span<const vec3> points) : points_(points), filed_(points.size(), false) {}

  template <std::size_t N>
  void add(std::span<const std::array<local_id, N>> elements, std::span<const local_id> tags,
           std::span<const local_id> subdomains) {
    for (std::size_t e = 0; e < elements.size(); ++e) {
      const auto tag = tags.empty() ? 0 : tags[e];
      if (tag < 0)
        throw mesh_error("element " + std::to_string(e) + " has a negative tag");
      auto& part = parts_[{static_cast<local_id>(N) - 1, tag, subdomains.empty() ? no_id : subdomains[e]}];
      part.elements.push_back(static_cast<local_id>(e));
      for (const auto v : elements[e]) {
        part.box.include(points_[static_cast<std::size_t>(v)]);
        if (!filed_[static_cast<std::size_t>(v)])
          part.points.push_back(v);
        filed_[static_cast<std::size_t>(v)] = true;
      }
    }
  }
  std::map<part_key, tagged_part> take() {
    if (!parts_.empty())
      for (std::size_t v = 0; v < filed_.size(); ++v)
        if (!filed_[v])
          parts_.begin()->second.points.push_back(static_cast<local_id>(v));
    return std::move(parts_);
  }

private:
  std::span<const vec3> points_;
  std::vector<bool> filed_;
  std::map<part_key, tagged_part> parts_;
};

/// The sections of an MSH file in which every part is an entity of its own. Those of a subdomain are parts of
/// the entity that has their tag.
class part_sections {
public:
  part_sections(msh_encoder& out, const mesh_document& mesh) : out_(out), mesh_(mesh) {
    part_sorter sorter(mesh.points);
    sorter.add(mesh.triangles, mesh.patches, {});
    sorter.add(mesh.tetrahedra, mesh.regions, mesh.subdomains);
    parts_ = sorter.take();
    for (const auto& [key, part] : parts_) {
      auto& whole = wholes_[{key[0], key[1]}];
      whole.include(part.box.lower), whole.include(part.box.upper);
      partitions_ = std::max(partitions_, key[2] + 1);
    }
    local_id next = 1;
    for (const auto& [key, part] : parts_)
      next = std::max(next, key[1] + 2);
    for (const auto& [key, part] : parts_)
      numbers_[key] = key[2] == no_id ? key[1] + 1 : next++;
  }

  void entities() {
    out_.begin("Entities");
    counts([](local_id) { return true; }, wholes_);
    for (const auto& [key, box] : wholes_) {
      out_.integer(key[1] + 1);
      describe(key[1], box);
    }
    out_.end("Entities");
    if (partitions_ == 0)
      return;
    out_.begin("PartitionedEntities");
    out_.count(static_cast<std::uint64_t>(partitions_)), out_.line();
    out_.count(0), out_.line(); // no ghosts
    counts([](local_id subdomain) { return subdomain != no_id; }, parts_);
    for (const auto& [key, part] : parts_)
      if (key[2] != no_id) {
        out_.integer(numbers_.at(key));
        out_.integer(key[0]), out_.integer(key[1] + 1); // what it is a part of
        out_.count(1), out_.integer(key[2] + 1);
        describe(key[1], part.box);
      }
    out_.end("PartitionedEntities");
  }
  void nodes() {
    out_.begin("Nodes");
    std::uint64_t least = 1, most = mesh_.points.size();
    if (!mesh_.ids.empty()) {
      least = number(*std::min_element(mesh_.ids.begin(), mesh_.ids.end()));
      most = number(*std::max_element(mesh_.ids.begin(), mesh_.ids.end()));
    }
    totals(parts_.empty() ? 0 : mesh_.points.size(), least, most);
    for (const auto& [key, part] : parts_) {
      head(key, 0, part.points.size());
      for (const auto v : part.points)
        out_.count(node(v)), out_.line();
      for (const auto v : part.points)
        out_.point(mesh_.points[static_cast<std::size_t>(v)]), out_.line();
    }
    out_.end("Nodes");
  }
  void elements() {
    const auto count = mesh_.tetrahedra.size() + mesh_.triangles.size();
    out_.begin("Elements");
    totals(count, 1, count);
    for (const auto& [key, part] : parts_) {
      const bool solid = key[0] == 3;
      head(key, static_cast<int>(solid ? msh_type::tetrahedron : msh_type::triangle), part.elements.size());
      for (const auto e : part.elements) {
        const auto at = static_cast<std::size_t>(e);
        if (solid)
          element(at, mesh_.tetrahedra[at]);
        else
          element(mesh_.tetrahedra.size() + at, mesh_.triangles[at]);
      }
    }
    out_.end("Elements");
  }

private:
  static std::uint64_t number(global_id index) { return static_cast<std::uint64_t>(index) + 1; }
  std::uint64_t node(local_id v) const {
    return number(mesh_.ids.empty() ? v : mesh_.ids[static_cast<std::size_t>(v)]);
  }
  template <std::size_t N>
  void element(std::size_t index, const std::array<local_id, N>& vertices) {
    out_.count(index + 1);
    for (const auto v : vertices)
      out_.count(node(v));
    out_.line();
  }
  /// How many there are of each dimension.
  template <class Wanted, class Parts>
  void counts(const Wanted& wanted, const Parts& parts) {
    std::array<std::size_t, 4> count{};
    for (const auto& [key, part] : parts)
      count[static_cast<std::size_t>(key[0])] += wanted(key.back()) ? 1 : 0;
    for (const std::size_t of_dimension : count)
      out_.count(of_dimension);
    out_.line();
  }
  void describe(local_id tag, const box3& box) {
    out_.point(box.lower), out_.point(box.upper);
    out_.count(1), out_.integer(tag + 1); // its physical group
    out_.count(0);                        // nothing is known to bound it
    out_.line();
  }
  void totals(std::size_t count, std::uint64_t least, std::uint64_t most) {
    out_.count(parts_.size()), out_.count(count), out_.count(least), out_.count(most);
    out_.line();
  }
  void head(const part_key& key, int what, std::size_t count) {
    out_.integer(key[0]), out_.integer(numbers_.at(key)), out_.integer(what), out_.count(count);
    out_.line();
  }

  msh_encoder& out_;
  const mesh_document& mesh_;
  std::map<part_key, tagged_part> parts_;
  std::map<std::array<local_id, 2>, box3> wholes_; ///< by dimension and tag
  std::map<part_key, local_id> numbers_;
  local_id partitions_ = 0;
};

inline void write_msh_document(const mesh_document& mesh, const std::filesystem::path& path, bool binary) {
  output_file file(path);
  msh_encoder out(file, binary);
  part_sections sections(out, mesh);
  std::vector<physical_name> groups;
  for (const auto& [tag, name] : mesh.patch_names)
    groups.push_back({2, tag + 1, name});
  for (const auto& [tag, name] : mesh.region_names)
    groups.push_back({3, tag + 1, name});
  write_physical_names(file, groups);
  sections.entities();
  sections.nodes();
  sections.elements();
  file.commit();
}

} // namespace detail

/// Writes an MSH 4.1 file with one entity and one physical group per tag: group and entity t + 1 for tag t.
/// `names` are names of tags. Points are filed under the first tag that uses them. Throws `io_error` naming
/// the path, `mesh_error` when the tags are not one per element or negative.
template <int D>
void write_msh(const simplicial_mesh<D>& mesh, const std::filesystem::path& path, const tag_names& names = {},
               bool binary = true) {
  detail::write_msh_document(detail::document_of(mesh, names), path, binary);
}
/// All that was read, but point arrays: also triangles with their groups, subdomains as partitions, and the
/// numbers of nodes.
inline void write_msh(const loaded_mesh& mesh, const std::filesystem::path& path, bool binary = true) {
  detail::write_msh_document(detail::document_of(mesh), path, binary);
}

/// Writes a binary STL file (single precision, 2^32 triangles at most). Throws `io_error` naming the path.
inline void write_stl(const simplicial_mesh<2>& mesh, const std::filesystem::path& path) {
  output_file file(path);
  std::string header = "written by dovetail";
  header.resize(80, ' ');
  file.text(header);
  file.value(static_cast<std::uint32_t>(mesh.elements.size()));
  for (const auto& triangle : mesh.elements) {
    const auto p = [&](std::size_t k) { return mesh.points[static_cast<std::size_t>(triangle[k])]; };
    for (const auto v : {normalized(cross(p(1) - p(0), p(2) - p(0))), p(0), p(1), p(2)})
      for (int axis = 0; axis < 3; ++axis)
        file.value(static_cast<float>(v[axis]));
    file.value<std::uint16_t>(0);
  }
  file.commit();
}

/// Writes an OFF file. Throws `io_error` naming the path.
inline void write_off(const simplicial_mesh<2>& mesh, const std::filesystem::path& path) {
  output_file file(path);
  file.text("OFF\n" + std::to_string(mesh.points.size()) + " " + std::to_string(mesh.elements.size()) +
            " 0\n");
  for (const auto& p : mesh.points) {
    for (int axis = 0; axis < 3; ++axis) {
      file.number(p[axis]);
      file.text(axis < 2 ? " " : "\n");
    }
  }
  for (const auto& triangle : mesh.elements) {
    file.text("3");
    for (const auto v : triangle) {
      file.text(" ");
      file.number(v);
    }
    file.text("\n");
  }
  file.commit();
}

} // namespace dovetail::io
