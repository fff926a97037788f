/// @file
/// The skeleton of a mesh of triangles as a VTP file: the edges on CAD curves and on lines between
/// subdomains.
#pragma once

#include "dovetail/core/sequence.hpp"
#include "dovetail/io/vtk_xml_output.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"

#include <string>

namespace dovetail::io::detail {

/// Point data GlobalNodeIds; cell data cad_curve (-1 on a line inside a face), subdomain and front_subdomain
/// (-1 where there is none).
inline void write_lines_vtp(output_file& file, const distributed_simplicial_mesh<2>& mesh) {
  const auto& skeleton = mesh.skeleton;
  const auto points = skeleton.points.size();
  const auto cells = skeleton.sides.size();
  appended_layout layout(file);
  file.text(vtk_xml_opening("PolyData") + "<PolyData>\n<Piece NumberOfPoints=\"" + std::to_string(points) +
            "\" NumberOfVerts=\"0\" NumberOfLines=\"" + std::to_string(cells) +
            "\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n<Points>\n");
  layout.array<double>("Points", points, 3);
  file.text("</Points>\n<PointData GlobalIds=\"GlobalNodeIds\">\n");
  layout.array<global_id>("GlobalNodeIds", points);
  file.text("</PointData>\n<Lines>\n");
  layout.array<local_id>("connectivity", 2 * cells);
  layout.array<local_id>("offsets", cells);
  file.text("</Lines>\n<CellData Scalars=\"cad_curve\">\n");
  layout.array<local_id>("cad_curve", cells);
  layout.array<local_id>("subdomain", cells);
  layout.array<local_id>("front_subdomain", cells);
  file.text("</CellData>\n</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_");
  append_values(file, span_of(skeleton.points));
  append_computed<global_id>(file, points, [](auto i) { return static_cast<global_id>(i); });
  append_values(file, span_of(skeleton.sides));
  append_computed<local_id>(file, cells, [](auto i) { return static_cast<local_id>(2 * (i + 1)); });
  append_values(file, span_of(skeleton.side_hosts));
  append_computed<local_id>(file, cells, [&](auto i) { return skeleton.subdomains[i][0]; });
  append_computed<local_id>(file, cells, [&](auto i) { return skeleton.subdomains[i][1]; });
  file.text("\n</AppendedData>\n</VTKFile>\n");
}

} // namespace dovetail::io::detail
