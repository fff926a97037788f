/// @file
/// What `write_surface.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/output_file.hpp"
#include "dovetail/files/write_surface.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

namespace dovetail::io {

DOVETAIL_INLINE void write_stl(const simplicial_mesh<2>& mesh, const std::filesystem::path& path) {
  output_file file(path);
  std::string header = "written by dovetail";
  header.resize(80, ' ');
  file.text(header);
  file.value(static_cast<std::uint32_t>(mesh.elements.size()));
  for (const auto& triangle : mesh.elements) {
    const auto p = [&](std::size_t k) { return mesh.points[triangle[k]]; };
    for (const auto v : {normalized(cross(p(1) - p(0), p(2) - p(0))), p(0), p(1), p(2)})
      for (int axis = 0; axis < 3; ++axis)
        file.value(static_cast<float>(v[axis]));
    file.value<std::uint16_t>(0);
  }
  file.commit();
}

DOVETAIL_INLINE void write_off(const simplicial_mesh<2>& mesh, const std::filesystem::path& path) {
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
