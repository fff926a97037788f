/// @file
/// What `mfem_format.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/core/output_file.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/files/face_groups.hpp"
#include "dovetail/mesh/simplex_grouping.hpp"
#include "dovetail/solver/mfem_format.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::io {

namespace detail {

/// The vertices that a rank holds as MFEM numbers them: corners, and after these, of second order, the
/// middles of edges, which are numbered as they come in the elements.
class mfem_nodes {
public:
  explicit mfem_nodes(const rank_mesh<3>& rank) : numbers_(rank.held_vertices) {
    std::vector<bool> is_middle(rank.held_vertices, false);
    std::vector<local_id> middles;
    if (!rank.middles.empty())
      for (std::size_t e = 0; e < rank.owned_elements; ++e)
        for (const std::size_t edge : {0u, 2u, 3u, 1u, 4u, 5u}) // MFEM's: 01, 02, 03, 12, 13, 23
          if (const local_id v = rank.middles[e][edge]; !is_middle[v]) {
            is_middle[v] = true;
            middles.push_back(v);
          }
    for (std::size_t v = 0; v < rank.held_vertices; ++v)
      if (!is_middle[v])
        in_order_.push_back(static_cast<local_id>(v));
    corners_ = in_order_.size();
    append(in_order_, middles);
    for (std::size_t n = 0; n < in_order_.size(); ++n)
      numbers_[in_order_[n]] = static_cast<local_id>(n);
  }

  std::size_t corners() const { return corners_; }
  const std::vector<local_id>& in_order() const { return in_order_; }
  template <std::size_t N>
  std::array<local_id, N> operator()(std::array<local_id, N> vertices) const {
    for (local_id& v : vertices)
      v = numbers_[v];
    return vertices;
  }
  std::vector<local_id> corners_of(const std::vector<local_id>& vertices) const {
    std::vector<local_id> corners;
    for (const local_id v : vertices)
      if (const local_id number = numbers_[v]; static_cast<std::size_t>(number) < corners_)
        corners.push_back(number);
    return corners;
  }

private:
  std::vector<local_id> numbers_, in_order_;
  std::size_t corners_ = 0;
};

/// What the same ranks share, all in the order of the skeleton, which is that of the lists of neighbours.
struct mfem_group {
  std::vector<local_id> vertices;
  std::vector<simplex<1>> edges;
  std::vector<simplex<2>> faces; ///< each as the lower rank has it
};
using mfem_groups = std::map<std::vector<local_id>, mfem_group>; ///< by growing ranks

/// Puts what is in lists of neighbours, perhaps of several, into the group of all ranks that list it: once,
/// at its place in the first of these lists.
template <class T, class Lists>
void group_shared(const rank_mesh<3>& rank, mfem_groups& groups, const Lists& list_of,
                  std::vector<T> mfem_group::*members) {
  std::map<T, std::vector<local_id>> sharers;
  for (const auto& there : rank.neighbours)
    for (const T& shared : list_of(there))
      sharers[shared].push_back(there.rank);
  for (const auto& there : rank.neighbours)
    for (const T& shared : list_of(there))
      if (auto ranks = sharers.at(shared); ranks.front() == there.rank) {
        ranks.insert(std::upper_bound(ranks.begin(), ranks.end(), rank.rank), rank.rank);
        (groups[ranks].*members).push_back(shared);
      }
}

inline mfem_groups group_by_sharers(const rank_mesh<3>& rank, const mfem_nodes& nodes) {
  mfem_groups groups;
  group_shared<local_id>(
      rank, groups, [&](const auto& there) { return nodes.corners_of(there.vertices); },
      &mfem_group::vertices);
  group_shared<simplex<1>>(
      rank, groups,
      [&](const auto& there) {
        auto edges = there.edges;
        for (auto& edge : edges)
          edge = nodes(edge);
        return edges;
      },
      &mfem_group::edges);
  for (const auto& there : rank.neighbours)
    for (simplex<2> face : there.faces) {
      if (there.rank < rank.rank)
        std::swap(face[1], face[2]);
      groups[{std::min(rank.rank, there.rank), std::max(rank.rank, there.rank)}].faces.push_back(nodes(face));
    }
  return groups;
}

/// A file of MFEM: numbers and words in lines.
class mfem_file {
public:
  explicit mfem_file(const std::filesystem::path& path) : file_(path) {}

  void text(const std::string& line) { file_.text(line + "\n"); }
  template <class Numbers>
  void line(const Numbers& numbers) {
    bool first = true;
    for (const auto number : numbers) {
      if (!std::exchange(first, false))
        file_.text(" ");
      file_.number(number);
    }
    file_.text("\n");
  }
  void count(const std::string& of, std::size_t number) { text(of + " " + std::to_string(number)); }
  void names(const std::string& of, const std::vector<std::string>& names) {
    for (std::size_t n = 0; n < names.size(); ++n) {
      std::string name = names[n];
      std::replace(name.begin(), name.end(), '\n', ' ');
      text("# " + of + " attribute " + std::to_string(n + 1) + ": " + name);
    }
  }
  void commit() { file_.commit(); }

private:
  output_file file_;
};

/// Attribute, kind and vertices of the sides that are this rank's to list.
inline std::vector<std::array<local_id, 5>> mfem_boundary(const rank_mesh<3>& rank, const mfem_nodes& nodes,
                                                          const face_groups& groups) {
  std::vector<simplex<2>> of_lower; // sides that a lower rank lists
  for (const auto& there : rank.neighbours)
    if (there.rank < rank.rank)
      for (const auto& face : there.faces)
        of_lower.push_back(sorted_vertices(face));
  sort_all(of_lower);
  std::vector<std::array<local_id, 5>> boundary;
  for (std::size_t s = 0; s < rank.sides.size(); ++s)
    if (const auto& side = rank.sides[s];
        !std::binary_search(of_lower.begin(), of_lower.end(), sorted_vertices(side))) {
      const auto [a, b, c] = nodes(side);
      boundary.push_back({groups.of_face[rank.side_hosts[s]] + 1, 2, a, b, c});
    }
  return boundary;
}

inline void write_mfem_groups(mfem_file& file, local_id rank, const mfem_groups& groups) {
  std::size_t vertices = 0, edges = 0, faces = 0;
  file.text("\ncommunication_groups");
  file.count("number_of_groups", groups.size() + 1);
  file.text("\n# number of entities in each group, followed by ranks in group");
  file.line(std::array{local_id{1}, rank});
  for (const auto& [ranks, group] : groups) {
    std::vector<local_id> line{static_cast<local_id>(ranks.size())};
    append(line, ranks);
    file.line(line);
    vertices += group.vertices.size(), edges += group.edges.size(), faces += group.faces.size();
  }
  file.count("\ntotal_shared_vertices", vertices);
  file.count("total_shared_edges", edges);
  file.count("total_shared_faces", faces);
  file.text("\n# group 0 has no shared entities");
  std::size_t number = 0;
  for (const auto& [ranks, group] : groups) {
    file.count("\n# group", ++number);
    file.count("shared_vertices", group.vertices.size());
    for (const local_id v : group.vertices)
      file.line(std::array{v});
    file.count("\nshared_edges", group.edges.size());
    for (const auto& edge : group.edges)
      file.line(edge);
    file.count("\nshared_faces", group.faces.size());
    for (const auto& [a, b, c] : group.faces)
      file.line(std::array{local_id{2}, a, b, c});
  }
}

} // namespace detail

DOVETAIL_INLINE std::vector<std::string> mfem_format::files_of_rank(local_id rank) const {
  const std::string digits = std::to_string(rank);
  return {stem + "." + std::string(6 - std::min<std::size_t>(6, digits.size()), '0') + digits};
}

DOVETAIL_INLINE void mfem_format::write(const rank_source<3>& source, const rank_mesh<3>& rank,
                                        const std::vector<std::filesystem::path>& paths) const {
  const detail::mfem_nodes nodes(rank);
  const auto groups = collect_face_groups(source.mesh);
  const auto boundary = detail::mfem_boundary(rank, nodes, groups);
  detail::mfem_file file(paths.front());
  file.text("MFEM mesh v1.2\n");
  file.names("element", collect_material_names(source.mesh));
  file.names("boundary", groups.names);
  file.text("\ndimension\n3\n\nelements");
  file.line(std::array{rank.owned_elements});
  for (std::size_t e = 0; e < rank.owned_elements; ++e) {
    const auto [a, b, c, d] = nodes(rank.mesh.elements[e]);
    file.line(std::array{rank.mesh.tags[e] + 1, local_id{4}, a, b, c, d});
  }
  file.text("\nboundary");
  file.line(std::array{boundary.size()});
  for (const auto& side : boundary)
    file.line(side);
  file.text("\nvertices");
  file.line(std::array{nodes.corners()});
  file.text(source.mesh.mid_nodes ? "\nnodes\nFiniteElementSpace\nFiniteElementCollection: H1_3D_P2\n"
                                    "VDim: 3\nOrdering: 1\n"
                                  : "3");
  for (const local_id v : nodes.in_order()) {
    const vec3 p = rank.mesh.points[v];
    file.line(std::array{p.x, p.y, p.z});
  }
  file.text("\nmfem_serial_mesh_end");
  detail::write_mfem_groups(file, rank.rank, detail::group_by_sharers(rank, nodes));
  file.text("\nmfem_mesh_end");
  file.commit();
}

} // namespace dovetail::io
