/// @file
/// What `vtu_reader.hpp` declares.
#pragma once

#include "dovetail/core/input_file.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/xml_tree.hpp"
#include "dovetail/files/merge_points.hpp"
#include "dovetail/files/second_order_nodes.hpp"
#include "dovetail/files/vtk_arrays.hpp"
#include "dovetail/files/vtu_fields.hpp"
#include "dovetail/files/vtu_reader.hpp"
#include "dovetail/mesh/loaded_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dovetail::io {

namespace detail {

/// VTK's numbers of cell types that are read, and of some that are named in errors.
enum class vtk_cell {
  vertex = 1,
  line = 3,
  triangle = 5,
  tetrahedron = 10,
  quadratic_triangle = 22,
  quadratic_tetrahedron = 24
};

inline std::string vtk_cell_name(int type) {
  switch (type) {
  case 7:
    return "polygon";
  case 8:
  case 9:
    return "quadrilateral";
  case 11:
  case 12:
    return "hexahedron";
  case 13:
    return "dihedral";
  case 14:
    return "pyramid";
  case 22:
    return "quadratic triangle";
  case 24:
    return "quadratic tetrahedron";
  case 42:
    return "polyhedron";
  default:
    return "cell of type " + std::to_string(type);
  }
}

inline std::uint64_t count_attribute(const xml_element& element, std::string_view key) {
  const auto text = element.attribute(key);
  if (text.empty())
    throw input_error("a <" + std::string(element.name) + "> has no " + std::string(key));
  return file_cursor(text, std::string(key)).number<std::uint64_t>();
}

inline const xml_element& required_child(const xml_element& parent, std::string_view name) {
  const auto* found = parent.child(name);
  if (found == nullptr)
    throw input_error("there is no <" + std::string(name) + "> in <" + std::string(parent.name) + ">");
  return *found;
}

/// The data array of that name in a section that may be missing; null when there is none.
inline const xml_element* find_array(const xml_element* section, std::string_view name) {
  if (section != nullptr)
    for (const auto& array : section->children)
      if (array.name == "DataArray" && xml_unescaped(array.attribute("Name")) == name)
        return &array;
  return nullptr;
}

inline const xml_element& required_array(const xml_element& section, std::string_view name) {
  const auto* found = find_array(&section, name);
  if (found == nullptr)
    throw input_error("there is no array \"" + std::string(name) + "\" in <" + std::string(section.name) +
                      ">");
  return *found;
}

/// One piece of a VTU or VTP file is appended to a mesh.
class vtu_piece_reader {
public:
  /// Fields are read where there is a reader for them.
  vtu_piece_reader(const xml_element& piece, const vtk_encoding& encoding, loaded_mesh& mesh,
                   vtu_field_reader* fields, element_order elements)
      : piece_(piece), encoding_(encoding), mesh_(mesh), fields_(fields), elements_(elements),
        points_(count_attribute(piece, "NumberOfPoints")),
        is_of_polygons_(!piece.attribute("NumberOfPolys").empty()),
        cells_(count_attribute(piece, is_of_polygons_ ? "NumberOfPolys" : "NumberOfCells")),
        first_point_(static_cast<local_id>(mesh.mesh.points.size())) {
    constexpr auto most = static_cast<std::uint64_t>(std::numeric_limits<local_id>::max());
    if (points_ > most - mesh.mesh.points.size() || cells_ > most)
      throw input_error("the mesh is too large to be read at once");
    for (const char* others : {"NumberOfVerts", "NumberOfLines", "NumberOfStrips"})
      if (is_of_polygons_ && !piece.attribute(others).empty() && count_attribute(piece, others) != 0)
        throw input_error("there are points, lines or strips; only triangles are read");
  }

  void read() {
    read_points();
    read_point_data();
    read_cells();
  }

private:
  void read_points() {
    const auto& section = required_child(piece_, "Points");
    const auto* array = section.child("DataArray");
    if (array == nullptr)
      throw input_error("there are no point coordinates");
    const auto values = read_vtk_array<double>(*array, encoding_, 3 * points_);
    for (std::size_t i = 0; i < values.size(); i += 3) {
      const vec3 p{values[i], values[i + 1], values[i + 2]};
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
        throw input_error("point " + std::to_string(i / 3) + " has a coordinate that is not finite");
      mesh_.mesh.points.push_back(p);
    }
  }
  void read_point_data() {
    const auto* section = piece_.child("PointData");
    if (const auto* ids = find_array(section, "GlobalNodeIds")) {
      const auto values = read_vtk_array<global_id>(*ids, encoding_, points_);
      mesh_.node_ids.insert(mesh_.node_ids.end(), values.begin(), values.end());
    }
    if (fields_ != nullptr)
      fields_->read_points(section, encoding_, points_);
    if (section == nullptr)
      return;
    for (const auto& array : section->children) {
      const auto components = array.attribute("NumberOfComponents");
      const auto name = xml_unescaped(array.attribute("Name"));
      if (array.name != "DataArray" || name == "GlobalNodeIds")
        continue;
      if ((!components.empty() && components != "1") || array.attribute("type") == "String") {
        if (fields_ == nullptr || array.attribute("type") == "String")
          mesh_.pass_over("arrays of points that are not numbers or of several components");
        continue;
      }
      const auto values = read_vtk_array<double>(array, encoding_, points_);
      auto& all = scalars(name);
      all.resize(static_cast<std::size_t>(first_point_), std::numeric_limits<double>::quiet_NaN());
      all.insert(all.end(), values.begin(), values.end());
    }
  }
  std::vector<double>& scalars(const std::string& name) {
    for (auto& array : mesh_.point_scalars)
      if (array.name == name)
        return array.values;
    if (mesh_.point_scalars.size() == most_point_arrays)
      throw input_error("there are more than " + std::to_string(most_point_arrays) + " arrays of points");
    mesh_.point_scalars.push_back({name, {}});
    return mesh_.point_scalars.back().values;
  }

  /// The first of the cell arrays that exists, or nothing.
  std::vector<local_id> cell_values(std::initializer_list<std::string_view> names) {
    for (const auto name : names)
      if (const auto* array = find_array(piece_.child("CellData"), name)) {
        used_.push_back(array);
        return read_vtk_array<local_id>(*array, encoding_, cells_);
      }
    return {};
  }
  /// Numbers of cells mean nothing in another mesh; the other arrays of cells do.
  void name_unused_arrays() {
    if (const auto* section = piece_.child("CellData"))
      for (const auto& array : section->children)
        if (const auto name = array.attribute("Name");
            std::find(used_.begin(), used_.end(), &array) == used_.end() && name != "GlobalCellIds" &&
            mesh_.passed_over.size() < most_point_arrays)
          mesh_.pass_over("the values '" + xml_unescaped(name) + "' of cells");
  }
  void read_cells() {
    const auto& section = required_child(piece_, is_of_polygons_ ? "Polys" : "Cells");
    const auto types = is_of_polygons_
                           ? std::vector<int>{}
                           : read_vtk_array<int>(required_array(section, "types"), encoding_, cells_);
    const auto offsets = read_vtk_array<std::int64_t>(required_array(section, "offsets"), encoding_, cells_);
    const auto corners = offsets.empty() ? 0 : offsets.back();
    if (corners < 0)
      throw input_error("cell offsets are negative");
    const auto connectivity = read_vtk_array<std::int64_t>(required_array(section, "connectivity"), encoding_,
                                                           static_cast<std::uint64_t>(corners));
    const auto materials = cell_values({"region", "material", "gmsh:physical", "CellEntityIds"});
    const auto subdomains = cell_values({"subdomain"});
    const auto ghosts = cell_values({"vtkGhostType"});
    const auto cad_faces = cell_values({"cad_face", "patch", "region", "gmsh:physical", "CellEntityIds"});
    if (fields_ == nullptr)
      name_unused_arrays();
    std::vector<std::size_t> tetrahedra, triangles; // that are read
    constexpr local_id duplicate = 1;               // vtkGhostType: the cell belongs to another piece
    std::int64_t begin = 0;
    for (std::size_t c = 0; c < cells_; ++c) {
      const auto end = offsets[c];
      if (end < begin || end > corners)
        throw input_error("the offsets of the cells do not grow at cell " + std::to_string(c));
      const auto vertices =
          std::span(connectivity)
              .subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin));
      begin = end;
      if (!ghosts.empty() && (ghosts[c] & duplicate) != 0)
        continue;
      const auto type = is_of_polygons_ ? vtk_cell::triangle : static_cast<vtk_cell>(types[c]);
      if (type == vtk_cell::tetrahedron || (takes_quadratic() && type == vtk_cell::quadratic_tetrahedron)) {
        tetrahedra.push_back(c);
        add_cell<3>(vertices, c, type != vtk_cell::tetrahedron, mesh_.mesh.elements, mesh_.middles);
        mesh_.mesh.tags.push_back(materials.empty() ? 0 : materials[c]);
        if (!subdomains.empty())
          mesh_.subdomains.push_back(subdomains[c]);
      } else if (type == vtk_cell::triangle || (takes_quadratic() && type == vtk_cell::quadratic_triangle)) {
        triangles.push_back(c);
        add_cell<2>(vertices, c, type != vtk_cell::triangle, mesh_.triangles, mesh_.triangle_middles);
        mesh_.triangle_tags.push_back(cad_faces.empty() ? 0 : cad_faces[c]);
        if (!subdomains.empty() && !is_of_polygons_) // of a skeleton it is the one behind
          mesh_.triangle_subdomains.push_back(subdomains[c]);
        if (!subdomains.empty() && subdomains[c] != no_id)
          mesh_.pass_over("the subdomains of triangles");
      } else if (type == vtk_cell::line || type == vtk_cell::vertex) {
        mesh_.pass_over("points and lines as cells");
      } else {
        throw input_error("cell " + std::to_string(c) + " is a " + vtk_cell_name(types[c]) +
                          "; only linear tetrahedra and triangles are read");
      }
    }
    if (fields_ != nullptr)
      fields_->read_cells(piece_.child("CellData"), encoding_, cells_, tetrahedra, triangles);
  }
  bool takes_quadratic() const { return elements_ == element_order::any; }
  template <int D>
  void add_cell(std::span<const std::int64_t> vertices, std::size_t cell, bool quadratic,
                std::vector<simplex<D>>& elements,
                std::vector<std::array<local_id, edges_per_element<D>>>& middles) const {
    const std::size_t count = quadratic ? quadratic_nodes<D> : D + 1;
    quadratic_simplex<D> nodes{};
    if (vertices.size() != count)
      throw input_error("cell " + std::to_string(cell) + " has " + std::to_string(vertices.size()) +
                        " points instead of " + std::to_string(count));
    for (std::size_t k = 0; k < count; ++k) {
      if (vertices[k] < 0 || static_cast<std::uint64_t>(vertices[k]) >= points_)
        throw input_error("cell " + std::to_string(cell) + " refers to point " + std::to_string(vertices[k]) +
                          " of " + std::to_string(points_));
      nodes[k] = first_point_ + static_cast<local_id>(vertices[k]);
    }
    append_element<D>(nodes, quadratic, elements, middles);
  }

  const xml_element& piece_;
  const vtk_encoding& encoding_;
  loaded_mesh& mesh_;
  vtu_field_reader* fields_;
  element_order elements_;
  std::uint64_t points_;
  bool is_of_polygons_;
  std::uint64_t cells_;
  local_id first_point_;
  std::vector<const xml_element*> used_; ///< arrays of cells
};

/// The strings of a string array in the field data.
inline std::vector<std::string> field_strings(const xml_element& grid, std::string_view name) {
  std::vector<std::string> strings;
  const auto* section = grid.child("FieldData");
  if (section == nullptr)
    return strings;
  for (const auto& array : section->children)
    if (array.attribute("Name") == name && array.attribute("format") == "ascii") {
      file_cursor at(array.text, "string");
      std::string text;
      for (at.skip_space(); !at.at_end(); at.skip_space()) {
        const auto code = at.number<int>();
        if (code != 0) {
          text += static_cast<char>(code);
          continue;
        }
        strings.push_back(std::exchange(text, {}));
      }
    }
  return strings;
}

/// Appends the pieces of one VTU or VTP file to a mesh.
inline void append_vtu(const std::filesystem::path& file, const xml_element& root, const vtu_reader& how,
                       loaded_mesh& mesh, vtu_field_reader* fields) {
  try {
    const auto encoding = read_vtk_encoding(root, how.expand);
    const auto& grid = required_child(root, root.attribute("type"));
    bool found = false;
    const char* names_of_triangles = "patch_names";
    for (const auto& piece : grid.children)
      if (piece.name == "Piece") {
        vtu_piece_reader(piece, encoding, mesh, fields, how.elements).read();
        found = true;
        if (find_array(piece.child("CellData"), "cad_face"))
          names_of_triangles = "face_names";
      }
    if (!found)
      throw input_error("there is no <Piece>");
    for (const auto& [array, names] : {std::pair("region_names", &mesh.material_names),
                                       std::pair(names_of_triangles, &mesh.triangle_names)})
      if (names->empty())
        for (local_id tag = 0; auto& name : field_strings(grid, array)) {
          if (!name.empty())
            names->emplace_back(tag, std::move(name));
          ++tag;
        }
  } catch (const input_error& problem) {
    throw input_error(file.string() + ": " + problem.what());
  }
}

DOVETAIL_INLINE std::vector<std::filesystem::path> pvtu_sources(const std::filesystem::path& file,
                                                                const xml_element& root) {
  const auto* grid = root.child("PUnstructuredGrid");
  if (grid == nullptr)
    throw input_error(file.string() + ": there is no <PUnstructuredGrid>");
  std::vector<std::filesystem::path> sources;
  for (const auto& piece : grid->children)
    if (piece.name == "Piece")
      sources.push_back(file.parent_path() / xml_unescaped(piece.attribute("Source")));
  if (sources.empty())
    throw input_error(file.string() + ": there is no <Piece>");
  auto sorted = sources;
  std::sort(sorted.begin(), sorted.end());
  if (const auto twice = std::adjacent_find(sorted.begin(), sorted.end()); twice != sorted.end())
    throw input_error(file.string() + ": it names " + twice->string() + " twice");
  return sources;
}

inline void append_pvtu(const std::filesystem::path& file, const xml_element& root, const vtu_reader& how,
                        loaded_mesh& mesh, vtu_field_reader* fields) {
  for (const auto& path : pvtu_sources(file, root)) {
    const auto content = read_file(path);
    const auto piece_root = xml_parser(content, path.string()).parse();
    append_vtu(path, piece_root, how, mesh, fields);
  }
}

} // namespace detail

DOVETAIL_INLINE loaded_mesh vtu_reader::operator()(const std::filesystem::path& file) const {
  const auto content = read_file(file);
  const auto root = xml_parser(content, file.string()).parse();
  const auto type = root.attribute("type");
  loaded_mesh mesh;
  detail::vtu_field_reader reader_of_fields;
  auto* const of_fields = fields ? &reader_of_fields : nullptr;
  if (root.name != "VTKFile")
    throw input_error(file.string() + ": this is not a VTK XML file");
  if (type == "UnstructuredGrid" || type == "PolyData")
    detail::append_vtu(file, root, *this, mesh, of_fields);
  else if (type == "PUnstructuredGrid")
    detail::append_pvtu(file, root, *this, mesh, of_fields);
  else
    throw input_error(file.string() + ": this VTK file has a " + std::string(type) +
                      "; an UnstructuredGrid, PUnstructuredGrid or PolyData is needed");
  complete_point_data(mesh);
  if (mesh.mesh.elements.empty() && mesh.triangle_names.empty()) // the regions are of triangles
    mesh.triangle_names = std::exchange(mesh.material_names, {});
  try {
    if (fields)
      reader_of_fields.give_to(mesh);
    if (type == "PUnstructuredGrid" || repeats_points(mesh))
      merge_points(mesh);
  } catch (const input_error& problem) {
    throw input_error(file.string() + ": " + problem.what());
  }
  return mesh;
}

} // namespace dovetail::io
