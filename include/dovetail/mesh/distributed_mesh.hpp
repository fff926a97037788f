/// @file
/// The result of the pipeline: the fine skeleton, held once, and pieces that are loaded one at a time.
///
/// Global numbers follow from counts alone (one exclusive scan): point s of the skeleton has global id s;
/// inner point i of piece p has id skeleton.points.size() + (inner points of pieces before p) + i; element e
/// of piece p has id (elements of pieces before p) + e.
#pragma once

#include "dovetail/mesh/simplicial_mesh.hpp"

#include <functional>
#include <string>
#include <vector>

namespace dovetail {

/// The remeshed boundaries of all subdomains. A triangle is stored once, oriented outwards of
/// `subdomains[0]`; `subdomains[1]` is the subdomain on its other side, or no_id on the boundary of the
/// domain.
struct fine_skeleton {
  std::vector<vec3> points;
  std::vector<host>
      point_hosts; ///< the lowest-dimensional CAD entity of each point; {3, solid} on inner interfaces
  std::vector<simplex<2>> triangles;
  std::vector<std::array<local_id, 2>> subdomains;
  std::vector<local_id> cad_faces; ///< per triangle: its CAD face, or no_id on an interface inside a solid
  std::vector<std::array<local_id, 2>> curve_edges; ///< mesh edges on CAD curves
  std::vector<local_id> curves;                     ///< the CAD curve of each such edge
};

/// The mesh of one subdomain. Its first `skeleton_points.size()` points are skeleton points, the others its
/// own.
struct mesh_piece {
  local_id subdomain = no_id;
  local_id material = 0;
  simplicial_mesh<3> mesh;
  std::vector<local_id> skeleton_points; ///< index in the skeleton of each of the first points
};

/// A whole mesh without holding it: what writers, checks and statistics stream over.
struct distributed_mesh {
  fine_skeleton skeleton;

  /// Known without loading the piece.
  struct piece_counts {
    local_id material = 0;
    global_id inner_points = 0;
    global_id elements = 0;
  };
  std::vector<piece_counts> counts;
  std::function<mesh_piece(local_id)> load; ///< loads piece p; pure

  std::vector<std::string> material_names; ///< per material
  std::vector<std::string> face_names;     ///< per CAD face; may be empty strings
  std::vector<std::string> patch_names;    ///< per CAD face: the boundary patch it belongs to; may be empty
};

} // namespace dovetail
