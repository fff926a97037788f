/// @file
/// What `write_vtu.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/output_file.hpp"
#include "dovetail/files/mesh_document.hpp"
#include "dovetail/files/vtk_xml_output.hpp"
#include "dovetail/files/write_vtu.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace dovetail::io {

namespace detail {

/// VTK's list of names, the tag being the index; tags without a name get an empty one. Tags beyond any
/// sensible count are left out.
inline std::vector<std::string> names_by_tag(const tag_names& names) {
  constexpr local_id most = 1 << 16;
  std::vector<std::string> list;
  for (const auto& [tag, name] : names)
    if (tag >= 0 && tag < most) {
      list.resize(std::max(list.size(), static_cast<std::size_t>(tag) + 1));
      list[tag] = name;
    }
  return list;
}

DOVETAIL_INLINE void write_vtu_document(const mesh_document& mesh, const std::filesystem::path& path,
                                        const std::vector<point_array>& arrays,
                                        const std::vector<mesh_field>& at_points,
                                        const std::vector<mesh_field>& in_elements) {
  const auto solid = mesh.tetrahedra.size();
  const auto cells = solid + mesh.triangles.size();
  // Where there are no tetrahedra, triangles have regions.
  const bool flat = solid == 0;
  const auto require = [&](const auto& array, std::size_t count, const std::string& of_what) {
    if (array.values.size() != count)
      throw io_error("the array \"" + array.name + "\" for " + path.string() + " has " +
                     std::to_string(array.values.size()) + " values for " + std::to_string(count) + of_what);
  };
  const auto require_all = [&](const std::vector<mesh_field>& fields, std::size_t count, const char* what) {
    for (const auto& field : fields)
      require(field, count * static_cast<std::size_t>(field.components),
              " components of " + std::string(what));
  };
  for (const auto& array : arrays)
    require(array, mesh.points.size(), " points");
  require_all(at_points, mesh.points.size(), "points");
  require_all(in_elements, flat ? cells : solid, "elements");
  struct cell_array {
    const char* name;
    std::span<const local_id> of_tetrahedra, of_triangles;
  };
  std::vector<cell_array> tags;
  for (const cell_array& each :
       {cell_array{"region", mesh.materials, flat ? mesh.groups : mesh.groups.first(0)},
        cell_array{"subdomain", mesh.subdomains, {}},
        cell_array{"patch", {}, flat ? mesh.groups.first(0) : mesh.groups}})
    if (!each.of_tetrahedra.empty() || !each.of_triangles.empty())
      tags.push_back(each);

  output_file file(path);
  appended_layout layout(file);
  file.text(vtk_xml_opening("UnstructuredGrid"));
  file.text("<UnstructuredGrid>\n" +
            vtk_field_data({{"region_names", names_by_tag(flat ? mesh.group_names : mesh.material_names)},
                            {"patch_names", names_by_tag(flat ? tag_names{} : mesh.group_names)}}));
  file.text("<Piece NumberOfPoints=\"" + std::to_string(mesh.points.size()) + "\" NumberOfCells=\"" +
            std::to_string(cells) + "\">\n<Points>\n");
  layout.array<double>("Points", mesh.points.size(), 3);
  file.text("</Points>\n<PointData>\n");
  if (!mesh.ids.empty())
    layout.array<global_id>("GlobalNodeIds", mesh.ids.size());
  for (const auto& array : arrays)
    layout.array<double>(xml_escaped(array.name), mesh.points.size());
  for (const auto& field : at_points)
    layout.array<double>(xml_escaped(field.name), mesh.points.size(), field.components);
  file.text("</PointData>\n<Cells>\n");
  layout.array<local_id>("connectivity", 4 * solid + 3 * mesh.triangles.size());
  layout.array<std::int64_t>("offsets", cells);
  layout.array<std::uint8_t>("types", cells);
  file.text("</Cells>\n<CellData>\n");
  for (const cell_array& each : tags)
    layout.array<local_id>(each.name, cells);
  for (const auto& field : in_elements)
    layout.array<double>(xml_escaped(field.name), cells, field.components);
  file.text("</CellData>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_");

  append_values(file, mesh.points);
  if (!mesh.ids.empty())
    append_values(file, mesh.ids);
  for (const auto& array : arrays)
    append_values(file, std::span(array.values));
  for (const auto& field : at_points)
    append_values(file, std::span(field.values));
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
      return values.empty() ? no_id : values[i < solid ? i : i - solid];
    });
  for (const auto& field : in_elements)
    append_computed<double>(file, cells * static_cast<std::uint64_t>(field.components), [&](std::uint64_t i) {
      return i < field.values.size() ? field.values[i] : std::numeric_limits<double>::quiet_NaN();
    });
  file.text("\n</AppendedData>\n</VTKFile>\n");
  file.commit();
}

} // namespace detail

} // namespace dovetail::io
