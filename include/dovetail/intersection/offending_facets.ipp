/// @file
/// What `offending_facets.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/output_file.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/intersection/crossing_triangles.hpp"
#include "dovetail/intersection/offending_facets.hpp"
#include "dovetail/mesh/simplex_grouping.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"
#include "dovetail/meshing/mesh_subdomains.hpp"
#include "dovetail/parallel/serial.hpp"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

DOVETAIL_INLINE std::vector<local_id> crossing_facets(const simplicial_mesh<2>& boundary) {
  const auto& triangles = boundary.elements;
  const auto same = [&](local_id a, local_id b) {
    return sorted_vertices(triangles[a]) == sorted_vertices(triangles[b]);
  };
  std::vector<local_id> crossing;
  for (const auto& [a, b] :
       crossing_triangles(span_of(boundary.points), span_of(triangles), same, parallel::serial{})) {
    crossing.push_back(a);
    crossing.push_back(b);
  }
  sort_unique(crossing);
  return crossing;
}

DOVETAIL_INLINE void write_facets(const simplicial_mesh<2>& boundary, const std::vector<local_id>& facets,
                                  const std::filesystem::path& path) {
  std::vector<local_id> number(boundary.points.size(), no_id);
  std::vector<vec3> points;
  for (const local_id t : facets)
    for (const local_id v : boundary.elements[t])
      if (local_id& n = number[v]; n == no_id) {
        n = static_cast<local_id>(points.size());
        points.push_back(boundary.points[v]);
      }
  output_file file(path);
  const auto row = [&](const auto&... numbers) {
    const char* separator = "";
    ((file.text(separator), file.number(numbers), separator = " "), ...);
    file.text("\n");
  };
  file.text("OFF\n");
  row(points.size(), facets.size(), 0);
  for (const vec3 p : points)
    row(p.x, p.y, p.z);
  for (const local_id t : facets) {
    const auto& triangle = boundary.elements[t];
    const auto n = [&](std::size_t k) { return number[triangle[k]]; };
    row(3, n(0), n(1), n(2));
  }
  file.commit();
}

DOVETAIL_INLINE std::size_t write_offending_facets(const simplicial_mesh<2>& boundary,
                                                   const std::filesystem::path& path) {
  std::vector<local_id> facets = crossing_facets(boundary);
  const std::size_t crossing = facets.size();
  if (facets.empty())
    for (std::size_t t = 0; t < boundary.elements.size(); ++t)
      facets.push_back(static_cast<local_id>(t));
  write_facets(boundary, facets, path);
  return crossing;
}

DOVETAIL_INLINE std::function<void(piece_failure&, const simplicial_mesh<2>&)>
write_facets_of_failures(std::filesystem::path folder) {
  if (folder.empty())
    return {};
  return [folder = std::move(folder)](piece_failure& failure, const simplicial_mesh<2>& boundary) {
    make_folder(folder);
    failure.facets = folder / ("failed_subdomain_" + std::to_string(failure.subdomain) + ".off");
    failure.crossing_facets = write_offending_facets(boundary, failure.facets);
  };
}

} // namespace dovetail
