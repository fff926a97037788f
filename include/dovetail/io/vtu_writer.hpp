/// @file
/// VTK output of a distributed mesh: one PVTU with a VTU per piece, and the boundary and the interfaces as
/// VTP files.
#pragma once

#include "dovetail/core/report.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/io/global_numbering.hpp"
#include "dovetail/io/line_output.hpp"
#include "dovetail/io/patches.hpp"
#include "dovetail/io/skeleton_index.hpp"
#include "dovetail/io/vtk_xml_output.hpp"
#include "dovetail/io/vtp_output.hpp"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace dovetail::io {

namespace detail {

/// A range of subdomains that goes into one VTU file, with its points: the skeleton points its subdomains
/// touch, ascending, then the inner points of each subdomain.
struct vtu_group {
  local_id first = 0;
  local_id last = 0; ///< one past the last subdomain
  std::vector<local_id> skeleton_points;
  std::uint64_t points = 0;
  std::uint64_t elements = 0;
};

/// Loads pieces, keeping the latest one.
template <int D>
class piece_stream {
public:
  explicit piece_stream(const distributed_simplicial_mesh<D>& mesh) : mesh_(mesh) {}
  const simplicial_piece<D>& operator()(local_id index) {
    if (piece_.subdomain != index) {
      piece_ = {}; // frees the old piece before the new one is made
      piece_ = load_checked(mesh_, index);
    }
    return piece_;
  }

private:
  const distributed_simplicial_mesh<D>& mesh_;
  simplicial_piece<D> piece_;
};

/// Collects the points of a group. `group_point` is scratch: per skeleton point its place in the group, valid
/// where the group has the point. O(skeleton of the group, log for sorting).
template <int D>
vtu_group collect_group(const distributed_simplicial_mesh<D>& mesh, const sides_by_subdomain<D>& sides,
                        local_id first, local_id last, std::vector<local_id>& group_point) {
  vtu_group group{first, last, {}, 0, 0};
  for (auto s = first; s < last; ++s) {
    for (const auto t : sides[s])
      for (const auto v : sides_of(mesh.skeleton)[static_cast<std::size_t>(t)])
        group.skeleton_points.push_back(v);
    group.points += static_cast<std::uint64_t>(mesh.counts[static_cast<std::size_t>(s)].inner_points);
    group.elements += static_cast<std::uint64_t>(mesh.counts[static_cast<std::size_t>(s)].elements);
  }
  auto& shared = group.skeleton_points;
  sort_unique(shared);
  for (std::size_t i = 0; i < shared.size(); ++i)
    group_point[static_cast<std::size_t>(shared[i])] = static_cast<local_id>(i);
  group.points += shared.size();
  if (group.points > static_cast<std::uint64_t>(std::numeric_limits<local_id>::max()))
    throw io_error("a VTU piece would have more than 2^31 points: ask for more pieces");
  return group;
}

/// Writes points and global ids: pass one over the group.
template <int D>
void append_points(output_file& file, const distributed_simplicial_mesh<D>& mesh,
                   const global_numbering& numbers, const vtu_group& group, piece_stream<D>& pieces) {
  file.value<std::uint64_t>(group.points * sizeof(vec3));
  for (const auto v : group.skeleton_points)
    file.value(mesh.skeleton.points[static_cast<std::size_t>(v)]);
  for (auto s = group.first; s < group.last; ++s) {
    const auto& piece = pieces(s);
    file.array(std::span(piece.mesh.points).subspan(piece.skeleton_points.size()));
  }
  file.value<std::uint64_t>(group.points * sizeof(global_id));
  for (const auto v : group.skeleton_points)
    file.value<global_id>(v);
  for (auto id = numbers.first_point[static_cast<std::size_t>(group.first)];
       id < numbers.first_point[static_cast<std::size_t>(group.last)]; ++id)
    file.value(id);
}

/// Writes the connectivity: pass two over the group.
template <int D>
void append_connectivity(output_file& file, const vtu_group& group, piece_stream<D>& pieces,
                         const std::vector<local_id>& group_point) {
  file.value<std::uint64_t>(group.elements * sizeof(simplex<D>));
  auto inner = static_cast<local_id>(group.skeleton_points.size());
  std::vector<local_id> place; // of each point of the piece in the group
  for (auto s = group.first; s < group.last; ++s) {
    const auto& piece = pieces(s);
    place.resize(piece.mesh.points.size());
    std::size_t i = 0;
    for (const auto v : piece.skeleton_points) {
      const auto at = group_point[static_cast<std::size_t>(v)];
      if (static_cast<std::size_t>(at) >= group.skeleton_points.size() ||
          group.skeleton_points[static_cast<std::size_t>(at)] != v)
        throw mesh_error("subdomain " + std::to_string(s) + " has skeleton point " + std::to_string(v) +
                         ", which is on none of its skeleton sides");
      place[i++] = at;
    }
    for (; i < place.size(); ++i)
      place[i] = inner++;
    for (const auto& element : piece.mesh.elements) {
      simplex<D> placed;
      for (std::size_t k = 0; k < placed.size(); ++k)
        placed[k] = place[static_cast<std::size_t>(element[k])];
      file.value(placed);
    }
  }
}

/// Writes one value per subdomain, repeated for each of its elements.
template <int D, class Function>
void append_per_subdomain(output_file& file, const distributed_simplicial_mesh<D>& mesh,
                          const vtu_group& group, Function of_subdomain) {
  file.value<std::uint64_t>(group.elements * sizeof(local_id));
  for (auto s = group.first; s < group.last; ++s) {
    const local_id value = of_subdomain(s);
    for (global_id e = 0; e < mesh.counts[static_cast<std::size_t>(s)].elements; ++e)
      file.value(value);
  }
}

/// The region of each element: the material of its subdomain, or in D = 2 its CAD face.
template <int D>
void append_regions(output_file& file, const distributed_simplicial_mesh<D>& mesh, const vtu_group& group,
                    piece_stream<D>& pieces) {
  if constexpr (D == 3) {
    append_per_subdomain(file, mesh, group,
                         [&](local_id s) { return mesh.counts[static_cast<std::size_t>(s)].material; });
  } else {
    file.value<std::uint64_t>(group.elements * sizeof(local_id));
    for (auto s = group.first; s < group.last; ++s)
      file.array(std::span(pieces(s).mesh.tags));
  }
}

template <int D>
void write_vtu_group(output_file& file, const distributed_simplicial_mesh<D>& mesh,
                     const global_numbering& numbers, const std::string& field_data, const vtu_group& group,
                     const std::vector<local_id>& group_point) {
  constexpr std::uint64_t corners = D + 1;
  const bool wide =
      group.elements * corners > static_cast<std::uint64_t>(std::numeric_limits<std::int32_t>::max());
  appended_layout layout(file);
  file.text(vtk_xml_opening("UnstructuredGrid"));
  file.text("<UnstructuredGrid>\n" + field_data);
  file.text("<Piece NumberOfPoints=\"" + std::to_string(group.points) + "\" NumberOfCells=\"" +
            std::to_string(group.elements) + "\">\n<Points>\n");
  layout.array<double>("Points", group.points, 3);
  file.text("</Points>\n<PointData GlobalIds=\"GlobalNodeIds\">\n");
  layout.array<global_id>("GlobalNodeIds", group.points);
  file.text("</PointData>\n<Cells>\n");
  layout.array<local_id>("connectivity", corners * group.elements);
  if (wide)
    layout.array<std::int64_t>("offsets", group.elements);
  else
    layout.array<std::int32_t>("offsets", group.elements);
  layout.array<std::uint8_t>("types", group.elements);
  file.text("</Cells>\n<CellData Scalars=\"subdomain\">\n");
  layout.array<local_id>("subdomain", group.elements);
  layout.array<local_id>("region", group.elements);
  file.text("</CellData>\n");
  file.text("</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_");

  piece_stream<D> pieces(mesh);
  append_points(file, mesh, numbers, group, pieces);
  append_connectivity(file, group, pieces, group_point);
  if (wide)
    append_computed<std::int64_t>(file, group.elements,
                                  [](auto i) { return static_cast<std::int64_t>(corners * (i + 1)); });
  else
    append_computed<std::int32_t>(file, group.elements,
                                  [](auto i) { return static_cast<std::int32_t>(corners * (i + 1)); });
  append_computed<std::uint8_t>(file, group.elements, [](auto) { return std::uint8_t{D == 3 ? 10 : 5}; });
  append_per_subdomain(file, mesh, group, [](local_id s) { return s; });
  append_regions(file, mesh, group, pieces);
  file.text("\n</AppendedData>\n</VTKFile>\n");
}

/// The file that names the pieces.
inline void write_pvtu(output_file& file, const std::string& field_data,
                       const std::vector<std::string>& sources) {
  file.text(vtk_xml_opening("PUnstructuredGrid"));
  file.text("<PUnstructuredGrid GhostLevel=\"0\">\n" + field_data);
  file.text("<PPoints>\n<PDataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"/>\n</PPoints>\n"
            "<PPointData GlobalIds=\"GlobalNodeIds\">\n<PDataArray type=\"Int64\" Name=\"GlobalNodeIds\" "
            "NumberOfComponents=\"1\"/>\n</PPointData>\n"
            "<PCellData Scalars=\"subdomain\">\n<PDataArray type=\"Int32\" Name=\"subdomain\" "
            "NumberOfComponents=\"1\"/>\n<PDataArray type=\"Int32\" Name=\"region\" "
            "NumberOfComponents=\"1\"/>\n</PCellData>\n");
  for (const auto& source : sources)
    file.text("<Piece Source=\"" + source + "\"/>\n");
  file.text("</PUnstructuredGrid>\n</VTKFile>\n");
}

/// "<stem>_<number>.vtu" with as many digits as the largest number needs, at least four.
inline std::string vtu_piece_name(const std::string& stem, local_id number, local_id count) {
  const auto width = std::max<std::size_t>(4, std::to_string(count - 1).size());
  auto digits = std::to_string(number);
  return stem + "_" + std::string(width - std::min(width, digits.size()), '0') + digits + ".vtu";
}

/// Removes pieces that an earlier mesh of more pieces left in the folder, so that they are not mistaken for
/// part of this one.
inline void remove_stale_pieces(const std::filesystem::path& folder, const std::string& stem,
                                const std::vector<std::string>& sources) {
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    const auto name = entry.path().filename().string();
    const auto digits =
        name.size() > stem.size() + 5 && name.starts_with(stem + "_") && name.ends_with(".vtu")
            ? name.substr(stem.size() + 1, name.size() - stem.size() - 5)
            : std::string();
    if (!digits.empty() && digits.find_first_not_of("0123456789") == std::string::npos &&
        std::find(sources.begin(), sources.end(), name) == sources.end())
      std::filesystem::remove(entry.path(), ignored);
  }
}

} // namespace detail

/// Names of the regions that elements are in: materials, or in D = 2 CAD faces.
inline std::vector<std::string> region_names(const distributed_simplicial_mesh<3>& mesh) {
  return collect_material_names(mesh);
}
inline std::vector<std::string> region_names(const distributed_simplicial_mesh<2>& mesh) {
  return mesh.face_names;
}

/// Writes `<stem>.pvtu` and its pieces `<stem>_0000.vtu`, ..., `surface.vtp` (the boundary of the domain) and
/// `interfaces.vtp` (faces between subdomains, where there are several);
/// in D = 2 `lines.vtp` instead, the edges of CAD curves and of lines between subdomains. See docs/formats.md
/// for the arrays.
struct vtu_writer {
  int pieces = 0; ///< number of VTU files; 0: one per subdomain, never more than subdomains
  std::string stem = "mesh";

  /// A piece of several subdomains is loaded twice. Memory: the skeleton, twice its size in work arrays, and
  /// one loaded subdomain.
  template <int D>
  report operator()(const distributed_simplicial_mesh<D>& mesh, const std::filesystem::path& folder) const {
    const stopwatch clock;
    make_folder(folder);
    const auto numbers = number_globally(mesh);
    const sides_by_subdomain<D> sides(mesh);
    const auto subdomains = static_cast<local_id>(mesh.counts.size());
    const auto groups = pieces <= 0 ? subdomains : std::min<local_id>(pieces, subdomains);
    const auto field_data = vtk_field_data({{"region_names", region_names(mesh)}});

    output_batch files;
    std::vector<std::string> sources;
    std::vector<local_id> group_point(mesh.skeleton.points.size(), 0);
    for (local_id g = 0; g < groups; ++g) {
      const auto bound = [&](local_id i) {
        return static_cast<local_id>(static_cast<global_id>(i) * subdomains / groups);
      };
      const auto group = detail::collect_group(mesh, sides, bound(g), bound(g + 1), group_point);
      sources.push_back(detail::vtu_piece_name(stem, g, groups));
      detail::write_vtu_group(files.open(folder / sources.back()), mesh, numbers, field_data, group,
                              group_point);
    }
    if constexpr (D == 3) {
      detail::write_skeleton_vtp(files.open(folder / "surface.vtp"), mesh, detail::skeleton_part::boundary);
      if (subdomains > 1)
        detail::write_skeleton_vtp(files.open(folder / "interfaces.vtp"), mesh,
                                   detail::skeleton_part::interfaces);
    } else {
      detail::write_lines_vtp(files.open(folder / "lines.vtp"), mesh);
    }
    detail::write_pvtu(files.open(folder / (stem + ".pvtu")), field_data, sources);
    // Between these lines the folder has no PVTU, rather than one that names pieces of two meshes.
    std::error_code ignored;
    std::filesystem::remove(folder / (stem + ".pvtu"), ignored);
    if (subdomains == 1)
      std::filesystem::remove(folder / "interfaces.vtp", ignored);
    files.commit();
    detail::remove_stale_pieces(folder, stem, sources);

    report summary{"vtu", clock.seconds(), {}, {}, {}};
    summary.set("elements", static_cast<double>(numbers.elements()));
    summary.set("bytes", static_cast<double>(files.size()));
    summary.set("files", static_cast<double>(files.files()));
    return summary;
  }
};

} // namespace dovetail::io
