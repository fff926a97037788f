/// @file
/// What `msh_writer.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/files/msh_document.hpp"
#include "dovetail/files/msh_writer.hpp"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

namespace dovetail::io {

namespace detail {

template <int D>
piecewise_output<D> begin_msh(const distributed_simplicial_mesh<D>& mesh,
                              const std::filesystem::path& unfinished, const msh_writer& as,
                              msh_partitions partitions) {
  sides_by_subdomain<D>{mesh}; // checks the skeleton's references; everything after indexes freely
  auto encoding = std::make_shared<msh_encoding>();
  encoding->numbers = number_nodes(mesh);
  encoding->binary = as.binary;
  if constexpr (D == 3)
    if (partitions == msh_partitions::with_ghosts)
      encoding->sharers = std::make_unique<const point_sharers>(mesh.skeleton);
  const std::shared_ptr<const msh_encoding> shared = std::move(encoding);

  piecewise_output<D> output;
  output.bounds = {0};
  std::vector<std::filesystem::path> paths;
  for (local_id p = 0; p < static_cast<local_id>(mesh.counts.size()); ++p) {
    output.bounds.push_back(p + 1);
    output.names.push_back(as.stem + "_" + std::to_string(p) + ".msh_piece");
    paths.push_back(unfinished / output.names.back());
  }
  output.open = [&mesh, paths, shared](std::size_t f) {
    const auto file = std::make_shared<msh_piece_file<D>>(paths[f], mesh, shared);
    return piece_file<D>{[file](const simplicial_piece<D>& piece) { file->add(piece); },
                         [file] { return file->close(); }};
  };
  const std::filesystem::path whole = unfinished / (as.stem + ".msh");
  output.complete = [&mesh, paths, shared, partitions, whole] {
    msh_piece_files pieces(paths);
    write_msh_file(whole, prepare_msh(mesh, shared->numbers, pieces.tables(), partitions), pieces,
                   shared->binary);
  };
  output.finish = [shared, whole](const std::filesystem::path& folder) {
    const std::string name = whole.filename().string();
    const auto bytes = move_file(whole, folder / name);
    sync_to_disk(folder);
    report summary{"msh", 0, {}, {}, {}, {name}};
    summary.set(written_counts{shared->numbers.elements(), bytes, 1});
    return summary;
  };
  return output;
}

} // namespace detail

template <int D>
piecewise_output<D> msh_writer::begin(const distributed_simplicial_mesh<D>& mesh,
                                      const std::filesystem::path& unfinished) const {
  return detail::begin_msh(mesh, unfinished, *this, detail::msh_partitions::none);
}

template <int D>
report msh_writer::operator()(const distributed_simplicial_mesh<D>& mesh,
                              const std::filesystem::path& folder) const {
  return write_piecewise<D>(mesh, *this, folder);
}

DOVETAIL_INLINE piecewise_output<3>
partitioned_msh_writer::begin(const distributed_mesh& mesh, const std::filesystem::path& unfinished) const {
  return detail::begin_msh(mesh, unfinished, {.binary = binary, .stem = stem},
                           ghosts ? detail::msh_partitions::with_ghosts : detail::msh_partitions::plain);
}

DOVETAIL_INLINE report partitioned_msh_writer::operator()(const distributed_mesh& mesh,
                                                          const std::filesystem::path& folder) const {
  return write_piecewise<3>(mesh, *this, folder);
}

#ifdef DOVETAIL_COMPILED
template piecewise_output<2> msh_writer::begin(const distributed_simplicial_mesh<2>&,
                                               const std::filesystem::path&) const;
template piecewise_output<3> msh_writer::begin(const distributed_simplicial_mesh<3>&,
                                               const std::filesystem::path&) const;
template report msh_writer::operator()(const distributed_simplicial_mesh<2>&,
                                       const std::filesystem::path&) const;
template report msh_writer::operator()(const distributed_simplicial_mesh<3>&,
                                       const std::filesystem::path&) const;
#endif

} // namespace dovetail::io
