/// @file
/// Output that is made piece by piece: some workers write files of whole pieces under temporary names, and
/// when all are complete they get their final ones.
#pragma once

#include "dovetail/core/bytes.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/output_file.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::io {

/// What a writer counts.
struct written_counts {
  global_id elements = 0;  ///< in all files
  std::uint64_t bytes = 0; ///< of all files
  std::size_t files = 0;   ///< how many there are

  using fields = field_list<&written_counts::elements, &written_counts::bytes, &written_counts::files>;
};

/// A file that takes pieces. It is complete after `close`; without it, nothing is left.
template <int D>
struct piece_file {
  std::function<void(const simplicial_piece<D>&)> add; ///< the next piece
  std::function<std::uint64_t()> close;                ///< returns the bytes of the file
};

/// What is done for files beside taking pieces.
template <class Result>
struct output_task {
  std::string name;            ///< who an error tells of where the task cannot: "ranks_0001.vtu of rank 1"
  std::function<Result()> run; ///< does it; called once, by any worker
};

/// The files of one format in the making, in a folder for unfinished files. What `counts`, `open` and
/// `others` hold may be called in any worker, in any order.
template <int D>
struct piecewise_output {
  std::vector<local_id>
      bounds; ///< file f takes pieces bounds[f] .. bounds[f + 1] - 1: from 0 to their number; or no files
  std::vector<std::string> names;                    ///< of these files
  std::vector<output_task<byte_buffer>> counts = {}; ///< run first: how much the others will write
  /// Where there are counts, called once with what all of them returned, before all that follows: makes the
  /// files that several of the others write to.
  std::function<void(const std::vector<byte_buffer>& counted)> prepare = [](const auto&) {};
  std::function<piece_file<D>(std::size_t)> open; ///< file f
  std::vector<output_task<void>> others = {};     ///< each writes files that take no pieces
  /// The most pieces that one of the others loads by itself; unless it is 0, pieces are not given up.
  local_id most_loaded = 0;
  /// Called when all these are there: writes what names them, or is made of them, still in the same folder.
  std::function<void()> complete = [] {};
  /// Called when all is complete, also that of other writers: moves the files to their own folder.
  std::function<report(const std::filesystem::path& folder)> finish;
};

/// Any writer of files of whole pieces behind one type: what has a `begin(mesh, unfinished)`, as the concept
/// `piecewise_mesh_writer` says. May hold nothing. Throws `usage_error` when the files do not take each piece
/// once, and `io_error` in place of what a writer throws that is no error of ours.
template <int D>
class any_piecewise_writer {
public:
  any_piecewise_writer() = default;
  template <class W>
    requires requires(const W& writer, const distributed_simplicial_mesh<D>& mesh,
                      const std::filesystem::path& unfinished) {
      { writer.begin(mesh, unfinished) } -> std::same_as<piecewise_output<D>>;
    }
  any_piecewise_writer(W writer) // NOLINT: converts, as std::function does
      : begin_([held = std::move(writer)](const distributed_simplicial_mesh<D>& mesh,
                                          const std::filesystem::path& unfinished) {
          return held.begin(mesh, unfinished);
        }) {}

  explicit operator bool() const { return static_cast<bool>(begin_); } ///< whether it holds a writer
  piecewise_output<D> begin(const distributed_simplicial_mesh<D>& mesh,
                            const std::filesystem::path& unfinished) const;

private:
  static void check(const piecewise_output<D>& output, local_id pieces);

  std::function<piecewise_output<D>(const distributed_simplicial_mesh<D>&, const std::filesystem::path&)>
      begin_;
};

/// Where files are until all of a mesh are complete: the folder "unfinished" in theirs. It goes with its
/// content at the end, unless it is kept, or is another rank's to remove. Of a folder that was there before
/// only files of meshes go.
class unfinished_folder {
public:
  explicit unfinished_folder(const std::filesystem::path& folder, bool own = true)
      : path_(std::filesystem::absolute(folder) / "unfinished"), was_there_(std::filesystem::exists(path_)),
        own_(own) {
    make_folder(path_);
  }
  unfinished_folder(const unfinished_folder&) = delete;
  unfinished_folder& operator=(const unfinished_folder&) = delete;
  ~unfinished_folder();

  /// Writers have a folder each, since some of their files may have the same names.
  std::filesystem::path of_writer(std::size_t number) const { return path_ / std::to_string(number); }
  void keep(bool kept) { kept_ = kept; } ///< whether the folder stays at the end

  /// Removes what a killed run has left in a folder: files of meshes, complete or not, in the numbered
  /// folders of the formats. What is not ours stays, and the folder with it.
  static void remove(const std::filesystem::path& folder);

private:
  std::filesystem::path path_;
  bool was_there_;
  bool own_;
  bool kept_ = false;
};

/// Gives a complete file its final place, on the same disk. Returns its bytes.
std::uint64_t move_file(const std::filesystem::path& from, const std::filesystem::path& to);

/// Writes all files one after the other, here.
/// Linear in the mesh. Throws what the writer throws, `io_error` most often.
/// \param mesh what `generate` makes, or a reader
/// \param writer a model of `piecewise_mesh_writer`
/// \param folder is made where it is missing
template <int D>
report write_piecewise(const distributed_simplicial_mesh<D>& mesh, const any_piecewise_writer<D>& writer,
                       const std::filesystem::path& folder);

#ifdef DOVETAIL_COMPILED
extern template class any_piecewise_writer<2>;
extern template class any_piecewise_writer<3>;
extern template report write_piecewise<2>(const distributed_simplicial_mesh<2>& mesh,
                                          const any_piecewise_writer<2>& writer,
                                          const std::filesystem::path& folder);
extern template report write_piecewise<3>(const distributed_simplicial_mesh<3>& mesh,
                                          const any_piecewise_writer<3>& writer,
                                          const std::filesystem::path& folder);
#endif

} // namespace dovetail::io

#ifndef DOVETAIL_COMPILED
#include "dovetail/files/piecewise_output.ipp"
#endif
