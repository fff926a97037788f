/// @file
/// Reads OpenFOAM's meshes as `openfoam_format` writes them, and finds out whether the processors agree.
#pragma once

#include "dovetail/files/piece_visitor.hpp"
#include "dovetail/mesh/loaded_mesh.hpp"

#include <filesystem>
#include <vector>

namespace dovetail::io {

/// The folders `polyMesh` of the mesh that is meant: those of all processors of a case, or that of a case in
/// one part. `path` is the case, the folder of a processor, a folder `polyMesh` or a file in it; of a case
/// that has both, the processors are meant. Empty: it is none of these.
/// Linear in the processors. Throws nothing but for a lack of memory.
/// \param path a file or folder, there or not
std::vector<std::filesystem::path> folders_of_openfoam(const std::filesystem::path& path);

/// Calls `f(piece, folder)` for each of these folders, in the order of the processors. Tags of tetrahedra are
/// cell zones, triangles the faces of patches other than those of processors, turned outwards, with the
/// patch as their tag. Points at the ends of processors are the same where they are at the same place.
///
/// A cell must be a tetrahedron of four triangles turned from owner to neighbour; faces must be in
/// upper-triangular order, and patches follow each other. Both sides of a processor patch must have the same
/// faces in the same order, turned against each other and with the same first point, and no other patch may
/// have faces between processors. All processors must have the same other patches and zones.
///
/// Throws `input_error` that names file and line, or the face or cell, for whatever is not so, and for files
/// that are not text. About linear; memory: a piece, and where the pieces end.
/// \param path as for `folders_of_openfoam`
/// \param f takes the pieces
void for_each_openfoam_piece(const std::filesystem::path& path, const piece_visitor& f);

/// The whole mesh of these folders. Throws what `for_each_openfoam_piece` throws. n log n.
/// \param path as for `folders_of_openfoam`
loaded_mesh read_openfoam(const std::filesystem::path& path);

} // namespace dovetail::io

#ifndef DOVETAIL_COMPILED
#include "dovetail/solver/openfoam_reader.ipp"
#endif
