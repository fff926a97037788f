/// @file
/// What a comparison finds out: one row of figures per combination of policies.
#pragma once

#include "run_figures.hpp"

#include "dovetail/mesh/quality.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace dovetail::app {

/// One way to run the pipeline.
struct combination {
  std::string partitioner;
  std::string mesher;
  std::string improver;
  std::string simplifier = "paper";

  /// Or a plain partition of the background mesh.
  bool is_simplified() const { return simplifier != "none"; }
  friend bool operator==(const combination&, const combination&) = default;
};

/// Angles at the interfaces between subdomains, in degrees; NaN where there are none.
struct interface_row {
  double min_face_angle = std::numeric_limits<double>::quiet_NaN();
  double min_dihedral = std::numeric_limits<double>::quiet_NaN();
  std::int64_t faces = 0;           ///< or edges, of dimension 2, which have no angles of their own
  std::int64_t under_threshold = 0; ///< faces and dihedrals
};

struct comparison_row {
  combination policies;
  std::string error;              ///< kind and text of what went wrong; the figures are void then
  bool background_reused = false; ///< made for an earlier row; its time is repeated here

  std::int64_t elements = 0;
  std::int64_t background_elements = 0;
  int subdomains = 0;
  double imbalance = 0; ///< largest subdomain over the average, in elements
  stage_seconds seconds;
  quality_statistics quality;
  interface_row coarse; ///< on the background mesh; its faces are the cut
  interface_row fine;   ///< on the finished mesh

  std::string mesh_hash; ///< hexadecimal, as `mesh` reports it

  bool failed() const { return !error.empty(); }
};

/// What is said of elements of a dimension, and from which angles on they are bad or low, in degrees.
struct element_words {
  const char* elements;
  const char* angle; ///< at which quality is measured
  int bad;
  int low;
  int best; ///< of a regular element, rounded up
};

inline element_words words_of(int dimension) {
  if (dimension == 3)
    return {"tetrahedra", "dihedral angle", limits_of(3).bad, limits_of(3).low, 71};
  return {"triangles", "angle", limits_of(2).bad, limits_of(2).low, 60};
}

/// Something that is said of a whole comparison.
struct known_fact {
  std::string key; ///< in the CSV's head
  std::string meaning;
  std::string text;
};

/// All rows, and what they have in common.
struct comparison {
  std::string model;
  std::vector<known_fact> origin; ///< by what command, when, from which files it was made
  int dimension = 3;              ///< of the elements
  int workers = 1;
  double angle_threshold = 30; ///< degrees
  std::vector<comparison_row> rows;
};

/// "metis + tetgen + none".
inline std::string name_of(const combination& policies) {
  return policies.partitioner + " + " + policies.mesher + " + " + policies.improver;
}

/// The same with the simplifier, where it is another than the paper's.
inline std::string full_name_of(const combination& policies) {
  return name_of(policies) + (policies.simplifier == "paper" ? "" : ", simplifier " + policies.simplifier);
}

} // namespace dovetail::app
