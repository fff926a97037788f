/// @file
/// Adapter: HDF5 files of a parallel solver, all ranks in one file, written rank by rank.
#pragma once

#include "dovetail/core/output_file.hpp"
#include "dovetail/io/concepts.hpp"
#include "dovetail/io/face_groups.hpp"
#include "dovetail/io/hdf5_file.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace dovetail::io {

/// `<stem>.h5`, plain arrays in the order of ids, and `<stem>.xdmf`, which says what they are. Named as
/// PETSc's `-dm_plex_create_from_hdf5_xdmf` looks for them. One task writes it, with one rank in memory.
/// Ghosts are left out. See docs/formats.md for the arrays.
struct xdmf_format {
  std::string stem = "ranks";

  std::string name() const { return "xdmf"; }
  std::vector<std::string> files_of_rank(local_id) const { return {}; }
  std::vector<std::string> files_of_all() const { return {stem + ".h5", stem + ".xdmf"}; }
  template <int D>
  void write(const rank_source<D>&, const rank_mesh<D>&, const std::vector<std::filesystem::path>&) const {}
  template <int D>
  void write_all(const rank_source<D>& source, const std::vector<std::filesystem::path>& paths) const {
    constexpr std::uint64_t corners = D + 1;
    const auto& numbers = source.numbers;
    const auto vertices = static_cast<std::uint64_t>(numbers.first_vertex.back());
    const auto elements = static_cast<std::uint64_t>(numbers.first_element.back());
    detail::hdf5_file file(paths.front());
    file.create<double>("geometry/vertices", vertices, 3);
    file.create<global_id>("viz/topology/cells", elements, corners);
    file.attribute("viz/topology/cells", "cell_dim", std::vector<std::int64_t>{D});
    file.attribute("viz/topology/cells", "cell_corners", std::vector<std::int64_t>{D + 1});
    file.create<global_id>("vertices/mesh_node", vertices);
    file.create<global_id>("cells/mesh_element", elements);
    file.create<local_id>("cells/region", elements);
    file.create<local_id>("cells/subdomain", elements);
    file.add("ranks/first_vertex", numbers.first_vertex);
    file.add("ranks/first_cell", numbers.first_element);
    file.create_growing<global_id>("sides/vertices", D);
    file.create_growing<local_id>("sides/cad");
    const auto groups = collect_face_groups(source.mesh); // of CAD faces; sides of triangles are on curves
    if constexpr (D == 3) {
      file.create_growing<local_id>("sides/patch");
      file.add("names/patches", groups.names);
    }
    file.add("names/regions", names_of_tags(source.mesh));
    std::vector<global_id> first_side{0};
    for (local_id q = 0; q < numbers.ranks(); ++q) {
      const auto rank = make_rank_mesh<D>(source.mesh, numbers, q);
      const auto first_vertex = static_cast<std::uint64_t>(numbers.first_vertex[static_cast<std::size_t>(q)]);
      const auto first_element =
          static_cast<std::uint64_t>(numbers.first_element[static_cast<std::size_t>(q)]);
      file.write("geometry/vertices", first_vertex, rank.owned_vertices, owned_coordinates(rank).data(), 3);
      file.write("viz/topology/cells", first_element, rank.owned_elements, cells_by_ids(rank).data(),
                 corners);
      file.write("vertices/mesh_node", first_vertex, rank.owned_vertices, rank.vertex_numbers.data());
      file.write("cells/mesh_element", first_element, rank.element_numbers);
      file.write("cells/region", first_element, rank.mesh.tags);
      file.write("cells/subdomain", first_element, rank.subdomains);
      file.append("sides/vertices", sides_by_ids(rank), D);
      file.append("sides/cad", rank.side_hosts);
      if constexpr (D == 3) {
        std::vector<local_id> patches;
        for (const local_id face : rank.side_hosts)
          patches.push_back(groups.of_face[static_cast<std::size_t>(face)]);
        file.append("sides/patch", patches);
      }
      first_side.push_back(first_side.back() + static_cast<global_id>(rank.sides.size()));
    }
    file.add("ranks/first_side", first_side);
    file.close();
    write_xdmf(paths.back(), D == 3 ? "Tetrahedron" : "Triangle", vertices, elements, corners);
  }

private:
  void write_xdmf(const std::filesystem::path& path, const std::string& kind, std::uint64_t vertices,
                  std::uint64_t elements, std::uint64_t corners) const {
    const auto item = [&](const std::string& extent, const std::string& type, const std::string& bytes,
                          const std::string& where) {
      return "<DataItem Dimensions=\"" + extent + "\" NumberType=\"" + type + "\" Precision=\"" + bytes +
             "\" Format=\"HDF\">" + stem + ".h5:/" + where + "</DataItem>\n";
    };
    const auto n = std::to_string(vertices), m = std::to_string(elements);
    std::string text = "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n<Domain>\n<Grid Name=\"mesh\">\n"
                       "<Topology TopologyType=\"" +
                       kind + "\" NumberOfElements=\"" + m + "\">\n" +
                       item(m + " " + std::to_string(corners), "Int", "8", "viz/topology/cells") +
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
static_assert(rank_format<xdmf_format, 2> && rank_format<xdmf_format, 3>);

/// `<stem>.vtkhdf`: VTK's HDF format, version [1, 0], a partition per rank with the arrays of `pvtu_format`.
/// One task writes it, with one rank in memory.
struct vtkhdf_format {
  std::string stem = "ranks";

  std::string name() const { return "vtkhdf"; }
  std::vector<std::string> files_of_rank(local_id) const { return {}; }
  std::vector<std::string> files_of_all() const { return {stem + ".vtkhdf"}; }
  template <int D>
  void write(const rank_source<D>&, const rank_mesh<D>&, const std::vector<std::filesystem::path>&) const {}
  template <int D>
  void write_all(const rank_source<D>& source, const std::vector<std::filesystem::path>& paths) const {
    // How much each rank has is known when its mesh is, so each is made twice rather than all held.
    std::vector<std::int64_t> points, cells, corners;
    std::uint64_t all_points = 0, all_cells = 0;
    const local_id ranks = source.numbers.ranks();
    for (local_id q = 0; q < ranks; ++q) {
      const auto rank = source.mesh_of(q);
      points.push_back(static_cast<std::int64_t>(rank.mesh.points.size()));
      cells.push_back(static_cast<std::int64_t>(rank.mesh.elements.size()));
      corners.push_back((D + 1) * cells.back());
      all_points += rank.mesh.points.size();
      all_cells += rank.mesh.elements.size();
    }
    detail::hdf5_file file(paths.front());
    const std::string root = "VTKHDF/", of_points = root + "PointData/", of_cells = root + "CellData/";
    file.add(root + "NumberOfPoints", points);
    file.add(root + "NumberOfCells", cells);
    file.add(root + "NumberOfConnectivityIds", corners);
    file.attribute("VTKHDF", "Version", std::vector<std::int64_t>{1, 0});
    file.attribute("VTKHDF", "Type", std::string("UnstructuredGrid"));
    file.create<double>(root + "Points", all_points, 3);
    file.create<std::uint8_t>(root + "Types", all_cells);
    file.create<std::int64_t>(root + "Connectivity", (D + 1) * all_cells);
    file.create<std::int64_t>(root + "Offsets", all_cells + static_cast<std::uint64_t>(ranks));
    for (const char* name : {"GlobalNodeIds", "mesh_node"})
      file.create<global_id>(of_points + name, all_points);
    file.create<local_id>(of_points + "owner", all_points);
    file.create<std::uint8_t>(of_points + "vtkGhostType", all_points);
    for (const char* name : {"GlobalCellIds", "mesh_element"})
      file.create<global_id>(of_cells + name, all_cells);
    for (const char* name : {"subdomain", "region"})
      file.create<local_id>(of_cells + name, all_cells);
    file.create<std::uint8_t>(of_cells + "vtkGhostType", all_cells);
    std::uint64_t point = 0, cell = 0;
    for (local_id q = 0; q < ranks; ++q) {
      const auto rank = source.mesh_of(q);
      const auto is_of_another = [q](const std::vector<local_id>& owners) {
        std::vector<std::uint8_t> ghost;
        for (const local_id owner : owners)
          ghost.push_back(owner != q);
        return ghost;
      };
      std::vector<std::int64_t> connectivity, offsets{0};
      for (const auto& element : rank.mesh.elements) {
        for (const local_id v : element)
          connectivity.push_back(v);
        offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
      }
      const std::vector<std::uint8_t> types(rank.mesh.elements.size(), D == 3 ? 10 : 5);
      file.write(root + "Points", point, rank.mesh.points.size(),
                 reinterpret_cast<const double*>(rank.mesh.points.data()), 3);
      file.write(of_points + "GlobalNodeIds", point, rank.vertex_ids);
      file.write(of_points + "mesh_node", point, rank.vertex_numbers);
      file.write(of_points + "owner", point, rank.vertex_owners);
      file.write(of_points + "vtkGhostType", point, is_of_another(rank.vertex_owners));
      file.write(root + "Types", cell, types);
      file.write(root + "Connectivity", (D + 1) * cell, connectivity);
      file.write(root + "Offsets", cell + static_cast<std::uint64_t>(q), offsets);
      file.write(of_cells + "GlobalCellIds", cell, rank.element_ids);
      file.write(of_cells + "mesh_element", cell, rank.element_numbers);
      file.write(of_cells + "subdomain", cell, rank.subdomains);
      file.write(of_cells + "region", cell, rank.mesh.tags);
      file.write(of_cells + "vtkGhostType", cell, is_of_another(rank.element_owners));
      point += rank.mesh.points.size();
      cell += rank.mesh.elements.size();
    }
    file.close();
  }
};
static_assert(rank_format<vtkhdf_format, 2> && rank_format<vtkhdf_format, 3>);

} // namespace dovetail::io
