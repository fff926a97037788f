/// @file
/// The sides of a skeleton as a VTP file: triangles on the boundary of the domain, or inside it; or, of a
/// mesh of triangles, all edges on CAD curves and on lines between subdomains.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/files/face_groups.hpp"
#include "dovetail/files/vtk_xml_output.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"

#include <string>
#include <vector>

namespace dovetail::io::detail {

enum class skeleton_part { boundary, interfaces, all };

/// The chosen sides on their own points.
template <int D>
struct skeleton_extract {
  std::vector<local_id> sides;            ///< indices into the skeleton
  std::vector<local_id> points;           ///< indices into the skeleton, ascending
  std::vector<simplex<D - 1>> renumbered; ///< the sides on `points`
};

/// O(skeleton).
template <int D>
skeleton_extract<D> extract(const simplicial_skeleton<D>& skeleton, skeleton_part part) {
  skeleton_extract<D> result;
  std::vector<local_id> place(skeleton.points.size(), no_id);
  for (std::size_t t = 0; t < skeleton.sides.size(); ++t)
    if (part == skeleton_part::all ||
        (skeleton.subdomains[t][1] == no_id) == (part == skeleton_part::boundary)) {
      result.sides.push_back(static_cast<local_id>(t));
      for (const auto v : skeleton.sides[t])
        place[v] = 0;
    }
  for (std::size_t v = 0; v < place.size(); ++v)
    if (place[v] != no_id) {
      place[v] = static_cast<local_id>(result.points.size());
      result.points.push_back(static_cast<local_id>(v));
    }
  for (const auto t : result.sides) {
    simplex<D - 1> placed;
    for (std::size_t k = 0; k < placed.size(); ++k)
      placed[k] = place[skeleton.sides[t][k]];
    result.renumbered.push_back(placed);
  }
  return result;
}

/// Point data GlobalNodeIds; cell data cad_face and patch (its group), or cad_curve (-1 where there is none),
/// subdomain and, unless it is the boundary, front_subdomain; for faces field data with the names.
template <int D>
void write_skeleton_vtp(output_file& file, const distributed_simplicial_mesh<D>& mesh, skeleton_part part) {
  const auto& skeleton = mesh.skeleton;
  const auto chosen = extract(skeleton, part);
  const auto groups = collect_face_groups(mesh);
  const auto points = chosen.points.size();
  const auto cells = chosen.sides.size();
  const bool two_sided = part != skeleton_part::boundary;
  const std::string on = D == 3 ? "cad_face" : "cad_curve", shape = D == 3 ? "Polys" : "Lines";
  const auto count_of = [&](const char* what) {
    return std::string(" NumberOf") + what + "=\"" + std::to_string(shape == what ? cells : 0) + "\"";
  };

  appended_layout layout(file);
  file.text(vtk_xml_opening("PolyData") + "<PolyData>\n");
  if (D == 3)
    file.text(vtk_field_data({{"patch_names", groups.names}, {"face_names", mesh.face_names}}));
  file.text("<Piece NumberOfPoints=\"" + std::to_string(points) + "\"" + count_of("Verts") +
            count_of("Lines") + count_of("Strips") + count_of("Polys") + ">\n<Points>\n");
  layout.array<double>("Points", points, 3);
  file.text("</Points>\n<PointData GlobalIds=\"GlobalNodeIds\">\n");
  layout.array<global_id>("GlobalNodeIds", points);
  file.text("</PointData>\n<" + shape + ">\n");
  layout.array<local_id>("connectivity", D * cells);
  layout.array<local_id>("offsets", cells);
  file.text("</" + shape + ">\n<CellData Scalars=\"" + on + "\">\n");
  layout.array<local_id>(on, cells);
  if (D == 3)
    layout.array<local_id>("patch", cells);
  layout.array<local_id>("subdomain", cells);
  if (two_sided)
    layout.array<local_id>("front_subdomain", cells);
  file.text("</CellData>\n</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_");

  const auto point = [&](std::uint64_t i) { return static_cast<std::size_t>(chosen.points[i]); };
  const auto side = [&](std::uint64_t i) { return static_cast<std::size_t>(chosen.sides[i]); };
  append_computed<vec3>(file, points, [&](auto i) { return skeleton.points[point(i)]; });
  append_computed<global_id>(file, points, [&](auto i) { return static_cast<global_id>(point(i)); });
  append_values(file, span_of(chosen.renumbered));
  append_computed<local_id>(file, cells, [](auto i) { return static_cast<local_id>(D * (i + 1)); });
  append_computed<local_id>(file, cells, [&](auto i) { return skeleton.side_hosts[side(i)]; });
  if (D == 3)
    append_computed<local_id>(file, cells, [&](auto i) {
      const auto f = skeleton.side_hosts[side(i)];
      return f == no_id ? no_id : groups.of_face[f];
    });
  append_computed<local_id>(file, cells, [&](auto i) { return skeleton.subdomains[side(i)][0]; });
  if (two_sided)
    append_computed<local_id>(file, cells, [&](auto i) { return skeleton.subdomains[side(i)][1]; });
  file.text("\n</AppendedData>\n</VTKFile>\n");
}

} // namespace dovetail::io::detail
