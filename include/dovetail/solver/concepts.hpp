/// @file
/// What is asked of the file formats of parallel solvers.
#pragma once

#include "dovetail/core/ids.hpp"
#include "dovetail/mesh/rank_mesh.hpp"
#include "dovetail/solver/make_rank_mesh.hpp"

#include <concepts>
#include <filesystem>
#include <string>
#include <vector>

namespace dovetail {

/// The role `rank_format<F, D>`: a file format of parallel solvers, which `io::rank_writer` makes a
/// `piecewise_mesh_writer`. D = 3 when it is not said.
///
/// Valid expressions for `const F& f`, `local_id q`, `const io::rank_source<D>& source`,
/// `const rank_mesh<D>& mesh`, `const std::vector<std::filesystem::path>& paths`:
///
/// - `f.name()`: std::string, of the format
/// - `f.files_of_rank(q)`: std::vector<std::string>, the files of a rank, below the folder of the mesh
/// - `f.files_of_all()`: std::vector<std::string>, the files that all ranks have in common
/// - `f.write(source, mesh, paths)`: writes the files of the mesh's rank under these names
/// - `f.write_all(source, paths)`: writes the common ones
///
/// and, where there are, for `int n` and `const std::filesystem::path& path`:
///
/// - `f.files_of_rank(q, n)`: the files of a rank of n, where their names depend on n
/// - `f.outdated_files_of_rank(q, n)`: files that other programs made of these, which a new mesh removes
/// - `f.may_replace(path)`: bool, whether an existing file may be written over (by default yes); if not, the
/// new one is dropped
///
/// Semantics: what is written depends on the arguments alone, and not on `paths`, which are temporary. Each
/// call may be made in another process, in any order; none where there are no names. Meshes of second order
/// are given to a format only if `F::second_order` is true (`has_second_order<F>`).
///
/// Complexity: linear in the rank; of `write_all` in what the files hold.
///
/// Failure: throws `io_error` naming the path when a file cannot be written.
///
/// Models: io::pvtu_format for D = 2 and 3, io::openfoam_format, io::mfem_format and io::rank_msh_format for
/// D = 3.
template <class F, int D = 3>
concept rank_format = std::copy_constructible<F> &&
    requires(const F& f, local_id q, const io::rank_source<D>& source, const rank_mesh<D>& mesh,
             const std::vector<std::filesystem::path>& paths) {
  { f.name() } -> std::same_as<std::string>;
  { f.files_of_rank(q) } -> std::same_as<std::vector<std::string>>;
  { f.files_of_all() } -> std::same_as<std::vector<std::string>>;
  f.write(source, mesh, paths);
  f.write_all(source, paths);
};

/// Whether a `rank_format` or `shared_rank_format` writes second-order elements.
template <class F>
inline constexpr bool has_second_order = requires {
  requires F::second_order;
};

/// The role `shared_rank_format<F, D>`: a file format of parallel solvers whose files hold all ranks, each of
/// which writes its share; `io::rank_writer` makes it a `piecewise_mesh_writer`. D = 3 when it is not said.
///
/// Valid expressions for `const F& f`, `const io::rank_source<D>& source`,
/// `const std::vector<io::rank_counts>& counts`, `const rank_mesh<D>& mesh`,
/// `const std::vector<std::filesystem::path>& paths`:
///
/// - `f.name()`: std::string, of the format
/// - `f.files_of_all()`: std::vector<std::string>, its files, below the folder of the mesh
/// - `f.lay_out(source, counts, paths)`: makes the files under these names, all but the ranks' shares;
/// `counts` has the size of each rank's mesh
/// - `f.write(source, mesh, paths)`: writes the share of the mesh's rank into them
///
/// Semantics: `lay_out` is called once, before any `write`. `write` may be called in several processes or
/// machines at once, in any order: no two write the same bytes. The files depend on the arguments alone, and
/// not on `paths`, which are temporary. Meshes of second order are given to a format only if
/// `has_second_order<F>`.
///
/// Complexity: of `write` linear in the rank's mesh; of `lay_out` in the skeleton, the pieces and the ranks.
///
/// Failure: throws `io_error` naming the path when a file cannot be written.
///
/// Models: io::xdmf_format and io::vtkhdf_format for D = 2 and 3.
template <class F, int D = 3>
concept shared_rank_format = std::copy_constructible<F> &&
    requires(const F& f, const io::rank_source<D>& source, const std::vector<io::rank_counts>& counts,
             const rank_mesh<D>& mesh, const std::vector<std::filesystem::path>& paths) {
  { f.name() } -> std::same_as<std::string>;
  { f.files_of_all() } -> std::same_as<std::vector<std::string>>;
  f.lay_out(source, counts, paths);
  f.write(source, mesh, paths);
};

} // namespace dovetail
