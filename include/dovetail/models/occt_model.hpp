/// @file
/// `occt_model`: a B-rep of Open CASCADE (OCCT) as a `geometry_model`. Parses no header of OCCT; who works on
/// the shape itself includes occt_shape.hpp or occt_brep.hpp.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/geometry/any_geometry.hpp"
#include "dovetail/geometry/concepts.hpp"
#include "dovetail/models/occt/options.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

class TopoDS_Shape;

namespace dovetail {

namespace occt {
struct attributed_shape;
struct brep;
struct evaluators;
} // namespace occt

/// A CAD model of one or several solids, or of faces alone. Models `geometry_model`.
///
/// Evaluation fills caches inside, so one object serves one thread; copies are independent of each other and
/// cheap (they share the topology and OCCT's geometry), so give each thread a copy.
class occt_model {
public:
  /// `data` must be without faults; made by `occt_model_from` or `read_occt_model`.
  explicit occt_model(occt::brep data);
  occt_model(const occt_model& other);
  occt_model(occt_model&&) noexcept;
  occt_model& operator=(const occt_model& other);
  occt_model& operator=(occt_model&&) noexcept;
  ~occt_model();

  const geometry_topology& topology() const { return *topology_; }
  const TopoDS_Shape& shape() const; ///< as it was read and healed
  const occt::brep& data() const { return *data_; }
  box3 bounds() const { return bounds_; }
  bool thread_safe() const { return false; }

  vec3 curve_point(local_id c, double t) const;
  dovetail::curve_frame curve_frame(local_id c, double t) const;
  vec2 curve_uv(local_id f, int k, double t) const;
  vec3 face_point(local_id f, vec2 uv) const;
  surface_frame face_frame(local_id f, vec2 uv) const;
  double face_curvature(local_id f, vec2 uv) const;
  vec2 project_to_face(local_id f, vec3 p, vec2 seed) const;
  /// Damped Newton from the seed, kept in the curve's range.
  double project_to_curve(local_id c, vec3 p, double seed) const;
  /// The plane that a face lies in, if all its curves are in it too; meshers then evaluate it themselves.
  std::optional<surface_frame> plane_of_face(local_id f) const;
  /// The volume of all solids, which OCCT integrates over their faces; nothing when it fails.
  std::optional<double> volume() const;

private:
  vec3 pole(local_id c) const;

  std::shared_ptr<const occt::brep> data_;
  const geometry_topology* topology_; ///< of `data_`
  std::unique_ptr<occt::evaluators> own_;
  box3 bounds_;
};
static_assert(geometry_model<occt_model>);

#ifdef DOVETAIL_COMPILED_OCCT
extern template any_geometry::any_geometry(occt_model);
#endif

/// A model and what was found and done while making it.
struct occt_read_result {
  occt_model model;        ///< the model that was read
  dovetail::report report; ///< what was counted on the way
  bool joined = false;     ///< whether there were faces to join (`occt_read_options::join_within`)
};

/// Turns a shape into a model, healing as far as needed. Throws `geometry_error` naming the first entity that
/// cannot be meshed.
/// \param input the shape with names; it may be changed
/// \param what solids alone, or faces beside them
/// \param join_within as in `occt_read_options`
occt_read_result occt_model_from(occt::attributed_shape input, occt::wanted what = occt::wanted::solids,
                                 const std::optional<double>& join_within = {});

/// The same for a shape made by the caller's own OCCT code. The shape may be changed by healing.
occt_read_result occt_shape_from(const TopoDS_Shape& shape, std::string name = "shape",
                                 occt::wanted what = occt::wanted::solids);

/// Whether a file looks like STEP, IGES or BREP by its first lines; false when it cannot be opened.
bool is_occt_file(const std::filesystem::path& path);

/// Reads a STEP, IGES or BREP file. Throws `input_error` for a file that is missing, empty, truncated or
/// foreign, `geometry_error` for a shape that cannot be meshed.
/// Complexity: that of OpenCASCADE's readers and repairs.
/// \param path a STEP, IGES or BREP file, text or binary
/// \param options unit, solids or faces, who reads the file first
occt_read_result read_occt_model(const std::filesystem::path& path, occt_read_options options = {});

} // namespace dovetail

#ifndef DOVETAIL_COMPILED_OCCT
#include "dovetail/models/occt_model.ipp"
#endif
