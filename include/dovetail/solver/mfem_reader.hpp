/// @file
/// Reads MFEM's parallel meshes as `mfem_format` writes them, and finds out whether the ranks agree.
#pragma once

#include "dovetail/files/piece_visitor.hpp"
#include "dovetail/mesh/loaded_mesh.hpp"

#include <filesystem>
#include <vector>

namespace dovetail::io {

/// The files of all ranks, `<stem>.000000` and so on, of which `file` is one. Throws `input_error` when it is
/// not called so, or a file before it is not there. Linear in the ranks.
/// \param file of any rank
std::vector<std::filesystem::path> files_of_mfem(const std::filesystem::path& file);

/// Calls `f(piece, file)` for each rank's file, in the order of the ranks. Vertices that ranks share, as the
/// files say, have one global number. Boundary elements are the triangles of a piece, in the file's
/// orientation; tags are attributes minus 1, names those in the comments.
///
/// Every group of ranks must share the same vertices, edges and faces in the same order and at the same
/// places, and all that its ranks have in common; boundary elements must be sides of elements, each once.
///
/// Throws `input_error` that names file and line, or the entity, for whatever is not so, for elements that
/// are no tetrahedra, and for those of second order unless they are asked for. About linear; memory: a piece,
/// and what ranks share.
/// \param file of any rank
/// \param f takes the pieces
/// \param elements whether elements of second order are taken
void for_each_mfem_piece(const std::filesystem::path& file, const piece_visitor& f,
                         element_order elements = element_order::first);

/// The whole mesh of these files. Throws what `for_each_mfem_piece` throws. n log n.
/// \param file of any rank
loaded_mesh read_mfem(const std::filesystem::path& file);

} // namespace dovetail::io

#ifndef DOVETAIL_COMPILED
#include "dovetail/solver/mfem_reader.ipp"
#endif
