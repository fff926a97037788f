/// @file
/// Does a mesh fill what its model encloses?
///
/// Between a mesh and its model lies no more than the gap: the volume between the triangles of the boundary
/// and the faces that they are meshes of, which is summed up where those are made (`surface_deviation`), and
/// which finer sizes close. A volume that differs by more than that says that a part of the boundary is not
/// where the model has it, however small each triangle's own distance is.
#pragma once

#include "dovetail/core/report.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"

#include <optional>

namespace dovetail {

/// The volumes of a mesh and of its model.
struct volume_counts {
  double volume = 0;       ///< of the mesh
  double model_volume = 0; ///< as the model knows it

  using fields = field_list<&volume_counts::volume, &volume_counts::model_volume>;
};

/// The volume inside the boundary of a mesh. Linear in the sides of its skeleton.
double volume_inside(const simplicial_skeleton<3>& skeleton);

/// The mesh of a model of tetrahedra fills the volume that the model has: or else there is a warning in
/// `summary`, the report of the run, which gets `volume_counts`. Allowed are twice the gap, which is measured
/// at the centres of triangles, and three millionths of the volume, by which those that geometry kernels
/// give are off. What these explain is told from a fifth of the volume on. Nothing is done where the model
/// does not know its volume.
/// \param of_model the model's own volume, where it knows it
void compare_volume(const simplicial_skeleton<3>& skeleton, const std::optional<double>& of_model,
                    report& summary);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/pipeline/model_measure.ipp"
#endif
