/// @file
/// What a run is described by, and its two forms: the summary on the terminal and the JSON report.
#pragma once

#include "file_checksums.hpp"

#include "dovetail/core/report.hpp"
#include "dovetail/core/vector.hpp"
#include "dovetail/mesh/poor_elements.hpp"
#include "dovetail/mesh/poor_triangles.hpp"
#include "dovetail/mesh/quality.hpp"
#include "dovetail/mesh/quality_at_interfaces.hpp"
#include "dovetail/models/virtual/suppressed_detail.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dovetail::app {

/// Wall time of the stages.
struct stage_seconds {
  double geometry = 0;
  double scaling = 0; ///< of the sizes to a number of elements
  double background = 0;
  double simplification = 0;
  double partition = 0;
  double skeleton = 0;
  double intersection = 0;
  double bisection = 0; ///< of the fine surface, where that is how the domain is decomposed
  double meshing = 0;
  double fine_partition = 0; ///< of the mesh, where that is how it is decomposed
  double improvement = 0;
  double redistribution = 0; ///< by elements
  double first_pass = 0;     ///< of what is improved again
  double between_passes = 0;
  double second_pass = 0;
  double writing_back = 0;
  double output = 0;
  double total = 0;
};

/// An interface angle below the threshold.
struct small_angle {
  double angle_deg = 0;
  bool dihedral = false; ///< beside an interface, not of one of its faces
  std::string cause;     ///< "forced", "refused" or "remeshing"
  vec3 place;
  std::vector<std::string> cad; ///< the entities that force it, or else the faces that it touches
};

/// The interface angles on one skeleton. Angles in degrees; none where there is nothing to measure.
struct interface_figures {
  std::optional<double> min_face_angle_deg = {};
  std::optional<double> min_dihedral_deg = {};
  std::int64_t faces = 0;
  std::int64_t forced = 0;    ///< below the threshold because of the CAD
  std::int64_t refused = 0;   ///< below the threshold because of the bound on super-elements
  std::int64_t remeshing = 0; ///< below the threshold by curving or refining, or a rule that cares for none
  std::vector<small_angle> below; ///< all of these, by growing angle
};

struct run_figures {
  int dimension = 3; ///< of the elements
  std::string model;
  std::string decomposition;
  std::string mesher, partitioner, simplifier, improver, executor, background_mesher, surface_mesher;
  int workers = 1;

  std::int64_t elements = 0;
  std::int64_t vertices = 0;
  std::int64_t boundary_triangles = 0;
  std::int64_t background_elements = 0;
  int subdomains = 0;                  ///< with a piece in the mesh
  std::vector<std::int64_t> only = {}; ///< their numbers, where they are not all
  std::int64_t of_subdomains = 0;      ///< how many there are in all
  double imbalance = 0;                ///< largest subdomain over the average, in elements
  stage_seconds seconds;
  quality_statistics quality;
  quality_at_interfaces at_interfaces;            ///< of the same elements
  poor_elements poor;                             ///< by their causes
  std::vector<suppressed_detail> suppressed = {}; ///< details of the model that the mesh does not have
  interface_figures interfaces, coarse_interfaces;
  report deviation; ///< from the CAD: "points" and "centres" in units of the local size, and a child per face
  std::int64_t merges = 0;
  std::int64_t largest_merged = 1; ///< subdomains merged into one, at most
  std::int64_t failed_subdomains = 0;
  std::int64_t elements_between_passes = 0; ///< collected or moved, where ranks improve again
  double largest_over_mean = 0;             ///< of the pieces of the second pass, where elements were moved
  std::uint64_t peak_rss_bytes = 0;
  std::uint64_t mesh_hash = 0;
  bool repeatable = true; ///< no limit of wall-clock time has decided anything: the hash is that of any run
  std::vector<std::string> warnings;
  std::string out; ///< folder with the mesh
  std::vector<written_file> files = {};
  report details; ///< the library's own report, all of it
};

/// What `plan` predicts.
struct plan_figures {
  int dimension = 3; ///< of the elements
  std::string model;
  double elements = 0;
  double relative_error = 0;
  int subdomains = 1;
  double coarsening = 1;
  int workers = 1;
  double seconds = 0;
  double worker_bytes = 0;
  double parent_bytes = 0;
  double disk_bytes = 0;
  std::vector<std::string> warnings = {};
};

std::string plan_text(const plan_figures& figures);
void write_plan(const plan_figures& figures, const std::filesystem::path& file);

/// The summary, laid out as the tables of the method's paper.
std::string summary_text(const run_figures& figures);

/// The smallest angles, in degrees, under which elements are called bad and low: dihedral ones of tetrahedra,
/// those of triangles.
struct quality_limits {
  int bad, low;
};
constexpr quality_limits limits_of(int dimension) {
  return dimension == 3 ? quality_limits{bad_dihedral_deg, low_dihedral_deg}
                        : quality_limits{bad_corner_deg, low_corner_deg};
}

/// What a cause of poor elements is called.
inline std::string_view name_of_cause(poor_cause cause, int dimension) {
  return dimension == 3 ? name_of(cause) : name_of_triangles(cause);
}

/// The number of tetrahedra with a smallest dihedral angle in the ranges of the paper's table of quality; the
/// angles of triangles.
std::string quality_text(const quality_statistics& quality, int dimension);
/// Elements by their distance from interfaces; empty where none touches one.
std::string at_interfaces_text(const quality_at_interfaces& found, int dimension);

/// Writes the report; throws `io_error` when the file cannot be written. Nothing is left behind then.
void write_report(const run_figures& figures, const std::filesystem::path& file);

/// Writes the statistics of one mesh, those at its interfaces where it has several subdomains, and what was
/// done to it (or an empty report).
void write_quality_report(const quality_statistics& quality, int dimension, std::int64_t vertices,
                          const report& details, const std::filesystem::path& file,
                          const std::optional<quality_at_interfaces>& at_interfaces = {});

/// The largest resident set of this process and of any child it waited for.
std::uint64_t peak_rss_bytes();

} // namespace dovetail::app
