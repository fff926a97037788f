/// @file
/// What `pvtu_format.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/files/face_groups.hpp"
#include "dovetail/files/vtk_xml_output.hpp"
#include "dovetail/solver/pvtu_format.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

namespace dovetail::io {

DOVETAIL_INLINE std::string rank_digits(local_id rank) {
  const std::string digits = std::to_string(rank);
  return std::string(4 - std::min<std::size_t>(4, digits.size()), '0') + digits;
}

template <int D>
void pvtu_format::write(const rank_source<D>& source, const rank_mesh<D>& rank,
                        const std::vector<std::filesystem::path>& paths) const {
  const std::uint64_t nodes = nodes_per_element(rank);
  const auto points = rank.mesh.points.size();
  const auto elements = rank.mesh.elements.size();
  output_file file(paths.front());
  appended_layout layout(file);
  file.text(vtk_xml_opening("UnstructuredGrid"));
  file.text("<UnstructuredGrid>\n" + vtk_field_data({{"region_names", names_of_tags(source.mesh)}}));
  file.text("<Piece NumberOfPoints=\"" + std::to_string(points) + "\" NumberOfCells=\"" +
            std::to_string(elements) + "\">\n<Points>\n");
  layout.template array<double>("Points", points, 3);
  file.text("</Points>\n<PointData GlobalIds=\"GlobalNodeIds\">\n");
  layout.template array<global_id>("GlobalNodeIds", points);
  layout.template array<global_id>("mesh_node", points);
  layout.template array<local_id>("owner", points);
  layout.template array<std::uint8_t>("vtkGhostType", points);
  file.text("</PointData>\n<Cells>\n");
  layout.template array<local_id>("connectivity", nodes * elements);
  layout.template array<std::int64_t>("offsets", elements);
  layout.template array<std::uint8_t>("types", elements);
  file.text("</Cells>\n<CellData Scalars=\"subdomain\" GlobalIds=\"GlobalCellIds\">\n");
  layout.template array<global_id>("GlobalCellIds", elements);
  layout.template array<global_id>("mesh_element", elements);
  layout.template array<local_id>("subdomain", elements);
  layout.template array<local_id>("region", elements);
  layout.template array<std::uint8_t>("vtkGhostType", elements);
  file.text("</CellData>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_");

  const auto is_of_another = [&](local_id owner) { return std::uint8_t{owner != rank.rank}; };
  append_values(file, span_of(rank.mesh.points));
  append_values(file, span_of(rank.vertex_ids));
  append_values(file, span_of(rank.vertex_numbers));
  append_values(file, span_of(rank.vertex_owners));
  append_computed<std::uint8_t>(file, points, [&](auto v) { return is_of_another(rank.vertex_owners[v]); });
  file.value<std::uint64_t>(nodes * elements * sizeof(local_id));
  for (std::size_t e = 0; e < elements; ++e)
    for_each_node(rank, e, [&](local_id v) { file.value(v); });
  append_computed<std::int64_t>(file, elements,
                                [&](auto e) { return static_cast<std::int64_t>(nodes * (e + 1)); });
  append_computed<std::uint8_t>(file, elements,
                                [&](auto) { return vtk_cell_type(D, !rank.middles.empty()); });
  append_values(file, span_of(rank.element_ids));
  append_values(file, span_of(rank.element_numbers));
  append_values(file, span_of(rank.subdomains));
  append_values(file, span_of(rank.mesh.tags));
  append_computed<std::uint8_t>(file, elements,
                                [&](auto e) { return is_of_another(rank.element_owners[e]); });
  file.text("\n</AppendedData>\n</VTKFile>\n");
  file.commit();
}

template <int D>
void pvtu_format::write_all(const rank_source<D>& source,
                            const std::vector<std::filesystem::path>& paths) const {
  output_file file(paths.front());
  const auto array = [&](const char* type, const char* name) {
    file.text(std::string("<PDataArray type=\"") + type + "\" Name=\"" + name + "\"/>\n");
  };
  file.text(vtk_xml_opening("PUnstructuredGrid"));
  file.text(std::string("<PUnstructuredGrid GhostLevel=\"") + (source.ghosts ? "1" : "0") + "\">\n" +
            vtk_field_data({{"region_names", names_of_tags(source.mesh)}}));
  file.text("<PPoints>\n<PDataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"/>\n</PPoints>\n"
            "<PPointData GlobalIds=\"GlobalNodeIds\">\n");
  array("Int64", "GlobalNodeIds"), array("Int64", "mesh_node"), array("Int32", "owner");
  array("UInt8", "vtkGhostType");
  file.text("</PPointData>\n<PCellData Scalars=\"subdomain\" GlobalIds=\"GlobalCellIds\">\n");
  array("Int64", "GlobalCellIds"), array("Int64", "mesh_element"), array("Int32", "subdomain");
  array("Int32", "region"), array("UInt8", "vtkGhostType");
  file.text("</PCellData>\n");
  for (local_id q = 0; q < source.numbers.ranks(); ++q)
    file.text("<Piece Source=\"" + files_of_rank(q).front() + "\"/>\n");
  file.text("</PUnstructuredGrid>\n</VTKFile>\n");
  file.commit();
}

#ifdef DOVETAIL_COMPILED
template void pvtu_format::write(const rank_source<2>&, const rank_mesh<2>&,
                                 const std::vector<std::filesystem::path>&) const;
template void pvtu_format::write(const rank_source<3>&, const rank_mesh<3>&,
                                 const std::vector<std::filesystem::path>&) const;
template void pvtu_format::write_all(const rank_source<2>&, const std::vector<std::filesystem::path>&) const;
template void pvtu_format::write_all(const rank_source<3>&, const std::vector<std::filesystem::path>&) const;
#endif

} // namespace dovetail::io
