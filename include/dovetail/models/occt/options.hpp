/// @file
/// What of a CAD file is wanted, and who reads it.
#pragma once

#include "dovetail/core/progress.hpp"
#include "dovetail/parallel/any_executor.hpp"

#include <optional>

namespace dovetail {

namespace occt {

/// The unit in which coordinates of STEP and IGES files are given to the caller.
enum class length_unit {
  millimetre, ///< what CAD kernels use inside, and most viewers and meshers report
  file        ///< the unit the file was written in
};

/// What of a shape is wanted: its `solids`, or all of its `faces`, whether they enclose solids or not.
enum class wanted { solids, faces };

} // namespace occt

/// How a CAD file is read.
struct occt_read_options {
  occt::length_unit unit = occt::length_unit::millimetre; ///< of the model that is made
  /// For D = 2, `faces`: also open shells and single faces, such as a plane domain with holes and inner
  /// edges.
  occt::wanted entities = occt::wanted::solids;
  /// Faces that touch, or are nearer than this length to each other, share what they have in common, also if
  /// they are of one solid: slits so narrow are closed. Without it contacts of a solid with itself stay what
  /// they are, and its surfaces cross there. It takes some milliseconds for each face.
  std::optional<double> join_within = {};
  /// Who reads the file before the caller does, or nobody. With `parallel::processes`, a file on which Open
  /// CASCADE crashes or does not come back is an `input_error` like any other damaged one, and
  /// `on_progress` can stop it; reading takes twice as long. Not where other threads run.
  std::optional<any_executor> first_reader = {};
  double most_seconds = 0; ///< processor time for that; 0: 30 s, and 20 s per megabyte
  progress on_progress = {};
};

} // namespace dovetail
