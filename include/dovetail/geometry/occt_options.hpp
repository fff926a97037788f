/// @file
/// What of a CAD file is wanted.
#pragma once

namespace dovetail {

namespace occt {

/// The unit in which coordinates of STEP and IGES files are given to the caller.
enum class length_unit {
  millimetre, ///< what CAD kernels use inside, and most viewers and meshers report
  file        ///< the unit the file was written in
};

/// What of a shape is wanted: its solids, or all of its faces, whether they enclose solids or not.
enum class wanted { solids, faces };

} // namespace occt

struct occt_read_options {
  occt::length_unit unit = occt::length_unit::millimetre;
  /// For D = 2, `faces`: also open shells and single faces, such as a plane domain with holes and inner
  /// edges.
  occt::wanted entities = occt::wanted::solids;
};

} // namespace dovetail
