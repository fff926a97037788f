/// @file
/// Consistent orientation of triangulated surfaces, shell by shell.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/mesh/adjacency.hpp"
#include "dovetail/models/discrete/crossings.hpp"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::discrete {

/// The connected parts of a surface.
struct oriented_shells {
  std::vector<local_id> shell_of; ///< per triangle
  std::vector<bool> is_sheet;     ///< per shell: it is open
  std::size_t turned = 0;         ///< triangles that had to be turned

  local_id count() const { return static_cast<local_id>(is_sheet.size()); } ///< how many shells there are
};

/// One use of `oriented`.
class shell_orienter {
public:
  shell_orienter(simplicial_mesh<2>& mesh, const std::string& name) : mesh_(mesh), name_(name) {}

  /// Orients shell after shell.
  oriented_shells run() {
    const auto sides = build_sides<2>(mesh_);
    const std::size_t n = triangles().size();
    made_.shell_of.assign(n, no_id);
    std::vector<std::size_t> shell;
    for (std::size_t seed = 0; seed < n; ++seed) {
      if (made_.shell_of[seed] != no_id)
        continue;
      made_.is_sheet.push_back(false);
      made_.shell_of[seed] = made_.count() - 1;
      shell.assign(1, seed);
      std::size_t turned = 0;
      for (std::size_t next = 0; next < shell.size(); ++next)
        turned += orient_neighbours(shell[next], sides, shell);
      if (made_.is_sheet.back() && 2 * turned > shell.size()) { // the seed was the odd one
        for (const std::size_t t : shell)
          turn(t);
        turned = shell.size() - turned;
      }
      made_.turned += turned;
    }
    return std::move(made_);
  }

private:
  std::vector<simplex<2>>& triangles() { return mesh_.elements; }
  vec3 point(local_id v) { return mesh_.points[v]; }
  void turn(std::size_t t) { std::swap(triangles()[t][1], triangles()[t][2]); }

  /// Adds the neighbours of t that are in no shell yet to its own, turned like t; the result is how many had
  /// to be turned.
  std::size_t orient_neighbours(std::size_t t, const side_table<2>& sides, std::vector<std::size_t>& shell) {
    std::size_t turned = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const local_id across =
          sides.across(sides.of_element[t][side_of(sides, t, i)], static_cast<local_id>(t));
      if (across == no_id) {
        made_.is_sheet.back() = true;
        continue;
      }
      const auto next = static_cast<std::size_t>(across);
      const bool agrees = passes(next, triangles()[t][(i + 2) % 3], triangles()[t][(i + 1) % 3]);
      if (made_.shell_of[next] == no_id) {
        if (!agrees) {
          turn(next);
          ++turned;
        }
        made_.shell_of[next] = made_.shell_of[t];
        shell.push_back(next);
      } else if (!agrees) {
        throw geometry_error(name_ + ": the surface has one side only (as a Moebius strip) near " +
                             place(point(triangles()[t][i])) + "; it encloses no volume, cut it open");
      }
    }
    return turned;
  }

  /// The local side in `sides` of the edge opposite the present corner i of t (turning a triangle renumbers
  /// its corners).
  std::size_t side_of(const side_table<2>& sides, std::size_t t, std::size_t i) {
    const local_id v = triangles()[t][i];
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& ends = sides.vertices[sides.of_element[t][k]];
      if (ends[0] != v && ends[1] != v)
        return k;
    }
    return i;
  }

  bool passes(std::size_t t, local_id from, local_id to) {
    const auto& v = triangles()[t];
    return (v[0] == from && v[1] == to) || (v[1] == from && v[2] == to) || (v[2] == from && v[0] == to);
  }

  simplicial_mesh<2>& mesh_;
  const std::string& name_;
  oriented_shells made_;
};

/// Turns triangles until neighbours agree: in a closed shell with its first triangle, in a sheet with most of
/// its triangles. At most two triangles meet at an edge. Linear. Throws `geometry_error` naming `name` and a
/// place when a shell has one side only.
inline oriented_shells oriented(simplicial_mesh<2>& mesh, const std::string& name) {
  return shell_orienter(mesh, name).run();
}

} // namespace dovetail::discrete
