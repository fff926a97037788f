/// @file
/// The fields of VTU files: what their arrays say of points and cells beside numbers and parts.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/input_file.hpp"
#include "dovetail/core/xml_tree.hpp"
#include "dovetail/files/vtk_arrays.hpp"
#include "dovetail/mesh/loaded_mesh.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dovetail::io {

/// Whether a point array of this name numbers points, which means nothing in another mesh.
inline bool numbers_points(std::string_view name) {
  constexpr std::array<std::string_view, 4> names{"GlobalNodeIds", "mesh_node", "owner", "vtkGhostType"};
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Whether a cell array of this name says which cell it is, or what it is a part of.
inline bool numbers_cells(std::string_view name) {
  constexpr std::array<std::string_view, 12> names{
      "region",        "material",     "gmsh:physical", "gmsh:geometrical", "CellEntityIds",   "subdomain",
      "GlobalCellIds", "mesh_element", "vtkGhostType",  "cad_face",         "front_subdomain", "patch"};
  return std::find(names.begin(), names.end(), name) != names.end();
}

namespace detail {

/// Collects the fields of all pieces of a mesh.
class vtu_field_reader {
public:
  /// Of the next piece. Scalars are read with the mesh, and only counted here.
  void read_points(const xml_element* section, const vtk_encoding& encoding, std::uint64_t points) {
    for (const xml_element* array : fields_in(section, numbers_points)) {
      column& into = next(at_points_, *array, points_, points);
      if (into.field.components > 1)
        append(into.field.values, values_of(*array, into, encoding, points));
    }
    points_ += points;
  }
  /// `tetrahedra` and `triangles` are those cells that are in the mesh.
  void read_cells(const xml_element* section, const vtk_encoding& encoding, std::uint64_t cells,
                  const std::vector<std::size_t>& tetrahedra, const std::vector<std::size_t>& triangles) {
    for (const xml_element* array : fields_in(section, numbers_cells)) {
      column& into = next(in_cells_, *array, cells_, cells);
      const auto values = values_of(*array, into, encoding, cells);
      const auto components = static_cast<std::size_t>(into.field.components);
      for (const std::size_t c : tetrahedra)
        append(into.field.values, std::span(values).subspan(c * components, components));
      for (const std::size_t c : triangles)
        append(into.of_triangles, std::span(values).subspan(c * components, components));
    }
    cells_ += cells;
  }

  /// After the last piece.
  void give_to(loaded_mesh& mesh) {
    for (column& each : at_points_) {
      require_everywhere(each, points_);
      if (each.field.components > 1)
        mesh.point_fields.push_back(std::move(each.field));
    }
    for (column& each : in_cells_) {
      require_everywhere(each, cells_);
      if (mesh.mesh.elements.empty())
        each.field.values = std::move(each.of_triangles);
      mesh.element_fields.push_back(std::move(each.field));
    }
  }

private:
  /// What an array has in all pieces so far.
  struct column {
    mesh_field field;
    std::vector<double> of_triangles; ///< those of tetrahedra are in the field
    std::uint64_t tuples = 0;         ///< in the file
  };

  static std::vector<const xml_element*> fields_in(const xml_element* section,
                                                   bool (*is_none)(std::string_view)) {
    std::vector<const xml_element*> found;
    for (std::size_t i = 0; section != nullptr && i < section->children.size(); ++i)
      if (const xml_element& array = section->children[i]; array.name == "DataArray" &&
                                                           array.attribute("type") != "String" &&
                                                           !is_none(xml_unescaped(array.attribute("Name"))))
        found.push_back(&array);
    return found;
  }
  static int components_of(const xml_element& array, const std::string& name) {
    constexpr int most = 256;
    const auto text = array.attribute("NumberOfComponents");
    const int components = text.empty() ? 1 : file_cursor(text, "NumberOfComponents").number<int>();
    if (components < 1 || components > most)
      throw input_error("array \"" + name + "\": " + std::to_string(components) + " components; 1 to " +
                        std::to_string(most) + " are read");
    return components;
  }
  static void require_everywhere(const column& each, std::uint64_t tuples) {
    if (each.tuples < tuples)
      throw input_error("array \"" + each.field.name + "\": only some of the pieces have it");
  }
  /// The column that an array continues, of which there were so many tuples `before`.
  static column& next(std::vector<column>& columns, const xml_element& array, std::uint64_t before,
                      std::uint64_t tuples) {
    const std::string name = xml_unescaped(array.attribute("Name"));
    const int components = components_of(array, name);
    auto found = std::find_if(columns.begin(), columns.end(),
                              [&](const column& each) { return each.field.name == name; });
    if (found == columns.end()) {
      if (columns.size() == most_point_arrays)
        throw input_error("there are more than " + std::to_string(most_point_arrays) + " arrays");
      columns.push_back({{name, {}, components}, {}, 0});
      found = columns.end() - 1;
    }
    require_everywhere(*found, before);
    if (found->tuples > before)
      throw input_error("array \"" + name + "\": there are two of this name");
    if (found->field.components != components)
      throw input_error("array \"" + name + "\": " + std::to_string(components) +
                        " components, and in another piece " + std::to_string(found->field.components));
    found->tuples += tuples;
    return *found;
  }
  static std::vector<double> values_of(const xml_element& array, const column& into,
                                       const vtk_encoding& encoding, std::uint64_t tuples) {
    return read_vtk_array<double>(array, encoding,
                                  tuples * static_cast<std::uint64_t>(into.field.components));
  }
  static void append(std::vector<double>& to, std::span<const double> values) {
    to.insert(to.end(), values.begin(), values.end());
  }

  std::vector<column> at_points_, in_cells_;
  std::uint64_t points_ = 0, cells_ = 0; ///< of all pieces so far
};

} // namespace detail

} // namespace dovetail::io
