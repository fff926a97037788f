#include "view_groups.hpp"

#include "dovetail/core/error.hpp"
#include "dovetail/core/input_file.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/core/xml_tree.hpp"
#include "dovetail/files/second_order_nodes.hpp"
#include "dovetail/files/vtk_arrays.hpp"
#include "dovetail/files/vtu_reader.hpp"
#include "dovetail/files/zlib.hpp"

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>

namespace dovetail::app {
namespace {

/// What is inside of elements, one in the other. Throws `input_error`.
const xml_element& inside(const xml_element& element, std::initializer_list<std::string_view> names) {
  const xml_element* at = &element;
  for (const std::string_view name : names)
    if (at = at->child(name); at == nullptr)
      throw input_error("there is no <" + std::string(name) + ">");
  return *at;
}

/// Throws `input_error`.
const xml_element& array_of(const xml_element& section, std::string_view name) {
  for (const xml_element& array : section.children)
    if (array.attribute("Name") == name)
      return array;
  throw input_error("there is no array " + std::string(name));
}

/// The strings of an array of VTK, each as the codes of its bytes and a zero.
tag_names names_in(const xml_element& array) {
  file_cursor at(array.text, "patch_names");
  tag_names names;
  std::string name;
  for (at.skip_space(); !at.at_end(); at.skip_space())
    if (const int code = at.number<int>(); code != 0) {
      name += static_cast<char>(code);
    } else {
      names.emplace_back(static_cast<local_id>(names.size()), name);
      name.clear();
    }
  return names;
}

std::array<global_id, 3> ascending(std::array<global_id, 3> ids) {
  std::sort(ids.begin(), ids.end());
  return ids;
}

} // namespace

std::filesystem::path surface_beside(const std::filesystem::path& mesh) {
  const std::filesystem::path file = mesh.parent_path() / "surface.vtp";
  std::error_code failure;
  const bool is_there = mesh.extension() == ".pvtu" && std::filesystem::is_regular_file(file, failure);
  return is_there ? file : std::filesystem::path();
}

surface_groups surface_groups::beside(const std::filesystem::path& mesh) {
  const std::filesystem::path file = surface_beside(mesh);
  if (file.empty())
    return {};
  try {
    return read(file);
  } catch (const input_error&) { // the mesh is to be seen without it
    return {};
  }
}

surface_groups surface_groups::read(const std::filesystem::path& file) {
  const io::loaded_mesh surface =
      io::corners_of(io::vtu_reader{.expand = io::zlib_expand, .elements = io::element_order::any}(file));
  if (surface.node_ids.size() != surface.mesh.points.size())
    throw input_error("its points have no numbers");
  const std::string content = read_file(file);
  const xml_element root = xml_parser(content, file.string()).parse();
  const xml_element& grid = inside(root, {"PolyData"});
  const std::vector<local_id> groups =
      io::read_vtk_array<local_id>(array_of(inside(grid, {"Piece", "CellData"}), "patch"),
                                   io::read_vtk_encoding(root, io::zlib_expand), surface.triangles.size());
  surface_groups made;
  made.names_ = names_in(array_of(inside(grid, {"FieldData"}), "patch_names"));
  for (std::size_t v = 0; v < surface.node_ids.size(); ++v)
    made.points_.emplace_back(surface.node_ids[v], surface.mesh.points[v]);
  sort_all(made.points_, [](const auto& a, const auto& b) { return a.first < b.first; });
  for (std::size_t t = 0; t < groups.size(); ++t) {
    const auto& [a, b, c] = surface.triangles[t];
    made.triangles_.emplace_back(ascending({surface.node_ids[a], surface.node_ids[b], surface.node_ids[c]}),
                                 groups[t]);
  }
  sort_all(made.triangles_);
  return made;
}

bool surface_groups::agrees(global_id id, vec3 at) const {
  const auto found = std::lower_bound(points_.begin(), points_.end(), id,
                                      [](const auto& point, global_id value) { return point.first < value; });
  return found == points_.end() || found->first != id || found->second == at;
}

std::optional<local_id> surface_groups::group_of(std::array<global_id, 3> ids) const {
  const auto key = ascending(ids);
  const auto found = std::lower_bound(triangles_.begin(), triangles_.end(),
                                      std::pair(key, std::numeric_limits<local_id>::min()));
  return found == triangles_.end() || found->first != key ? std::nullopt : std::optional(found->second);
}

} // namespace dovetail::app
