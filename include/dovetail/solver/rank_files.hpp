/// @file
/// A mesh in the files of a parallel solver: each rank's share is written by itself, into files of its own or
/// at its place in one that all have, so that nothing is gathered.
#pragma once

#include "dovetail/core/encoding.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/distributed/by_pieces.hpp"
#include "dovetail/files/concepts.hpp"
#include "dovetail/solver/concepts.hpp"
#include "dovetail/solver/make_rank_mesh.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace dovetail::io {

/// Writes a distributed mesh for a solver with `ranks` ranks, however many workers made it.
template <class Format, class Redistributor = redistribution_by::pieces>
struct rank_writer {
  static_assert(rank_format<Format, 2> || rank_format<Format, 3> || shared_rank_format<Format, 2> ||
                    shared_rank_format<Format, 3>,
                "rank_writer takes a rank_format or a shared_rank_format (solver/concepts.hpp)");
  static_assert(redistributor<Redistributor, 2> || redistributor<Redistributor, 3>,
                "rank_writer goes by a redistributor (distributed/concepts.hpp)");

  int ranks = 1;
  Format format = {};              ///< what files are written
  Redistributor redistribute = {}; ///< which rank gets what
  bool ghosts = false;             ///< each rank also has the elements of others that touch its own

  /// A model of `piecewise_mesh_writer`. Memory: the skeleton, 30 bytes per node of it, and a rank's mesh
  /// per worker. Further throws what the redistributor throws, and
  /// `usage_error` for a mesh of second order in a format that has none. The report has a child
  /// "redistribution".
  template <int D>
  report operator()(const distributed_simplicial_mesh<D>& mesh, const std::filesystem::path& folder) const {
    return write_piecewise<D>(mesh, *this, folder);
  }

  /// A task per rank, and one for files that all ranks have in common. They load the pieces themselves. Where
  /// ranks write into the same files, a task per rank counts before how much that will be.
  template <int D>
    requires((rank_format<Format, D> || shared_rank_format<Format, D>)&&redistributor<Redistributor, D>)
  piecewise_output<D> begin(const distributed_simplicial_mesh<D>& mesh,
                            const std::filesystem::path& unfinished)
  const {
    if (mesh.mid_nodes && !has_second_order<Format>)
      throw usage_error("files of the format " + format.name() +
                        " are of first order: write them of the mesh without middles of edges, or others, of "
                        "the format pvtu for example");
    redistribution<D> given = redistribute(mesh, ranks);
    const auto& divided = given.divided(mesh);
    const auto held = std::make_shared<const held_source<D>>(held_source<D>{
        given.mesh, {divided, number_by_ranks(divided, std::move(given.rank_of_piece), ranks), ghosts}});
    const std::shared_ptr<const rank_source<D>> source(held, &held->source);
    piecewise_output<D> output;
    std::vector<file> files;
    const auto add = [&](const std::vector<std::string>& names) {
      std::vector<std::filesystem::path> paths;
      for (const auto& name : names) {
        const auto of_user = std::filesystem::path(name).filename().string(); // whom errors tell about it
        files.push_back({unfinished / (of_user + "." + std::to_string(files.size()) + ".rank_file"), name});
        paths.push_back(files.back().unfinished);
      }
      return paths;
    };
    const local_id of_ranks = source->numbers.ranks();
    for (local_id q = 0; q < of_ranks; ++q)
      output.most_loaded =
          std::max(output.most_loaded, static_cast<local_id>(source->numbers.pieces_of_rank[q].size()));
    const std::vector<std::string> of_all = format.files_of_all();
    if constexpr (shared_rank_format<Format, D>) {
      const auto paths = add(of_all);
      output.prepare = [source, format = format, paths](const std::vector<byte_buffer>& counted) {
        std::vector<rank_counts> counts;
        for (const byte_buffer& of_rank : counted)
          counts.push_back(decoded<rank_counts>(of_rank));
        format.lay_out(*source, counts, paths);
      };
      for (local_id q = 0; q < of_ranks; ++q) {
        const std::string name = "the share of rank " + std::to_string(q) + " in " + text_of(of_all);
        output.counts.push_back({name, [source, q] { return encoded(source->counts_of(q)); }});
        output.others.push_back({name, [source, q, format = format, paths] {
                                   format.write(*source, source->mesh_of(q), paths);
                                 }});
      }
    } else {
      for (local_id q = 0; q < of_ranks; ++q) {
        const std::vector<std::string> of_rank = names_of_rank(format, q, of_ranks);
        if (auto paths = add(of_rank); !paths.empty())
          output.others.push_back({text_of(of_rank) + " of rank " + std::to_string(q),
                                   [source, q, format = format, paths = std::move(paths)] {
                                     format.write(*source, source->mesh_of(q), paths);
                                   }});
      }
      if (format.files_of_rank(0).empty()) // one task has all ranks, one after the other
        output.most_loaded = static_cast<local_id>(divided.counts.size());
      if (auto paths = add(of_all); !paths.empty())
        output.others.push_back(
            {text_of(of_all) + " of all ranks",
             [source, format = format, paths = std::move(paths)] { format.write_all(*source, paths); }});
    }
    output.finish = [source, files, format = format,
                     summary = std::move(given.summary)](const std::filesystem::path& folder) {
      return move_all(*source, files, format, summary, folder);
    };
    return output;
  }

private:
  /// What is read from, with the mesh where the redistributor has made it.
  template <int D>
  struct held_source {
    std::shared_ptr<const distributed_simplicial_mesh<D>> mesh;
    rank_source<D> source;
  };
  struct file {
    std::filesystem::path unfinished;
    std::string name; ///< in the folder, perhaps below it
  };

  static std::string text_of(const std::vector<std::string>& files) {
    return files.front() + (files.size() == 1 ? "" : " and " + std::to_string(files.size() - 1) + " more");
  }

  /// Whether names depend on the number of ranks.
  static constexpr bool counts_ranks = requires(const Format& f) { f.files_of_rank(local_id{0}, 1); };
  static std::vector<std::string> names_of_rank(const Format& format, local_id q,
                                                [[maybe_unused]] local_id of) {
    if constexpr (counts_ranks)
      return format.files_of_rank(q, static_cast<int>(of));
    else
      return format.files_of_rank(q);
  }

  /// Whether one of the files was there. Folders that are empty then go with them: the number of OpenFOAM's
  /// says how many processors there are.
  static bool remove(const std::vector<std::string>& names, const std::filesystem::path& folder) {
    std::error_code ignored;
    bool was_there = false;
    for (const auto& name : names) {
      was_there = std::filesystem::remove(folder / name, ignored) || was_there;
      for (auto at = (folder / name).parent_path();
           at != folder && std::filesystem::remove(at, ignored);) // not when something is in it
        at = at.parent_path();
    }
    return was_there;
  }

  /// What a new mesh makes wrong: of an earlier one of another number of ranks all, of its own ranks what
  /// others have made of them.
  static void remove_outdated(local_id ranks, const Format& format, const std::filesystem::path& folder) {
    const auto derived = [&](local_id q, local_id of) {
      std::vector<std::string> names;
      if constexpr (requires { format.outdated_files_of_rank(q, 1); })
        names = format.outdated_files_of_rank(q, static_cast<int>(of));
      return names;
    };
    const auto remove_rank = [&](local_id q, local_id of) {
      const bool was_there = remove(derived(q, of), folder);
      return remove(names_of_rank(format, q, of), folder) || was_there;
    };
    for (local_id q = 0; q < ranks; ++q)
      remove(derived(q, ranks), folder);
    if (counts_ranks && ranks > 1)
      remove_rank(0, 1);
    local_id other = counts_ranks && ranks == 1 ? 0 : ranks;
    while (remove_rank(other, other + 2)) // of more than one
      ++other;
  }

  static bool may_replace([[maybe_unused]] const Format& format,
                          [[maybe_unused]] const std::filesystem::path& path) {
    if constexpr (requires { format.may_replace(path); })
      return !std::filesystem::exists(path) || format.may_replace(path);
    else
      return true;
  }

  template <int D>
  static report move_all(const rank_source<D>& source, const std::vector<file>& files, const Format& format,
                         const report& redistributed, const std::filesystem::path& folder) {
    report summary{format.name(), 0, {}, {}, {redistributed}};
    std::uint64_t bytes = 0;
    for (const auto& [from, name] : files) {
      make_folder((folder / name).parent_path());
      if (!may_replace(format, folder / name)) {
        std::filesystem::remove(from);
        continue;
      }
      bytes += move_file(from, folder / name);
      summary.files.push_back(name);
    }
    if constexpr (!shared_rank_format<Format, D>)
      remove_outdated(source.numbers.ranks(), format, folder);
    sync_to_disk(folder);
    summary.set(written_counts{source.numbers.first_element.back(), bytes, summary.files.size()});
    return summary;
  }
};

} // namespace dovetail::io
