/// @file
/// Adapter: HDF5 files of a parallel solver, all ranks in one file, written rank by rank.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/output_file.hpp"
#include "dovetail/io/concepts.hpp"
#include "dovetail/io/face_groups.hpp"

#include <hdf5.h>

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <fcntl.h>
#include <filesystem>
#include <string>
#include <unistd.h>
#include <vector>

namespace dovetail::io {

namespace detail {

template <class T>
hid_t hdf5_type() {
  if constexpr (std::same_as<T, double>)
    return H5T_NATIVE_DOUBLE;
  else if constexpr (std::same_as<T, std::int64_t>)
    return H5T_NATIVE_INT64;
  else if constexpr (std::same_as<T, std::int32_t>)
    return H5T_NATIVE_INT32;
  else
    return H5T_NATIVE_UINT8;
}

/// An HDF5 file in the making. Datasets have their full sizes from the beginning and are filled in turns.
/// Throws `io_error` naming the file when HDF5 fails, which prints nothing meanwhile.
class hdf5_file {
public:
  explicit hdf5_file(const std::filesystem::path& path) : path_(path) {
    H5Eget_auto2(H5E_DEFAULT, &print_, &print_data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    file_ = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    if (file_ < 0) {
      H5Eset_auto2(H5E_DEFAULT, print_, print_data_);
      fail("create");
    }
  }
  hdf5_file(const hdf5_file&) = delete;
  hdf5_file& operator=(const hdf5_file&) = delete;
  ~hdf5_file() {
    if (file_ >= 0)
      H5Fclose(file_);
    H5Eset_auto2(H5E_DEFAULT, print_, print_data_);
  }

  /// A dataset of `rows` rows of `columns` values (1: of one dimension), and the groups around it.
  template <class T>
  void create(const std::string& name, std::uint64_t rows, std::uint64_t columns = 1) {
    const std::array<hsize_t, 2> extent{rows, columns};
    const handle space(H5Screate_simple(columns == 1 ? 1 : 2, extent.data(), nullptr), H5Sclose, *this);
    create(name, hdf5_type<T>(), space.id, H5P_DEFAULT);
  }
  /// One without rows, for `append`.
  template <class T>
  void create_growing(const std::string& name, std::uint64_t columns = 1) {
    const int rank = columns == 1 ? 1 : 2;
    const std::array<hsize_t, 2> none{0, columns}, most{H5S_UNLIMITED, columns}, chunk{4096, columns};
    const handle space(H5Screate_simple(rank, none.data(), most.data()), H5Sclose, *this);
    const handle layout(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, *this);
    require(H5Pset_chunk(layout.id, rank, chunk.data()));
    create(name, hdf5_type<T>(), space.id, layout.id);
  }
  /// Writes rows from `first` on.
  template <class T>
  void write(const std::string& name, std::uint64_t first, std::uint64_t rows, const T* values,
             std::uint64_t columns = 1) {
    if (rows == 0)
      return;
    const std::array<hsize_t, 2> start{first, 0}, extent{rows, columns};
    const int rank = columns == 1 ? 1 : 2;
    const handle set(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose, *this);
    const handle there(H5Dget_space(set.id), H5Sclose, *this);
    const handle here(H5Screate_simple(rank, extent.data(), nullptr), H5Sclose, *this);
    require(H5Sselect_hyperslab(there.id, H5S_SELECT_SET, start.data(), nullptr, extent.data(), nullptr));
    require(H5Dwrite(set.id, hdf5_type<T>(), here.id, there.id, H5P_DEFAULT, values));
  }
  template <class T>
  void write(const std::string& name, std::uint64_t first, const std::vector<T>& values) {
    write(name, first, values.size(), values.data());
  }
  /// Writes behind the last row of a growing dataset.
  template <class T>
  void append(const std::string& name, const std::vector<T>& values, std::uint64_t columns = 1) {
    std::array<hsize_t, 2> extent{0, columns};
    const std::uint64_t rows = values.size() / columns;
    {
      const handle set(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose, *this);
      const handle there(H5Dget_space(set.id), H5Sclose, *this);
      require(H5Sget_simple_extent_dims(there.id, extent.data(), nullptr));
      extent[0] += rows;
      require(H5Dset_extent(set.id, extent.data()));
    }
    write(name, extent[0] - rows, rows, values.data(), columns);
  }
  /// A whole dataset at once.
  template <class T>
  void add(const std::string& name, const std::vector<T>& values) {
    create<T>(name, values.size());
    write(name, 0, values);
  }
  /// A dataset of texts.
  void add(const std::string& name, const std::vector<std::string>& texts) {
    const hsize_t extent = texts.size();
    const handle space(H5Screate_simple(1, &extent, nullptr), H5Sclose, *this);
    const handle type(H5Tcopy(H5T_C_S1), H5Tclose, *this);
    require(H5Tset_size(type.id, H5T_VARIABLE));
    require(H5Tset_cset(type.id, H5T_CSET_UTF8));
    create(name, type.id, space.id, H5P_DEFAULT);
    std::vector<const char*> begins;
    for (const auto& text : texts)
      begins.push_back(text.c_str());
    const handle set(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose, *this);
    if (!begins.empty())
      require(H5Dwrite(set.id, type.id, H5S_ALL, H5S_ALL, H5P_DEFAULT, begins.data()));
  }
  /// An attribute of a group or dataset: whole numbers, or a text.
  void attribute(const std::string& of, const std::string& name, const std::vector<std::int64_t>& values) {
    const std::array<hsize_t, 1> extent{values.size()};
    const handle space(H5Screate_simple(1, extent.data(), nullptr), H5Sclose, *this);
    add_attribute(of, name, H5T_NATIVE_INT64, space.id, values.data());
  }
  void attribute(const std::string& of, const std::string& name, const std::string& text) {
    const handle space(H5Screate(H5S_SCALAR), H5Sclose, *this);
    const handle type(H5Tcopy(H5T_C_S1), H5Tclose, *this);
    require(H5Tset_size(type.id, text.size()));
    require(H5Tset_strpad(type.id, H5T_STR_NULLPAD));
    add_attribute(of, name, type.id, space.id, text.data());
  }

  /// To the disk.
  void close() {
    const hid_t file = file_;
    file_ = -1;
    require(H5Fclose(file));
    const int descriptor = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC);
    const bool is_there = descriptor >= 0 && ::fsync(descriptor) == 0;
    if (descriptor >= 0)
      ::close(descriptor);
    if (!is_there)
      fail("write");
  }

private:
  struct handle {
    handle(hid_t made, herr_t (*with)(hid_t), const hdf5_file& of) : id(made), close(with) {
      of.require(made);
    }
    handle(const handle&) = delete;
    handle& operator=(const handle&) = delete;
    ~handle() { close(id); }
    hid_t id;
    herr_t (*close)(hid_t);
  };

  void create(const std::string& name, hid_t type, hid_t space, hid_t layout) {
    const handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose, *this);
    require(H5Pset_create_intermediate_group(links.id, 1));
    const handle made(H5Dcreate2(file_, name.c_str(), type, space, links.id, layout, H5P_DEFAULT), H5Dclose,
                      *this);
  }
  void add_attribute(const std::string& of, const std::string& name, hid_t type, hid_t space,
                     const void* values) {
    const handle made(H5Acreate_by_name(file_, of.c_str(), name.c_str(), type, space, H5P_DEFAULT,
                                        H5P_DEFAULT, H5P_DEFAULT),
                      H5Aclose, *this);
    require(H5Awrite(made.id, type, values));
  }
  void require(std::int64_t status) const {
    if (status < 0)
      fail("write");
  }
  [[noreturn]] void fail(const char* what) const {
    throw io_error(std::string("cannot ") + what + " " + path_.string() + ": HDF5 reports a failure");
  }

  std::filesystem::path path_;
  hid_t file_ = -1;
  H5E_auto2_t print_ = nullptr; ///< whatever printed HDF5's errors before
  void* print_data_ = nullptr;
};

} // namespace detail

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
