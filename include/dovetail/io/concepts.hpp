/// @file
/// What is asked of the writers and readers of mesh files.
#pragma once

#include "dovetail/core/report.hpp"
#include "dovetail/io/loaded_mesh.hpp"
#include "dovetail/io/make_rank_mesh.hpp"
#include "dovetail/io/piecewise_output.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"

#include <concepts>
#include <filesystem>
#include <string>
#include <vector>

namespace dovetail {

/// The role `mesh_writer<W, D>`: a distributed mesh becomes files. D = 3 when it is not said.
///
/// Valid expression for `const W& w`, `const distributed_simplicial_mesh<D>& mesh`,
/// `const std::filesystem::path& folder`: `w(mesh, folder)` -> report.
///
/// Semantics: writes the mesh into the folder (made when missing), with the global numbers of
/// distributed_mesh.hpp. The mesh is streamed: besides the skeleton, one piece is in memory at a time;
/// `mesh.load` may be called more than once per piece. Files appear under their final names when all of
/// them are complete.
///
/// Complexity: linear in the size of the mesh. The report has the counters elements, bytes and files.
///
/// Failure: throws `io_error` naming the path when the folder cannot be written or the disk is full,
/// `mesh_error` when pieces and skeleton disagree.
///
/// Models: io::vtu_writer, io::hdf5_writer and io::msh_writer for D = 2 and 3, io::partitioned_msh_writer
/// for D = 3, io::rank_writer of a format.
template <class W, int D = 3>
concept mesh_writer = std::copy_constructible<W> &&
    requires(const W& w, const distributed_simplicial_mesh<D>& mesh, const std::filesystem::path& folder) {
  { w(mesh, folder) } -> std::same_as<report>;
};

/// The role `piecewise_mesh_writer<W, D>`: a `mesh_writer` whose files hold whole pieces, so that several
/// workers can write them.
///
/// Valid expression for `const W& w`, `const distributed_simplicial_mesh<D>& mesh`,
/// `const std::filesystem::path& unfinished`: `w.begin(mesh, unfinished)` -> io::piecewise_output<D>.
///
/// Semantics: prepares the files, which will be in the folder `unfinished` until all are complete. Nothing is
/// loaded; each piece is given once to the file that takes it (`piecewise_output::open`), in any worker.
/// These are the files of the mesh, or what `piecewise_output::finish` makes them of. The bytes of a file
/// depend on the mesh alone. `mesh` outlives the output. `w(mesh, folder)` gives the same files.
///
/// Complexity: linear in the skeleton.
///
/// Failure: as `mesh_writer`; a file that is not closed leaves nothing.
///
/// Models: io::vtu_writer, io::hdf5_writer and io::msh_writer for D = 2 and 3, io::partitioned_msh_writer
/// for D = 3, io::rank_writer of a format.
template <class W, int D = 3>
concept piecewise_mesh_writer = mesh_writer<W, D> &&
    requires(const W& w, const distributed_simplicial_mesh<D>& mesh,
             const std::filesystem::path& unfinished) {
  { w.begin(mesh, unfinished) } -> std::same_as<io::piecewise_output<D>>;
};

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
/// Semantics: what is written depends on the arguments alone, and a file on its own names alone, as the names
/// given are temporary. Each call may be made in another process, in any order. `write` or `write_all` is not
/// called where there are no names. Meshes of second order are given to a format only if it has a static
/// constant `second_order` that is true (`has_second_order<F>`).
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
/// Semantics: `lay_out` is called once, and is done before the first `write`. The calls of `write` may be
/// made in several processes at once, on several machines, in any order: no two write the same bytes. What is
/// in the files in the end depends on the arguments alone, and not on their names, as the names given are
/// temporary. Meshes of second order are given to a format only if it says so (`has_second_order<F>`).
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

/// The role `mesh_reader`: a file becomes a mesh.
///
/// Valid expression for `const R& r`, `const std::filesystem::path& file`: `r(file)` -> loaded_mesh.
///
/// Semantics: reads the tetrahedra with their tags, and the triangles, arrays and names the file has.
///
/// Complexity: linear; the whole mesh is held.
///
/// Failure: throws `input_error` naming the file and what is wrong with it when it is missing, truncated,
/// malformed, foreign, or has elements other than simplices.
///
/// Models: io::vtu_reader, io::msh_reader.
template <class R>
concept mesh_reader = std::copy_constructible<R> && requires(const R& r, const std::filesystem::path& file) {
  { r(file) } -> std::same_as<io::loaded_mesh>;
};

} // namespace dovetail
