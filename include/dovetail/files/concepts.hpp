/// @file
/// What is asked of the writers and readers of mesh files.
#pragma once

#include "dovetail/core/report.hpp"
#include "dovetail/files/piecewise_output.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"
#include "dovetail/mesh/loaded_mesh.hpp"

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
/// distributed_mesh.hpp. Besides the skeleton one piece is in memory at a time; `mesh.load` may be called
/// more than once per piece. Files get their final names when all are complete.
///
/// Complexity: linear in the size of the mesh. The report has `io::written_counts`.
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
/// Semantics: prepares the files, which are in the folder `unfinished` until all are complete. Nothing is
/// loaded; each piece is given once to the file that takes it (`piecewise_output::open`), in any worker.
/// `piecewise_output::finish` may make other files of these. The bytes of a file depend on the mesh alone.
/// `mesh` outlives the output. `w(mesh, folder)` gives the same files.
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

/// The role `mesh_reader`: a file becomes a mesh.
///
/// Valid expression for `const R& r`, `const std::filesystem::path& file`: `r(file)` -> loaded_mesh.
///
/// Semantics: reads the tetrahedra with their tags, and the triangles, arrays and names the file has.
///
/// Complexity: linear; the whole mesh is held.
///
/// Failure: throws `input_error` naming the file and the fault when it is missing, truncated, malformed,
/// foreign, or has elements other than simplices.
///
/// Models: io::vtu_reader, io::msh_reader.
template <class R>
concept mesh_reader = std::copy_constructible<R> && requires(const R& r, const std::filesystem::path& file) {
  { r(file) } -> std::same_as<io::loaded_mesh>;
};

} // namespace dovetail
