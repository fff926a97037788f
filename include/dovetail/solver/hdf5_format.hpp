/// @file
/// Adapter: HDF5 files of a parallel solver, all ranks in one file, into which each writes its share.
#pragma once

#include "dovetail/core/output_file.hpp"
#include "dovetail/files/face_groups.hpp"
#include "dovetail/files/hdf5_file.hpp"
#include "dovetail/files/hdf5_slices.hpp"
#include "dovetail/files/vtk_xml_output.hpp"
#include "dovetail/files/xdmf_index.hpp"
#include "dovetail/mesh/global_numbering.hpp"
#include "dovetail/mesh/mid_nodes.hpp"
#include "dovetail/solver/concepts.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <numeric>
#include <string>
#include <vector>

namespace dovetail::io {

/// `<stem>.h5`, plain arrays in the order of ids, and `<stem>.xdmf`, which says what they are. Named as
/// PETSc's `-dm_plex_create_from_hdf5_xdmf` looks for them, which takes no second order; XDMF's order of
/// nodes is VTK's. Ghosts are left out. See docs/formats.md for the arrays.
struct xdmf_format {
  static constexpr bool second_order = true; ///< it has nodes in the middle of edges where the mesh has
  std::string stem = "ranks";                ///< what the names of the files begin with

  std::string name() const { return "xdmf"; }
  std::vector<std::string> files_of_all() const { return {stem + ".h5", stem + ".xdmf"}; }
  template <int D>
  void lay_out(const rank_source<D>& source, const std::vector<rank_counts>& counts,
               const std::vector<std::filesystem::path>& paths) const {
    const std::uint64_t nodes = nodes_per_element(source.mesh);
    const auto& numbers = source.numbers;
    const auto vertices = static_cast<std::uint64_t>(numbers.first_vertex.back());
    const auto elements = static_cast<std::uint64_t>(numbers.first_element.back());
    std::vector<global_id> first_side{0};
    for (const rank_counts& rank : counts)
      first_side.push_back(first_side.back() + static_cast<global_id>(rank.sides));
    const auto sides = static_cast<std::uint64_t>(first_side.back());
    detail::hdf5_file file(paths.front());
    file.create_in_place<double>("geometry/vertices", vertices, 3);
    file.create_in_place<global_id>("viz/topology/cells", elements, nodes);
    file.attribute("viz/topology/cells", "cell_dim", std::vector<std::int64_t>{D});
    file.attribute("viz/topology/cells", "cell_corners", std::vector{static_cast<std::int64_t>(nodes)});
    file.create_in_place<global_id>("vertices/mesh_node", vertices);
    file.create_in_place<global_id>("cells/mesh_element", elements);
    file.create_in_place<local_id>("cells/region", elements);
    file.create_in_place<local_id>("cells/subdomain", elements);
    file.add("ranks/first_vertex", numbers.first_vertex);
    file.add("ranks/first_cell", numbers.first_element);
    file.add("ranks/first_side", first_side);
    file.create_in_place<global_id>("sides/vertices", sides, D);
    file.create_in_place<local_id>("sides/cad", sides);
    if constexpr (D == 3) { // sides of triangles are on curves, which have no groups
      file.create_in_place<local_id>("sides/patch", sides);
      file.add("names/patches", collect_face_groups(source.mesh).names);
      file.add("names/faces", source.mesh.face_names);
    }
    file.add("pieces/first_element", number_nodes(source.mesh).first_element);
    file.add("names/regions", names_of_tags(source.mesh));
    file.close();
    write_xdmf(paths.back(), detail::xdmf_topology<D>(source.mesh.mid_nodes != nullptr), vertices, elements,
               nodes);
  }
  template <int D>
  void write(const rank_source<D>& source, const rank_mesh<D>& rank,
             const std::vector<std::filesystem::path>& paths) const {
    const auto q = static_cast<std::size_t>(rank.rank);
    const auto first_vertex = static_cast<std::uint64_t>(source.numbers.first_vertex[q]);
    const auto first_element = static_cast<std::uint64_t>(source.numbers.first_element[q]);
    detail::hdf5_slices file(paths.front());
    file.write("geometry/vertices", first_vertex, owned_coordinates(rank), 3);
    file.write("viz/topology/cells", first_element, cells_by_ids(rank), nodes_per_element(rank));
    file.write("vertices/mesh_node", first_vertex, rank.owned_vertices, rank.vertex_numbers.data());
    file.write("cells/mesh_element", first_element, rank.owned_elements, rank.element_numbers.data());
    file.write("cells/region", first_element, rank.owned_elements, rank.mesh.tags.data());
    file.write("cells/subdomain", first_element, rank.owned_elements, rank.subdomains.data());
    const auto first_side = static_cast<std::uint64_t>(file.read<global_id>("ranks/first_side")[q]);
    file.write("sides/vertices", first_side, sides_by_ids(rank), D);
    file.write("sides/cad", first_side, rank.side_hosts);
    if constexpr (D == 3) {
      const auto groups = collect_face_groups(source.mesh).of_face;
      std::vector<local_id> patches;
      for (const local_id face : rank.side_hosts)
        patches.push_back(groups[face]);
      file.write("sides/patch", first_side, patches);
    }
    file.close();
  }

private:
  void write_xdmf(const std::filesystem::path& path, const std::string& kind, std::uint64_t vertices,
                  std::uint64_t elements, std::uint64_t nodes) const {
    const auto item = [&](const std::string& extent, const std::string& type, const std::string& bytes,
                          const std::string& where) {
      return "<DataItem Dimensions=\"" + extent + "\" NumberType=\"" + type + "\" Precision=\"" + bytes +
             "\" Format=\"HDF\">" + stem + ".h5:/" + where + "</DataItem>\n";
    };
    const auto n = std::to_string(vertices), m = std::to_string(elements);
    std::string text = "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n<Domain>\n<Grid Name=\"mesh\">\n"
                       "<Topology TopologyType=\"" +
                       kind + "\" NumberOfElements=\"" + m + "\">\n" +
                       item(m + " " + std::to_string(nodes), "Int", "8", "viz/topology/cells") +
                       "</Topology>\n<Geometry GeometryType=\"XYZ\">\n" +
                       item(n + " 3", "Float", "8", "geometry/vertices") + "</Geometry>\n";
    for (const char* array : {"region", "subdomain"})
      text += std::string("<Attribute Name=\"") + array + "\" Center=\"Cell\">\n" +
              item(m, "Int", "4", std::string("cells/") + array) + "</Attribute>\n";
    output_file file(path);
    file.text(text + "</Grid>\n</Domain>\n</Xdmf>\n");
    file.commit();
  }
};
static_assert(shared_rank_format<xdmf_format, 2> && shared_rank_format<xdmf_format, 3>);

/// `<stem>.vtkhdf`: VTK's HDF format, version [1, 0], a partition per rank with the arrays of `pvtu_format`.
/// Elements of second order are those of VTK.
struct vtkhdf_format {
  static constexpr bool second_order = true; ///< it has nodes in the middle of edges where the mesh has
  std::string stem = "ranks";                ///< what the name of the file begins with

  std::string name() const { return "vtkhdf"; }
  std::vector<std::string> files_of_all() const { return {stem + ".vtkhdf"}; }
  template <int D>
  void lay_out(const rank_source<D>& source, const std::vector<rank_counts>& counts,
               const std::vector<std::filesystem::path>& paths) const {
    const std::uint64_t nodes = nodes_per_element(source.mesh);
    std::vector<std::int64_t> points, cells, connected;
    std::uint64_t all_points = 0, all_cells = 0;
    for (const rank_counts& rank : counts) {
      points.push_back(static_cast<std::int64_t>(rank.vertices));
      cells.push_back(static_cast<std::int64_t>(rank.elements));
      connected.push_back(static_cast<std::int64_t>(nodes * rank.elements));
      all_points += rank.vertices;
      all_cells += rank.elements;
    }
    detail::hdf5_file file(paths.front());
    file.add("VTKHDF/NumberOfPoints", points);
    file.add("VTKHDF/NumberOfCells", cells);
    file.add("VTKHDF/NumberOfConnectivityIds", connected);
    file.attribute("VTKHDF", "Version", std::vector<std::int64_t>{1, 0});
    file.attribute("VTKHDF", "Type", std::string("UnstructuredGrid"));
    file.create_in_place<double>("VTKHDF/Points", all_points, 3);
    file.create_constant<std::uint8_t>("VTKHDF/Types", all_cells,
                                       vtk_cell_type(D, source.mesh.mid_nodes != nullptr));
    file.create_in_place<std::int64_t>("VTKHDF/Connectivity", nodes * all_cells);
    file.create_in_place<std::int64_t>("VTKHDF/Offsets", all_cells + counts.size());
    for (const char* name : {"GlobalNodeIds", "mesh_node"})
      file.create_in_place<global_id>(of_points(name), all_points);
    file.create_in_place<local_id>(of_points("owner"), all_points);
    file.create_in_place<std::uint8_t>(of_points("vtkGhostType"), all_points);
    for (const char* name : {"GlobalCellIds", "mesh_element"})
      file.create_in_place<global_id>(of_cells(name), all_cells);
    for (const char* name : {"subdomain", "region"})
      file.create_in_place<local_id>(of_cells(name), all_cells);
    file.create_in_place<std::uint8_t>(of_cells("vtkGhostType"), all_cells);
    file.close();
  }
  template <int D>
  void write(const rank_source<D>&, const rank_mesh<D>& rank,
             const std::vector<std::filesystem::path>& paths) const {
    detail::hdf5_slices file(paths.front());
    const auto before = [&](const char* counts) {
      const auto of_ranks = file.read<std::int64_t>(std::string("VTKHDF/") + counts);
      return static_cast<std::uint64_t>(
          std::accumulate(of_ranks.begin(), of_ranks.begin() + rank.rank, std::int64_t{0}));
    };
    const std::uint64_t point = before("NumberOfPoints"), cell = before("NumberOfCells");
    const auto is_of_another = [&](const std::vector<local_id>& owners) {
      std::vector<std::uint8_t> ghost;
      for (const local_id owner : owners)
        ghost.push_back(owner != rank.rank);
      return ghost;
    };
    std::vector<std::int64_t> connectivity, offsets{0};
    for (std::size_t e = 0; e < rank.mesh.elements.size(); ++e) {
      for_each_node(rank, e, [&](local_id v) { connectivity.push_back(v); });
      offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
    }
    file.write("VTKHDF/Points", point, rank.mesh.points.size(),
               reinterpret_cast<const double*>(rank.mesh.points.data()), 3);
    file.write(of_points("GlobalNodeIds"), point, rank.vertex_ids);
    file.write(of_points("mesh_node"), point, rank.vertex_numbers);
    file.write(of_points("owner"), point, rank.vertex_owners);
    file.write(of_points("vtkGhostType"), point, is_of_another(rank.vertex_owners));
    file.write("VTKHDF/Connectivity", nodes_per_element(rank) * cell, connectivity);
    file.write("VTKHDF/Offsets", cell + static_cast<std::uint64_t>(rank.rank), offsets);
    file.write(of_cells("GlobalCellIds"), cell, rank.element_ids);
    file.write(of_cells("mesh_element"), cell, rank.element_numbers);
    file.write(of_cells("subdomain"), cell, rank.subdomains);
    file.write(of_cells("region"), cell, rank.mesh.tags);
    file.write(of_cells("vtkGhostType"), cell, is_of_another(rank.element_owners));
    file.close();
  }

private:
  static std::string of_points(const std::string& name) { return "VTKHDF/PointData/" + name; }
  static std::string of_cells(const std::string& name) { return "VTKHDF/CellData/" + name; }
};
static_assert(shared_rank_format<vtkhdf_format, 2> && shared_rank_format<vtkhdf_format, 3>);

} // namespace dovetail::io
