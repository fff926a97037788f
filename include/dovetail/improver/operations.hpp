/// @file
/// The operations of the native improver. A new one is a file of its own and its name in a list here; who
/// does not want to change the library makes a list of his own, see native_by.hpp.
#pragma once

#include "dovetail/improver/operation.hpp"
#include "dovetail/improver/tetrahedra/best_change.hpp"
#include "dovetail/improver/tetrahedra/edge_contraction.hpp"
#include "dovetail/improver/tetrahedra/edge_removal.hpp"
#include "dovetail/improver/tetrahedra/face_removal.hpp"
#include "dovetail/improver/tetrahedra/shell_transformation.hpp"
#include "dovetail/improver/tetrahedra/vertex_insertion.hpp"
#include "dovetail/improver/tetrahedra/vertex_smoothing.hpp"
#include "dovetail/improver/triangles/side_flip.hpp"
#include "dovetail/improver/triangles/side_insertion.hpp"
#include "dovetail/improver/triangles/triangle_smoothing.hpp"
#include "dovetail/improver/triangles/vertex_removal.hpp"

namespace dovetail::improvement {

/// In the order they are tried.
struct native_operations {
  /// What is done to tetrahedra, by the measure of shape.
  template <shape_measure Measure>
  using on_tetrahedra = operation_list<3,                                                         //
                                       best_change<edge_removal<Measure>, face_removal<Measure>>, //
                                       vertex_smoothing<Measure>,                                 //
                                       shell_transformation<Measure>,                             //
                                       edge_contraction<Measure>,                                 //
                                       vertex_insertion<Measure>>;
  /// What is done to triangles.
  using on_triangles = operation_list<2,                  //
                                      side_flip,          //
                                      triangle_smoothing, //
                                      vertex_removal,     //
                                      side_insertion>;
};

} // namespace dovetail::improvement
