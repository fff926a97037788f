/// @file
/// What one file of MFEM's parallel meshes says.
#pragma once

#include "dovetail/core/input_file.hpp"
#include "dovetail/mesh/loaded_mesh.hpp"
#include "dovetail/mesh/quadratic_element.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dovetail::io::detail {

/// Words and numbers; comments, which name attributes, are passed over.
class mfem_text {
public:
  mfem_text(std::string_view content, const std::string& name) : at_(content, name) {}

  std::string_view word() {
    skip();
    return at_.word();
  }
  void expect(std::string_view word_of) {
    if (const auto found = word(); found != word_of)
      fail("'" + std::string(word_of) + "' is expected" +
           (found.empty() ? ", but the file ends" : ", not '" + std::string(found.substr(0, 40)) + "'"));
  }
  template <class Number>
  Number number() {
    skip();
    return at_.number<Number>();
  }
  /// A count of lines of so many bytes at least.
  std::size_t count(std::size_t bytes_each) {
    const auto announced = number<std::int64_t>();
    if (announced < 0 || announced > std::numeric_limits<local_id>::max())
      fail("the count " + std::to_string(announced) + " is out of range");
    return at_.plausible(static_cast<std::uint64_t>(announced), bytes_each);
  }
  std::size_t count(std::string_view word_of, std::size_t bytes_each) {
    expect(word_of);
    return count(bytes_each);
  }
  /// A number below an end.
  local_id index(std::size_t end, const char* of_what) {
    const auto value = number<std::int64_t>();
    if (value < 0 || static_cast<std::uint64_t>(value) >= end)
      fail("there is no " + std::string(of_what) + " " + std::to_string(value) + ", only " +
           std::to_string(end));
    return static_cast<local_id>(value);
  }
  [[noreturn]] void fail(const std::string& what) const { at_.fail(what); }

  std::vector<std::pair<local_id, std::string>> element_names, boundary_names; ///< from comments

private:
  void skip() {
    for (at_.skip_space(); !at_.at_end() && at_.rest().front() == '#'; at_.skip_space())
      note(at_.line());
  }
  /// "# element attribute 1: name"
  void note(std::string_view line) {
    for (auto [begin, names] : {std::pair{"# element attribute ", &element_names},
                                std::pair{"# boundary attribute ", &boundary_names}})
      if (line.starts_with(begin)) {
        const auto colon = std::min(line.find(": "), line.size());
        names->emplace_back(static_cast<local_id>(names->size()),
                            line.substr(std::min(colon + 2, line.size())));
      }
  }

  file_cursor at_;
};

/// What some ranks share.
struct mfem_shared {
  std::vector<local_id> ranks;
  std::vector<local_id> vertices;
  std::vector<simplex<1>> edges;
  std::vector<simplex<2>> faces;
};

/// What a rank's file has; vertices by its own numbers.
struct mfem_part {
  loaded_mesh piece;
  std::vector<simplex<1>> edges{}; ///< of second order: each once, as an `edge_table` has them
  std::vector<local_id> middles{}; ///< the point in the middle of each
  std::vector<mfem_shared> groups{};
};

inline local_id mfem_attribute(mfem_text& text, const std::vector<std::pair<local_id, std::string>>& names) {
  const auto attribute = text.number<std::int64_t>();
  const auto most = names.empty() ? std::int64_t{std::numeric_limits<local_id>::max()}
                                  : static_cast<std::int64_t>(names.size());
  if (attribute < 1 || attribute > most)
    text.fail("the attribute " + std::to_string(attribute) + " is not from 1 to " + std::to_string(most));
  return static_cast<local_id>(attribute - 1);
}

template <std::size_t N>
std::array<local_id, N> mfem_vertices(mfem_text& text, std::size_t end) {
  std::array<local_id, N> vertices;
  for (local_id& v : vertices)
    v = text.index(end, "vertex");
  return vertices;
}

inline void expect_mfem_kind(mfem_text& text, int kind, const char* name) {
  if (const auto found = text.number<int>(); found != kind)
    text.fail("an element of type " + std::to_string(found) + "; only " + name + ", type " +
              std::to_string(kind) + ", are read");
}

/// Refuses elements or boundary elements with vertices that are not there.
template <class Simplices>
void check_mfem_vertices(const mfem_text& text, const Simplices& simplices, std::size_t vertices,
                         const std::string& of_what) {
  for (std::size_t i = 0; i < simplices.size(); ++i)
    for (const local_id v : simplices[i])
      if (static_cast<std::size_t>(v) >= vertices)
        text.fail(of_what + " " + std::to_string(i) + " has the vertex " + std::to_string(v) +
                  ", and there are " + std::to_string(vertices));
}

/// The head of the nodes of second order.
inline void expect_mfem_nodes(mfem_text& text) {
  for (const char* word :
       {"FiniteElementSpace", "FiniteElementCollection:", "H1_3D_P2", "VDim:", "3", "Ordering:", "1"})
    text.expect(word);
}

/// Numbers the middles of edges as MFEM does: behind the vertices, as they come in the elements.
inline void number_mfem_middles(mfem_part& part, std::size_t vertices) {
  auto table = build_edges<3>(span_of(part.piece.mesh.elements), vertices);
  part.middles.assign(table.vertices.size(), no_id);
  auto next = static_cast<local_id>(vertices);
  for (const auto& edges : table.of_element)
    for (const std::size_t k : {0u, 2u, 3u, 1u, 4u, 5u}) // MFEM's: 01, 02, 03, 12, 13, 23
      if (local_id& middle = part.middles[edges[k]]; middle == no_id)
        middle = next++;
  for (const auto& edges : table.of_element)
    std::transform(edges.begin(), edges.end(), part.piece.middles.emplace_back().begin(),
                   [&](local_id edge) { return part.middles[edge]; });
  part.edges = std::move(table.vertices);
}

/// Elements, boundary and vertices.
inline void read_mfem_mesh(mfem_text& text, mfem_part& part, element_order of_elements) {
  loaded_mesh& piece = part.piece;
  text.expect("dimension");
  if (const auto dimension = text.number<int>(); dimension != 3)
    text.fail("a mesh of dimension " + std::to_string(dimension) + "; only tetrahedra are read");
  constexpr auto any = static_cast<std::size_t>(std::numeric_limits<local_id>::max());
  const auto elements = text.count("elements", 12);
  for (std::size_t e = 0; e < elements; ++e) {
    piece.mesh.tags.push_back(mfem_attribute(text, text.element_names));
    expect_mfem_kind(text, 4, "tetrahedra");
    piece.mesh.elements.push_back(mfem_vertices<4>(text, any));
  }
  const auto sides = text.count("boundary", 10);
  for (std::size_t s = 0; s < sides; ++s) {
    piece.triangle_tags.push_back(mfem_attribute(text, text.boundary_names));
    expect_mfem_kind(text, 2, "triangles");
    piece.triangles.push_back(mfem_vertices<3>(text, any));
  }
  const auto vertices = text.count("vertices", 5);
  const auto next = text.word();
  const bool quadratic = next == "nodes";
  if (quadratic && of_elements == element_order::first)
    text.fail("nodes of second order are not read; write the mesh without --order 2 to read it");
  if (!quadratic && next != "3")
    text.fail("vertices have three coordinates, not '" + std::string(next.substr(0, 40)) + "'");
  check_mfem_vertices(text, piece.mesh.elements, vertices, "element");
  check_mfem_vertices(text, piece.triangles, vertices, "boundary element");
  if (quadratic) {
    expect_mfem_nodes(text);
    number_mfem_middles(part, vertices);
  }
  for (std::size_t v = 0; v < vertices + part.middles.size(); ++v) {
    vec3 p;
    for (int axis = 0; axis < 3; ++axis) {
      p[axis] = text.number<double>();
      if (!std::isfinite(p[axis]))
        text.fail("a coordinate of vertex " + std::to_string(v) + " is not finite");
    }
    piece.mesh.points.push_back(p);
  }
  piece.material_names = text.element_names;
  piece.triangle_names = text.boundary_names;
}

/// The ranks of the groups, the first of which has this rank alone.
inline std::vector<mfem_shared> read_mfem_ranks(mfem_text& text, local_id rank, std::size_t of) {
  text.expect("communication_groups");
  const auto count = text.count("number_of_groups", 3);
  std::vector<mfem_shared> groups;
  for (std::size_t g = 0; g < count; ++g) {
    mfem_shared group;
    const auto ranks = text.count(2);
    for (std::size_t r = 0; r < ranks; ++r) {
      const auto other = text.number<std::int64_t>();
      if (other < 0 || static_cast<std::uint64_t>(other) >= of)
        text.fail("group " + std::to_string(g) + " has rank " + std::to_string(other) + ", and there are " +
                  std::to_string(of) + " files; copy those of all ranks into this folder");
      group.ranks.push_back(static_cast<local_id>(other));
    }
    if (g == 0 ? group.ranks != std::vector{rank}
               : ranks < 2 || std::adjacent_find(group.ranks.begin(), group.ranks.end(),
                                                 [](auto a, auto b) { return a >= b; }) != group.ranks.end())
      text.fail("group " + std::to_string(g) +
                (g == 0 ? " is not rank " + std::to_string(rank) + " alone"
                        : " has not two or more ranks in growing order"));
    if (!std::binary_search(group.ranks.begin(), group.ranks.end(), rank))
      text.fail("group " + std::to_string(g) + " does not have rank " + std::to_string(rank));
    groups.push_back(std::move(group));
  }
  if (groups.empty())
    text.fail("group 0, that of the rank alone, is missing");
  return groups;
}

inline std::vector<mfem_shared> read_mfem_groups(mfem_text& text, local_id rank, std::size_t of,
                                                 std::size_t vertices) {
  auto groups = read_mfem_ranks(text, rank, of);
  std::array<std::size_t, 3> left{};
  const std::array<std::string_view, 3> names{"vertices", "edges", "faces"};
  for (std::size_t k = 0; k < 3; ++k)
    left[k] = text.count("total_shared_" + std::string(names[k]), 2);
  const auto begin = [&](std::size_t kind, std::size_t bytes_each) {
    const auto count = text.count("shared_" + std::string(names[kind]), bytes_each);
    if (count > left[kind])
      text.fail("more " + std::string(names[kind]) + " are shared than the total says");
    left[kind] -= count;
    return count;
  };
  for (std::size_t g = 1; g < groups.size(); ++g) {
    for (auto count = begin(0, 2); count > 0; --count)
      groups[g].vertices.push_back(text.index(vertices, "vertex"));
    for (auto count = begin(1, 4); count > 0; --count)
      groups[g].edges.push_back(mfem_vertices<2>(text, vertices));
    for (auto count = begin(2, 8); count > 0; --count) {
      expect_mfem_kind(text, 2, "triangles");
      groups[g].faces.push_back(mfem_vertices<3>(text, vertices));
    }
  }
  for (std::size_t k = 0; k < 3; ++k)
    if (left[k] > 0)
      text.fail("fewer " + std::string(names[k]) + " are shared than the total says");
  groups.erase(groups.begin());
  return groups;
}

inline mfem_part read_mfem_part(const std::filesystem::path& file, local_id rank, std::size_t of,
                                element_order elements) {
  const std::string content = read_file(file);
  mfem_text text(content, file.string());
  const auto kind = text.word();
  if (kind != "MFEM" || text.word() != "mesh" || text.word() != "v1.2")
    text.fail(
        "it does not begin with 'MFEM mesh v1.2', a parallel mesh of conforming elements; write it with "
        "--format mfem");
  mfem_part part;
  read_mfem_mesh(text, part, elements);
  text.expect("mfem_serial_mesh_end");
  part.groups = read_mfem_groups(text, rank, of, part.piece.mesh.points.size() - part.middles.size());
  text.expect("mfem_mesh_end");
  part.piece.parts = static_cast<local_id>(of);
  part.piece.parts_here = 1;
  part.piece.first_part = rank;
  return part;
}

} // namespace dovetail::io::detail
