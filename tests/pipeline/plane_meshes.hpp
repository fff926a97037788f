/// @file
/// Runs of the pipeline for D = 2 and what every result of it must satisfy.
#pragma once

#include "dovetail/mesh/distributed_validity.hpp"
#include "dovetail/mesh/mesh_hash.hpp"
#include "dovetail/models/plane_domain.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/sizing/uniform.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

namespace dovetail::testing {

inline generate_options in_parts(int subdomains) {
  generate_options options;
  options.subdomains = subdomains;
  return options;
}

inline constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

inline plane_domain unit_square() {
  plane_drawing drawing;
  drawing.polygons = {{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, "square"}};
  return plane_domain(drawing);
}

/// The whole mesh on global point numbers.
struct whole_mesh {
  std::map<global_id, vec3> points;
  std::vector<std::array<global_id, 3>> triangles;
  std::vector<local_id> faces;
};

inline whole_mesh whole(const distributed_simplicial_mesh<2>& mesh) {
  const auto numbers = io::number_globally(mesh);
  whole_mesh all;
  for (std::size_t p = 0; p < mesh.counts.size(); ++p) {
    const auto piece = io::load_checked(mesh, static_cast<local_id>(p));
    for (std::size_t e = 0; e < piece.mesh.elements.size(); ++e) {
      std::array<global_id, 3> triangle{};
      for (std::size_t k = 0; k < 3; ++k) {
        const local_id v = piece.mesh.elements[e][k];
        triangle[k] = io::global_point(piece, numbers, v);
        all.points[triangle[k]] = piece.mesh.points[v];
      }
      all.triangles.push_back(triangle);
      all.faces.push_back(piece.mesh.tags[e]);
    }
  }
  return all;
}

inline double area_of(const whole_mesh& mesh) {
  double area = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    area += 0.5 * norm(cross(mesh.points.at(b) - mesh.points.at(a), mesh.points.at(c) - mesh.points.at(a)));
  return area;
}

/// How many triangles pass each directed edge.
inline std::map<std::array<global_id, 2>, int> passages(const whole_mesh& mesh) {
  std::map<std::array<global_id, 2>, int> count;
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      ++count[{t[k], t[(k + 1) % 3]}];
  return count;
}

/// Vertices - edges + triangles.
inline std::int64_t euler_characteristic(const whole_mesh& mesh) {
  std::set<std::array<global_id, 2>> edges;
  for (const auto& [edge, count] : passages(mesh))
    edges.insert({std::min(edge[0], edge[1]), std::max(edge[0], edge[1])});
  return static_cast<std::int64_t>(mesh.points.size()) - static_cast<std::int64_t>(edges.size()) +
         static_cast<std::int64_t>(mesh.triangles.size());
}

/// Every directed edge is passed once: the mesh conforms and is oriented.
inline void require_conforming(const whole_mesh& mesh) {
  for (const auto& [edge, count] : passages(mesh))
    REQUIRE(count == 1);
}

inline whole_mesh require_valid(const generated<2>& result) {
  REQUIRE(result.failures.empty());
  CHECK(result.quality.elements > 0);
  const auto validity = io::check_distributed(result.mesh);
  CHECK_MESSAGE(validity.valid(), validity.text());
  auto mesh = whole(result.mesh);
  require_conforming(mesh);
  return mesh;
}

} // namespace dovetail::testing
