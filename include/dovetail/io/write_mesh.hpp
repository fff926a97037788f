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

/// Writes a VTU file with cell data `region` (the tags, where there are any), their names as field data
/// `region_names`, and the given point arrays, of one value per point. Throws `io_error` naming the path.
template <int D>
void write_vtu(const simplicial_mesh<D>& mesh, const std::filesystem::path& path,
               const std::vector<point_array>& arrays = {}, const tag_names& names = {}) {
  constexpr auto cell_type = std::array<std::uint8_t, 4>{1, 3, 5, 10}[D];
  const auto points = mesh.points.size();
  const auto cells = mesh.elements.size();
  const bool tagged = mesh.tags.size() == cells;

  output_file file(path);
  appended_layout layout(file);
  file.text(vtk_xml_opening("UnstructuredGrid"));
  file.text("<UnstructuredGrid>\n" + vtk_field_data({{"region_names", detail::names_by_tag(names)}}));
  file.text("<Piece NumberOfPoints=\"" + std::to_string(points) + "\" NumberOfCells=\"" +
            std::to_string(cells) + "\">\n<Points>\n");
  layout.array<double>("Points", points, 3);
  file.text("</Points>\n<PointData>\n");
  for (const auto& array : arrays)
    layout.array<double>(xml_escaped(array.name), points);
  file.text("</PointData>\n<Cells>\n");
  layout.array<local_id>("connectivity", (D + 1) * cells);
  layout.array<std::int64_t>("offsets", cells);
  layout.array<std::uint8_t>("types", cells);
  file.text("</Cells>\n<CellData>\n");
  if (tagged)
    layout.array<local_id>("region", cells);
  file.text("</CellData>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_");

  append_values(file, std::span(mesh.points));
  for (const auto& array : arrays) {
    if (array.values.size() != points)
      throw io_error("the array \"" + array.name + "\" for " + path.string() + " has " +
                     std::to_string(array.values.size()) + " values for " + std::to_string(points) +
                     " points");
    append_values(file, std::span(array.values));
  }
  append_values(file, std::span(mesh.elements));
  append_computed<std::int64_t>(file, cells,
                                [](auto i) { return static_cast<std::int64_t>((D + 1) * (i + 1)); });
  append_computed<std::uint8_t>(file, cells, [cell_type](auto) { return cell_type; });
  if (tagged)
    append_values(file, std::span(mesh.tags));
  file.text("\n</AppendedData>\n</VTKFile>\n");
  file.commit();
}

namespace detail {

/// The part of a mesh that has one tag.
struct tagged_part {
  std::vector<local_id> points; ///< that no part before uses
  std::vector<local_id> elements;
  box3 box;
};

/// The parts by tag. Points without elements go with the first part, so that none is lost.
template <int D>
std::map<local_id, tagged_part> parts_by_tag(const simplicial_mesh<D>& mesh) {
  if (!mesh.tags.empty() && mesh.tags.size() != mesh.elements.size())
    throw mesh_error("the mesh does not have one tag per element");
  std::map<local_id, tagged_part> parts;
  std::vector<bool> filed(mesh.points.size(), false);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const auto tag = mesh.tags.empty() ? 0 : mesh.tags[e];
    if (tag < 0)
      throw mesh_error("element " + std::to_string(e) + " has a negative tag");
    auto& part = parts[tag];
    part.elements.push_back(static_cast<local_id>(e));
    for (const auto v : mesh.elements[e]) {
      part.box.include(mesh.points[static_cast<std::size_t>(v)]);
      if (!filed[static_cast<std::size_t>(v)])
        part.points.push_back(v);
      filed[static_cast<std::size_t>(v)] = true;
    }
  }
  if (!parts.empty())
    for (std::size_t v = 0; v < filed.size(); ++v)
      if (!filed[v])
        parts.begin()->second.points.push_back(static_cast<local_id>(v));
  return parts;
}

/// The sections of an MSH file in which every part is an entity of its own.
template <int D>
class part_sections {
public:
  part_sections(msh_encoder& out, const simplicial_mesh<D>& mesh,
                const std::map<local_id, tagged_part>& parts)
      : out_(out), mesh_(mesh), parts_(parts) {}

  void entities() {
    out_.begin("Entities");
    for (int d = 0; d < 4; ++d)
      out_.count(d == D ? parts_.size() : 0);
    out_.line();
    for (const auto& [tag, part] : parts_) {
      out_.integer(tag + 1);
      out_.point(part.box.lower), out_.point(part.box.upper);
      out_.count(1), out_.integer(tag + 1); // its physical group
      out_.count(0);                        // nothing is known to bound it
      out_.line();
    }
    out_.end("Entities");
  }
  void nodes() {
    out_.begin("Nodes");
    totals(parts_.empty() ? 0 : mesh_.points.size());
    for (const auto& [tag, part] : parts_) {
      head(tag, 0, part.points.size());
      for (const auto v : part.points)
        number(v), out_.line();
      for (const auto v : part.points)
        out_.point(mesh_.points[static_cast<std::size_t>(v)]), out_.line();
    }
    out_.end("Nodes");
  }
  void elements() {
    constexpr auto type =
        std::array{msh_type::point, msh_type::line, msh_type::triangle, msh_type::tetrahedron}[D];
    out_.begin("Elements");
    totals(mesh_.elements.size());
    for (const auto& [tag, part] : parts_) {
      head(tag, static_cast<int>(type), part.elements.size());
      for (const auto e : part.elements) {
        number(e);
        for (const auto v : mesh_.elements[static_cast<std::size_t>(e)])
          number(v);
        out_.line();
      }
    }
    out_.end("Elements");
  }

private:
  void number(local_id index) { out_.count(static_cast<std::uint64_t>(index) + 1); }
  void totals(std::size_t count) {
    out_.count(parts_.size()), out_.count(count), out_.count(1), out_.count(count);
    out_.line();
  }
  void head(local_id tag, int what, std::size_t count) {
    out_.integer(D), out_.integer(tag + 1), out_.integer(what), out_.count(count);
    out_.line();
  }

  msh_encoder& out_;
  const simplicial_mesh<D>& mesh_;
  const std::map<local_id, tagged_part>& parts_;
};

} // namespace detail

/// Writes an MSH 4.1 file with one entity and one physical group per tag: group and entity t + 1 for tag t.
/// `names` are names of tags. Points are filed under the first tag that uses them. Throws `io_error` naming
/// the path, `mesh_error` when the tags are not one per element or negative.
template <int D>
void write_msh(const simplicial_mesh<D>& mesh, const std::filesystem::path& path, const tag_names& names = {},
               bool binary = true) {
  const auto parts = detail::parts_by_tag(mesh);
  output_file file(path);
  msh_encoder out(file, binary);
  std::vector<physical_name> groups;
  for (const auto& [tag, name] : names)
    groups.push_back({D, tag + 1, name});
  write_physical_names(file, groups);
  detail::part_sections sections(out, mesh, parts);
  sections.entities();
  sections.nodes();
  sections.elements();
  file.commit();
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
