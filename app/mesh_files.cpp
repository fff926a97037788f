#include "mesh_files.hpp"

#include "failure.hpp"

#include <algorithm>
#include <cctype>
#include <functional>
#include <string>
#include <utility>

namespace dovetail::app {
namespace {

std::string extension_of(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

} // namespace

bool is_of_triangles(const io::loaded_mesh& mesh) {
  return mesh.mesh.elements.empty() && !mesh.triangles.empty();
}

simplicial_mesh<2> take_triangles(io::loaded_mesh mesh) {
  return {std::move(mesh.mesh.points), std::move(mesh.triangles), std::move(mesh.triangle_tags)};
}

void check_can_write(const std::filesystem::path& file) {
  const std::string extension = extension_of(file);
  if (extension != ".vtu" && extension != ".msh")
    throw command_line_error(file.string() + ": meshes are written to files with the extension .vtu or .msh");
}

template <int D>
void write_mesh_file(const simplicial_mesh<D>& mesh, const io::tag_names& names,
                     const std::filesystem::path& file) {
  if (extension_of(file) == ".msh")
    io::write_msh(mesh, file, names);
  else
    io::write_vtu(mesh, file, {}, names);
}

template void write_mesh_file<2>(const simplicial_mesh<2>&, const io::tag_names&,
                                 const std::filesystem::path&);
template void write_mesh_file<3>(const simplicial_mesh<3>&, const io::tag_names&,
                                 const std::filesystem::path&);

std::string left_out(const io::loaded_mesh& mesh, int dimension) {
  std::string text;
  const auto add = [&](const std::string& what) { text += (text.empty() ? "" : ", ") + what; };
  if (dimension == 3 && !mesh.triangles.empty())
    add(std::to_string(mesh.triangles.size()) + " triangles" +
        (mesh.triangle_tags.empty() ? "" : " with their tags"));
  const auto& parts = mesh.subdomains;
  if (std::adjacent_find(parts.begin(), parts.end(), std::not_equal_to<>()) != parts.end())
    add("the subdomains of elements");
  const auto& ids = mesh.node_ids; // consecutive ones are made anew
  if (std::adjacent_find(ids.begin(), ids.end(), [](global_id a, global_id b) { return b != a + 1; }) !=
      ids.end())
    add("the numbers of points");
  for (const auto& array : mesh.point_scalars)
    add("the values '" + array.name + "' of points");
  return text;
}

} // namespace dovetail::app
