/// @file
/// What `vtu_writer.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/files/face_groups.hpp"
#include "dovetail/files/numbered_files.hpp"
#include "dovetail/files/piecewise_output.hpp"
#include "dovetail/files/skeleton_nodes.hpp"
#include "dovetail/files/vtk_xml_output.hpp"
#include "dovetail/files/vtp_output.hpp"
#include "dovetail/files/vtu_writer.hpp"
#include "dovetail/mesh/global_numbering.hpp"
#include "dovetail/mesh/skeleton_index.hpp"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace dovetail::io {

namespace detail {

/// The VTU file of a range of subdomains. Its points are the skeleton's nodes its subdomains touch,
/// ascending, then the inner nodes of each subdomain. What follows from counts and skeleton is written at
/// once; each piece then adds its points and its elements.
template <int D>
class vtu_file {
public:
  vtu_file(const std::filesystem::path& path, const distributed_simplicial_mesh<D>& mesh,
           const global_numbering& numbers, const sides_by_subdomain<D>& sides, const std::string& field_data,
           local_id first, local_id last)
      : mesh_(mesh), corners_(nodes_per_element(mesh)), next_(first), last_(last), file_(path) {
    for (auto s = first; s < last; ++s)
      for (const auto t : sides[s])
        for_each_node(mesh, mesh.skeleton.sides[t], [&](local_id node) { shared_.push_back(node); });
    sort_unique(shared_);
    const auto from = static_cast<std::size_t>(first);
    const auto to = static_cast<std::size_t>(last);
    const auto first_id = numbers.first_point[from];
    const auto inner = static_cast<std::uint64_t>(numbers.first_point[to] - first_id);
    points_ = shared_.size() + inner;
    elements_ = static_cast<std::uint64_t>(numbers.first_element[to] - numbers.first_element[from]);
    if (points_ > static_cast<std::uint64_t>(std::numeric_limits<local_id>::max()))
      throw io_error("a VTU file would have more than 2^31 points: ask for more files");
    inner_ = static_cast<local_id>(shared_.size());
    write_head(field_data);
    write_point_arrays(first_id, inner);
    write_cell_arrays(first);
  }

  /// Pieces come in their order.
  void add(const simplicial_piece<D>& piece) {
    if (piece.subdomain != next_ || next_ == last_)
      throw mesh_error("subdomain " + std::to_string(piece.subdomain) + " is not the next of its VTU file");
    ++next_;
    const piece_nodes<D> nodes(mesh_, piece);
    const auto places = places_of(nodes, piece.subdomain);
    file_.seek(points_at_);
    file_.array(nodes.own());
    points_at_ += nodes.own().size_bytes();
    file_.seek(connectivity_at_);
    for (std::size_t e = 0; e < piece.mesh.elements.size(); ++e)
      for (const local_id v : nodes.of_element(e))
        file_.value(places[v]);
    connectivity_at_ += piece.mesh.elements.size() * corners_ * sizeof(local_id);
    if constexpr (D == 2) {
      file_.seek(tags_at_);
      file_.array(span_of(piece.mesh.tags));
      tags_at_ += piece.mesh.tags.size() * sizeof(local_id);
    }
  }

  std::uint64_t close() {
    file_.commit();
    return file_.size();
  }

private:
  void write_head(const std::string& field_data) {
    appended_layout layout(file_);
    file_.text(vtk_xml_opening("UnstructuredGrid"));
    file_.text("<UnstructuredGrid>\n" + field_data);
    file_.text("<Piece NumberOfPoints=\"" + std::to_string(points_) + "\" NumberOfCells=\"" +
               std::to_string(elements_) + "\">\n<Points>\n");
    points_at_ = layout.array<double>("Points", points_, 3);
    file_.text("</Points>\n<PointData GlobalIds=\"GlobalNodeIds\">\n");
    ids_at_ = layout.array<global_id>("GlobalNodeIds", points_);
    file_.text("</PointData>\n<Cells>\n");
    connectivity_at_ = layout.array<local_id>("connectivity", corners_ * elements_);
    if (wide())
      offsets_at_ = layout.array<std::int64_t>("offsets", elements_);
    else
      offsets_at_ = layout.array<std::int32_t>("offsets", elements_);
    layout.array<std::uint8_t>("types", elements_);
    file_.text("</Cells>\n<CellData Scalars=\"subdomain\">\n");
    layout.array<local_id>("subdomain", elements_);
    tags_at_ = layout.array<local_id>("region", elements_);
    file_.text("</CellData>\n");
    file_.text("</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_");
    for (auto* at : {&points_at_, &ids_at_, &connectivity_at_, &offsets_at_, &tags_at_})
      *at += file_.size();
  }

  /// The skeleton points and all global ids; the inner points come with the pieces.
  void write_point_arrays(global_id first_id, std::uint64_t inner) {
    file_.value<std::uint64_t>(points_ * sizeof(vec3));
    for (const auto v : shared_)
      file_.value(skeleton_node(mesh_, v));
    points_at_ += shared_.size() * sizeof(vec3);
    file_.seek(ids_at_ - sizeof(std::uint64_t));
    file_.value<std::uint64_t>(points_ * sizeof(global_id));
    for (const auto v : shared_)
      file_.value<global_id>(v);
    for (std::uint64_t i = 0; i < inner; ++i)
      file_.value(first_id + static_cast<global_id>(i));
  }

  /// All cell arrays but the connectivity, and in D = 2 the tags.
  void write_cell_arrays(local_id first) {
    file_.value<std::uint64_t>(elements_ * corners_ * sizeof(local_id));
    file_.seek(offsets_at_ - sizeof(std::uint64_t));
    if (wide())
      append_computed<std::int64_t>(file_, elements_,
                                    [this](auto i) { return static_cast<std::int64_t>(corners_ * (i + 1)); });
    else
      append_computed<std::int32_t>(file_, elements_,
                                    [this](auto i) { return static_cast<std::int32_t>(corners_ * (i + 1)); });
    append_computed<std::uint8_t>(file_, elements_,
                                  [this](auto) { return vtk_cell_type(D, mesh_.mid_nodes != nullptr); });
    append_per_subdomain(first, [](local_id s) { return s; });
    if constexpr (D == 3) {
      append_per_subdomain(first, [&](local_id s) { return mesh_.counts[s].material; });
    } else {
      file_.value<std::uint64_t>(elements_ * sizeof(local_id));
      file_.seek(tags_at_ + elements_ * sizeof(local_id));
    }
    file_.text("\n</AppendedData>\n</VTKFile>\n");
  }

  /// One value per subdomain, repeated for each of its elements.
  template <class Function>
  void append_per_subdomain(local_id first, Function of_subdomain) {
    file_.value<std::uint64_t>(elements_ * sizeof(local_id));
    for (auto s = first; s < last_; ++s) {
      const local_id value = of_subdomain(s);
      for (global_id e = 0; e < mesh_.counts[s].elements; ++e)
        file_.value(value);
    }
  }

  /// Of each node of a piece: its number in the file.
  std::vector<local_id> places_of(const piece_nodes<D>& nodes, local_id subdomain) {
    std::vector<local_id> places;
    places.reserve(nodes.shared().size() + nodes.own().size());
    for (const auto v : nodes.shared()) {
      const auto at = std::lower_bound(shared_.begin(), shared_.end(), v);
      if (at == shared_.end() || *at != v)
        throw mesh_error("subdomain " + std::to_string(subdomain) + " has skeleton point " +
                         std::to_string(v) + ", which is on none of its skeleton sides");
      places.push_back(static_cast<local_id>(at - shared_.begin()));
    }
    for (std::size_t i = 0; i < nodes.own().size(); ++i)
      places.push_back(inner_++);
    return places;
  }

  /// Whether offsets need 64 bits.
  bool wide() const {
    return elements_ * corners_ > static_cast<std::uint64_t>(std::numeric_limits<std::int32_t>::max());
  }

  const distributed_simplicial_mesh<D>& mesh_;
  const std::uint64_t corners_; ///< nodes per element
  local_id next_;
  local_id last_; ///< one past the last subdomain
  output_file file_;
  std::vector<local_id> shared_; ///< the skeleton's nodes, ascending
  std::uint64_t points_ = 0;
  std::uint64_t elements_ = 0;
  local_id inner_ = 0;          ///< number of the next inner point
  std::uint64_t points_at_ = 0; ///< where the next values of an array go
  std::uint64_t ids_at_ = 0;
  std::uint64_t connectivity_at_ = 0;
  std::uint64_t offsets_at_ = 0;
  std::uint64_t tags_at_ = 0;
};

/// The file that names the others.
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

} // namespace detail

template <int D>
piecewise_output<D> vtu_writer::begin(const distributed_simplicial_mesh<D>& mesh,
                                      const std::filesystem::path& unfinished) const {
  struct tables {
    global_numbering numbers;
    sides_by_subdomain<D> sides;
    std::string field_data;
  };
  const auto shared =
      std::make_shared<const tables>(tables{number_nodes(mesh), sides_by_subdomain<D>(mesh),
                                            vtk_field_data({{"region_names", names_of_tags(mesh)}})});
  const auto subdomains = static_cast<local_id>(mesh.counts.size());
  piecewise_output<D> output;
  output.bounds = bounds_of_files(files, subdomains);
  output.names = numbered_names(stem, output.bounds.size() - 1, ".vtu");
  output.open = [&mesh, unfinished, shared, bounds = output.bounds, names = output.names](std::size_t f) {
    const auto file =
        std::make_shared<detail::vtu_file<D>>(unfinished / names[f], mesh, shared->numbers, shared->sides,
                                              shared->field_data, bounds[f], bounds[f + 1]);
    return piece_file<D>{[file](const simplicial_piece<D>& piece) { file->add(piece); },
                         [file] { return file->close(); }};
  };
  std::vector<std::string> skeleton_files;
  const auto add_skeleton = [&](const std::string& name, detail::skeleton_part part) {
    skeleton_files.push_back(name);
    output.others.push_back({name, [path = unfinished / name, part, &mesh] {
                               output_file file(path);
                               detail::write_skeleton_vtp(file, mesh, part);
                               file.commit();
                             }});
  };
  if (D == 2)
    add_skeleton("lines.vtp", detail::skeleton_part::all);
  else
    add_skeleton("surface.vtp", detail::skeleton_part::boundary);
  if (D == 3 && subdomains > 1)
    add_skeleton("interfaces.vtp", detail::skeleton_part::interfaces);
  output.complete = [unfinished, shared, stem = stem, sources = output.names] {
    output_file index(unfinished / (stem + ".pvtu"));
    detail::write_pvtu(index, shared->field_data, sources);
    index.commit();
  };
  output.finish = [&mesh, unfinished, shared, stem = stem, sources = output.names,
                   skeleton_files](const std::filesystem::path& folder) {
    // Between these lines the folder has no PVTU, rather than one that names files of two meshes.
    std::error_code ignored;
    std::filesystem::remove(folder / (stem + ".pvtu"), ignored);
    if (mesh.counts.size() == 1)
      std::filesystem::remove(folder / "interfaces.vtp", ignored);
    report summary{"vtu", 0, {}, {}, {}, sources};
    append(summary.files, skeleton_files);
    summary.files.push_back(stem + ".pvtu");
    std::uint64_t bytes = 0;
    for (const auto& name : summary.files)
      bytes += move_file(unfinished / name, folder / name);
    remove_stale_files(folder, stem, ".vtu", sources);
    sync_to_disk(folder);

    summary.set(written_counts{shared->numbers.elements(), bytes, summary.files.size()});
    return summary;
  };
  return output;
}

template <int D>
report vtu_writer::operator()(const distributed_simplicial_mesh<D>& mesh,
                              const std::filesystem::path& folder) const {
  return write_piecewise<D>(mesh, *this, folder);
}

#ifdef DOVETAIL_COMPILED
template piecewise_output<2> vtu_writer::begin(const distributed_simplicial_mesh<2>&,
                                               const std::filesystem::path&) const;
template piecewise_output<3> vtu_writer::begin(const distributed_simplicial_mesh<3>&,
                                               const std::filesystem::path&) const;
template report vtu_writer::operator()(const distributed_simplicial_mesh<2>&,
                                       const std::filesystem::path&) const;
template report vtu_writer::operator()(const distributed_simplicial_mesh<3>&,
                                       const std::filesystem::path&) const;
#endif

} // namespace dovetail::io
