/// @file
/// What `piecewise_output.hpp` declares.
#pragma once

#include "dovetail/core/bytes.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/output_file.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/files/piecewise_output.hpp"
#include "dovetail/mesh/global_numbering.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace dovetail::io {

namespace detail {

/// What a writer throws that is no error of ours becomes one.
template <class F>
auto guarded_writer(const F& f) {
  return call_policy<io_error>([] { return std::string("the writer"); }, f);
}

} // namespace detail

template <int D>
piecewise_output<D> any_piecewise_writer<D>::begin(const distributed_simplicial_mesh<D>& mesh,
                                                   const std::filesystem::path& unfinished) const {
  auto output = detail::guarded_writer([&] { return begin_(mesh, unfinished); });
  check(output, static_cast<local_id>(mesh.counts.size()));
  output.prepare = [prepare = std::move(output.prepare)](const std::vector<byte_buffer>& counted) {
    detail::guarded_writer([&] { prepare(counted); });
  };
  output.finish = [finish = std::move(output.finish)](const std::filesystem::path& folder) {
    return detail::guarded_writer([&] { return finish(folder); });
  };
  return output;
}

template <int D>
void any_piecewise_writer<D>::check(const piecewise_output<D>& output, local_id pieces) {
  const auto& bounds = output.bounds;
  if (bounds.empty() && output.names.empty() && output.finish)
    return;
  if (bounds.empty() || bounds.front() != 0 || bounds.back() != pieces ||
      !std::is_sorted(bounds.begin(), bounds.end()))
    throw usage_error("the writer's files do not take pieces 0 to " + std::to_string(pieces - 1) +
                      " one after the other");
  if (output.names.size() + 1 != bounds.size())
    throw usage_error("the writer has " + std::to_string(output.names.size()) + " names for " +
                      std::to_string(bounds.size() - 1) + " files");
  if (!output.open || !output.finish)
    throw usage_error("the writer does not say how a file is opened or how all are finished");
}

DOVETAIL_INLINE unfinished_folder::~unfinished_folder() {
  std::error_code ignored;
  if (kept_ || !own_)
    return;
  if (was_there_)
    remove(path_.parent_path());
  else
    std::filesystem::remove_all(path_, ignored);
}

DOVETAIL_INLINE void unfinished_folder::remove(const std::filesystem::path& folder) {
  for (const auto& of_format : entries_of(folder / "unfinished")) {
    const std::string name = of_format.filename().string();
    std::error_code ignored;
    if (name.find_first_not_of("0123456789") != std::string::npos ||
        !std::filesystem::is_directory(std::filesystem::symlink_status(of_format, ignored)))
      continue;
    for (const auto& file : entries_of(of_format))
      if (const auto ending = file.extension();
          ending == ".part" || ending == ".vtu" || ending == ".vtp" || ending == ".pvtu" ||
          ending == ".msh_piece" || ending == ".vtkhdf" || ending == ".xdmf" || ending == ".rank_file")
        std::filesystem::remove(file, ignored);
    remove_empty_folder(of_format);
  }
  remove_empty_folder(folder / "unfinished");
}

DOVETAIL_INLINE std::uint64_t move_file(const std::filesystem::path& from, const std::filesystem::path& to) {
  std::error_code failure;
  const auto bytes = std::filesystem::file_size(from, failure);
  if (!failure)
    std::filesystem::rename(from, to, failure);
  if (failure)
    throw io_error("cannot rename the finished file to " + to.string() + ": " + failure.message());
  return bytes;
}

template <int D>
report write_piecewise(const distributed_simplicial_mesh<D>& mesh, const any_piecewise_writer<D>& writer,
                       const std::filesystem::path& folder) {
  const stopwatch clock;
  const unfinished_folder unfinished(folder);
  make_folder(unfinished.of_writer(0));
  const piecewise_output<D> output = writer.begin(mesh, unfinished.of_writer(0));
  if (!output.counts.empty()) {
    std::vector<byte_buffer> counted;
    for (const auto& count : output.counts)
      counted.push_back(count.run());
    output.prepare(counted);
  }
  for (std::size_t f = 0; f + 1 < output.bounds.size(); ++f) {
    const piece_file<D> file = output.open(f);
    for (local_id p = output.bounds[f]; p < output.bounds[f + 1]; ++p)
      file.add(load_checked(mesh, p));
    file.close();
  }
  for (const auto& other : output.others)
    other.run();
  output.complete();
  report summary = output.finish(folder);
  summary.seconds = clock.seconds();
  return summary;
}

#ifdef DOVETAIL_COMPILED
template class any_piecewise_writer<2>;
template class any_piecewise_writer<3>;
template report write_piecewise<2>(const distributed_simplicial_mesh<2>& mesh,
                                   const any_piecewise_writer<2>& writer,
                                   const std::filesystem::path& folder);
template report write_piecewise<3>(const distributed_simplicial_mesh<3>& mesh,
                                   const any_piecewise_writer<3>& writer,
                                   const std::filesystem::path& folder);
#endif

} // namespace dovetail::io
