/// @file
/// Writes a mesh held in memory to one file: VTU, MSH, or, for a surface, STL and OFF.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/io/loaded_mesh.hpp"
#include "dovetail/io/msh_encoder.hpp"
#include "dovetail/io/output_file.hpp"
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

/// Writes a VTU file with cell data `region` (the tags, where there are any) and the given point arrays, of
/// one value per point. Throws `io_error` naming the path.
template <int D>
void write_vtu(const simplicial_mesh<D>& mesh, const std::filesystem::path& path,
               const std::vector<point_array>& arrays = {}) {
  constexpr auto cell_type = std::array<std::uint8_t, 4>{1, 3, 5, 10}[D];
  const auto points = mesh.points.size();
  const auto cells = mesh.elements.size();
  const bool tagged = mesh.tags.size() == cells;

  output_file file(path);
  appended_layout layout(file);
  file.text(vtk_xml_opening("UnstructuredGrid"));
  file.text("<UnstructuredGrid>\n<Piece NumberOfPoints=\"" + std::to_string(points) + "\" NumberOfCells=\"" +
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

/// Writes an MSH 4.1 file with one entity and one physical group per tag: group and entity t + 1 for tag t.
/// `names` are names of tags. Points are filed under the first tag that uses them. Throws `io_error` naming
/// the path, `mesh_error` when the tags are not one per element or negative.
template <int D>
void write_msh(const simplicial_mesh<D>& mesh, const std::filesystem::path& path,
               const std::vector<std::pair<local_id, std::string>>& names = {}, bool binary = true) {
  constexpr auto element_type =
      std::array{msh_type::point, msh_type::line, msh_type::triangle, msh_type::tetrahedron}[D];
  if (!mesh.tags.empty() && mesh.tags.size() != mesh.elements.size())
    throw mesh_error("cannot write " + path.string() + ": the mesh does not have one tag per element");
  struct entity {
    std::vector<local_id> points;
    std::vector<local_id> elements;
    box3 box;
  };
  std::map<local_id, entity> entities;
  std::vector<bool> filed(mesh.points.size(), false);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const auto tag = mesh.tags.empty() ? 0 : mesh.tags[e];
    if (tag < 0)
      throw mesh_error("cannot write " + path.string() + ": element " + std::to_string(e) +
                       " has a negative tag");
    auto& of_tag = entities[tag];
    of_tag.elements.push_back(static_cast<local_id>(e));
    for (const auto v : mesh.elements[e]) {
      of_tag.box.include(mesh.points[static_cast<std::size_t>(v)]);
      if (!filed[static_cast<std::size_t>(v)])
        of_tag.points.push_back(v);
      filed[static_cast<std::size_t>(v)] = true;
    }
  }
  if (!entities.empty()) // points without elements go with the first entity, so that none is lost
    for (std::size_t v = 0; v < filed.size(); ++v)
      if (!filed[v])
        entities.begin()->second.points.push_back(static_cast<local_id>(v));

  output_file file(path);
  msh_encoder out(file, binary);
  std::vector<physical_name> groups;
  for (const auto& [tag, name] : names)
    groups.push_back({D, tag + 1, name});
  write_physical_names(file, groups);

  out.begin("Entities");
  for (int d = 0; d < 4; ++d)
    out.count(d == D ? entities.size() : 0);
  out.line();
  for (const auto& [tag, of_tag] : entities) {
    out.integer(tag + 1);
    out.point(of_tag.box.lower), out.point(of_tag.box.upper);
    out.count(1);
    out.integer(tag + 1);
    out.count(0);
    out.line();
  }
  out.end("Entities");

  const auto head = [&](local_id tag, int what, std::size_t count) {
    out.integer(D), out.integer(tag + 1), out.integer(what), out.count(count);
    out.line();
  };
  const auto totals = [&](std::size_t blocks, std::size_t count) {
    out.count(blocks), out.count(count), out.count(1), out.count(count);
    out.line();
  };
  out.begin("Nodes");
  totals(entities.size(), entities.empty() ? 0 : mesh.points.size());
  for (const auto& [tag, of_tag] : entities) {
    head(tag, 0, of_tag.points.size());
    for (const auto v : of_tag.points)
      out.count(static_cast<std::uint64_t>(v) + 1), out.line();
    for (const auto v : of_tag.points)
      out.point(mesh.points[static_cast<std::size_t>(v)]), out.line();
  }
  out.end("Nodes");
  out.begin("Elements");
  totals(entities.size(), mesh.elements.size());
  for (const auto& [tag, of_tag] : entities) {
    head(tag, static_cast<int>(element_type), of_tag.elements.size());
    for (const auto e : of_tag.elements) {
      out.count(static_cast<std::uint64_t>(e) + 1);
      for (const auto v : mesh.elements[static_cast<std::size_t>(e)])
        out.count(static_cast<std::uint64_t>(v) + 1);
      out.line();
    }
  }
  out.end("Elements");
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
