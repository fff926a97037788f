/// @file
/// A format of a solver's ranks around another one.
#pragma once

#include "dovetail/core/wrapped_policy.hpp"
#include "dovetail/solver/concepts.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace dovetail::io {

namespace detail {

template <class Format>
inline constexpr bool names_files_by_count = requires(const Format& f, local_id q) {
  f.files_of_rank(q, 1);
};
template <class Format>
inline constexpr bool knows_outdated_files = requires(const Format& f, local_id q) {
  f.outdated_files_of_rank(q, 1);
};
template <class Format>
inline constexpr bool keeps_some_files = requires(const Format& f, const std::filesystem::path& path) {
  f.may_replace(path);
};

} // namespace detail

/// Base of a `rank_format` or `shared_rank_format` that changes a part of what another one writes: names of
/// files, which of them are outdated or are to stay, second order and dimensions are those of `Format`.
template <class Self, class Format>
struct format_wraps : wrapped_policy<Self, Format> {
  static_assert(rank_format<Format, 2> || rank_format<Format, 3> || shared_rank_format<Format, 2> ||
                    shared_rank_format<Format, 3>,
                "format_wraps holds a rank_format or a shared_rank_format (solver/concepts.hpp)");
  using wrapped_policy<Self, Format>::wrapped_policy;
  using wrapped_policy<Self, Format>::wrapped;

  /// Whether the wrapped format writes second-order elements.
  static constexpr bool second_order = has_second_order<Format>;

  /// The files of a rank.
  std::vector<std::string> files_of_rank(local_id q) const requires requires(const Format& f) {
    f.files_of_rank(q);
  }
  { return wrapped.files_of_rank(q); }
  /// The files of a rank of n.
  std::vector<std::string> files_of_rank(local_id q, int n) const
      requires(detail::names_files_by_count<Format>) {
    return wrapped.files_of_rank(q, n);
  }
  /// What others have made of a rank's files.
  std::vector<std::string> outdated_files_of_rank(local_id q, int n) const
      requires(detail::knows_outdated_files<Format>) {
    return wrapped.outdated_files_of_rank(q, n);
  }
  /// Whether a file that is there may be written over.
  bool may_replace(const std::filesystem::path& path) const requires(detail::keeps_some_files<Format>) {
    return wrapped.may_replace(path);
  }
  /// The files that all ranks have in common.
  std::vector<std::string> files_of_all() const { return wrapped.files_of_all(); }
  /// Writes a rank's files or share.
  template <int D>
    requires(rank_format<Format, D> || shared_rank_format<Format, D>)
  void write(const rank_source<D>& source, const rank_mesh<D>& mesh,
             const std::vector<std::filesystem::path>& paths) const {
    wrapped.write(source, mesh, paths);
  }
  /// Writes the common files.
  template <int D>
    requires(rank_format<Format, D>)
  void write_all(const rank_source<D>& source, const std::vector<std::filesystem::path>& paths) const {
    wrapped.write_all(source, paths);
  }
  /// Makes the common files, all but the ranks' shares.
  template <int D>
    requires(shared_rank_format<Format, D>)
  void lay_out(const rank_source<D>& source, const std::vector<rank_counts>& counts,
               const std::vector<std::filesystem::path>& paths) const {
    wrapped.lay_out(source, counts, paths);
  }
};

} // namespace dovetail::io
