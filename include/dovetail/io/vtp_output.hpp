/// @file
/// The triangles of the skeleton as a VTP file: the boundary of the domain, or the faces inside it.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/io/patches.hpp"
#include "dovetail/io/vtk_xml_output.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"

#include <vector>

namespace dovetail::io::detail {

enum class skeleton_part { boundary, interfaces };

/// The chosen triangles on their own points.
struct skeleton_extract {
  std::vector<local_id> triangles;    ///< indices into the skeleton
  std::vector<local_id> points;       ///< indices into the skeleton, ascending
  std::vector<simplex<2>> renumbered; ///< the triangles on `points`
};

/// O(skeleton).
inline skeleton_extract extract(const fine_skeleton& skeleton, skeleton_part part) {
  skeleton_extract result;
  std::vector<local_id> place(skeleton.points.size(), no_id);
  for (std::size_t t = 0; t < skeleton.sides.size(); ++t)
    if ((skeleton.subdomains[t][1] == no_id) == (part == skeleton_part::boundary)) {
      result.triangles.push_back(static_cast<local_id>(t));
      for (const auto v : skeleton.sides[t])
        place[static_cast<std::size_t>(v)] = 0;
    }
  for (std::size_t v = 0; v < place.size(); ++v)
    if (place[v] != no_id) {
      place[v] = static_cast<local_id>(result.points.size());
      result.points.push_back(static_cast<local_id>(v));
    }
  for (const auto t : result.triangles) {
    simplex<2> placed;
    for (std::size_t k = 0; k < placed.size(); ++k)
      placed[k] = place[static_cast<std::size_t>(skeleton.sides[static_cast<std::size_t>(t)][k])];
    result.renumbered.push_back(placed);
  }
  return result;
}

/// Point data GlobalNodeIds; cell data cad_face and patch (-1 where there is none) and subdomain, for
/// interfaces also the subdomain in front; field data with the names.
inline void write_skeleton_vtp(output_file& file, const distributed_mesh& mesh, skeleton_part part) {
  const auto& skeleton = mesh.skeleton;
  const auto surface = extract(skeleton, part);
  const auto patches = collect_patches(mesh);
  const auto points = surface.points.size();
  const auto cells = surface.triangles.size();
  const bool two_sided = part == skeleton_part::interfaces;

  appended_layout layout(file);
  file.text(vtk_xml_opening("PolyData"));
  file.text("<PolyData>\n" +
            vtk_field_data({{"patch_names", patches.names}, {"face_names", mesh.face_names}}));
  file.text("<Piece NumberOfPoints=\"" + std::to_string(points) +
            "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"" +
            std::to_string(cells) + "\">\n<Points>\n");
  layout.array<double>("Points", points, 3);
  file.text("</Points>\n<PointData GlobalIds=\"GlobalNodeIds\">\n");
  layout.array<global_id>("GlobalNodeIds", points);
  file.text("</PointData>\n<Polys>\n");
  layout.array<local_id>("connectivity", 3 * cells);
  layout.array<local_id>("offsets", cells);
  file.text("</Polys>\n<CellData Scalars=\"cad_face\">\n");
  layout.array<local_id>("cad_face", cells);
  layout.array<local_id>("patch", cells);
  layout.array<local_id>("subdomain", cells);
  if (two_sided)
    layout.array<local_id>("front_subdomain", cells);
  file.text("</CellData>\n</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_");

  const auto point = [&](std::uint64_t i) { return static_cast<std::size_t>(surface.points[i]); };
  const auto triangle = [&](std::uint64_t i) { return static_cast<std::size_t>(surface.triangles[i]); };
  append_computed<vec3>(file, points, [&](auto i) { return skeleton.points[point(i)]; });
  append_computed<global_id>(file, points, [&](auto i) { return static_cast<global_id>(point(i)); });
  append_values(file, span_of(std::as_const(surface.renumbered)));
  append_computed<local_id>(file, cells, [](auto i) { return static_cast<local_id>(3 * (i + 1)); });
  append_computed<local_id>(file, cells, [&](auto i) { return skeleton.side_hosts[triangle(i)]; });
  append_computed<local_id>(file, cells, [&](auto i) {
    const auto f = skeleton.side_hosts[triangle(i)];
    return f == no_id ? no_id : patches.of_face[static_cast<std::size_t>(f)];
  });
  append_computed<local_id>(file, cells, [&](auto i) { return skeleton.subdomains[triangle(i)][0]; });
  if (two_sided)
    append_computed<local_id>(file, cells, [&](auto i) { return skeleton.subdomains[triangle(i)][1]; });
  file.text("\n</AppendedData>\n</VTKFile>\n");
}

} // namespace dovetail::io::detail
