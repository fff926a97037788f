/// @file
/// Meshes of triangles as MSH 4.1: a surface entity per CAD face, a curve entity per CAD curve.
#pragma once

#include "dovetail/core/report.hpp"
#include "dovetail/io/global_numbering.hpp"
#include "dovetail/io/msh_encoder.hpp"
#include "dovetail/mesh/simplex_grouping.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace dovetail::io {

/// Writes `<stem>.msh`, binary. Physical groups are the CAD faces and curves, by name where they have one;
/// node and element numbers are the global ones plus 1, those of curve elements follow.
struct msh_surface_writer {
  std::string stem = "mesh";
  bool release =
      false; ///< gives up each piece when it is read for the last time; a resumed run makes it again

  /// Loads every piece three times. Memory: the skeleton and one loaded piece.
  report operator()(const distributed_simplicial_mesh<2>& mesh, const std::filesystem::path& folder) const {
    const stopwatch clock;
    make_folder(folder);
    const auto numbers = number_globally(mesh);
    output_batch files;
    output_file& file = files.open(folder / (stem + ".msh"));
    msh_encoder out(file, true);
    const auto blocks = count_blocks(mesh);
    write_entities(file, out, mesh, blocks);
    write_nodes(out, mesh, numbers, blocks.front().face);
    write_elements(out, mesh, numbers, blocks);
    files.commit();
    report summary{"msh", clock.seconds(), {}, {}, {}, {stem + ".msh"}};
    summary.set("elements", static_cast<double>(numbers.elements()));
    summary.set("bytes", static_cast<double>(files.size()));
    return summary;
  }

private:
  /// The triangles of a piece on one CAD face.
  struct block {
    local_id piece;
    local_id face;
    std::uint64_t triangles;
  };

  static std::vector<block> count_blocks(const distributed_simplicial_mesh<2>& mesh) {
    std::vector<block> blocks;
    for (std::size_t p = 0; p < mesh.counts.size(); ++p) {
      std::map<local_id, std::uint64_t> of_face;
      const auto piece = load_checked(mesh, static_cast<local_id>(p));
      for (const local_id face : piece.mesh.tags)
        ++of_face[face];
      for (const auto& [face, triangles] : of_face)
        blocks.push_back({piece.subdomain, face, triangles});
    }
    if (blocks.empty())
      throw mesh_error("there are no triangles to write");
    return blocks;
  }

  /// Each CAD edge once; several records stand for a line of other than two triangles.
  static std::vector<std::array<local_id, 3>> curve_edges(const simplicial_skeleton<2>& skeleton) {
    std::vector<std::array<local_id, 3>> edges; // curve, from, to
    for (std::size_t e = 0; e < skeleton.sides.size(); ++e)
      if (skeleton.side_hosts[e] != no_id) {
        const auto ends = sorted_vertices(skeleton.sides[e]);
        edges.push_back({skeleton.side_hosts[e], ends[0], ends[1]});
      }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
  }

  static void write_entities(output_file& file, msh_encoder& out, const distributed_simplicial_mesh<2>& mesh,
                             const std::vector<block>& blocks) {
    std::set<local_id> faces, curves;
    for (const block& b : blocks)
      faces.insert(b.face);
    for (const auto& edge : curve_edges(mesh.skeleton))
      curves.insert(edge[0]);
    std::vector<physical_name> names;
    for (const local_id f : faces) {
      const auto at = static_cast<std::size_t>(f);
      const bool named = at < mesh.face_names.size() && !mesh.face_names[at].empty();
      names.push_back({2, f + 1, named ? mesh.face_names[at] : "face " + std::to_string(f + 1)});
    }
    write_physical_names(file, names);
    box3 box;
    for (const vec3 p : mesh.skeleton.points)
      box.include(p);
    const auto entity = [&](local_id tag, bool physical) {
      out.integer(tag);
      out.point(box.lower), out.point(box.upper);
      out.count(physical ? 1 : 0);
      if (physical)
        out.integer(tag);
      out.count(0); // of bounding entities
      out.line();
    };
    out.begin("Entities");
    out.count(0), out.count(curves.size()), out.count(faces.size()), out.count(0);
    out.line();
    for (const local_id c : curves)
      entity(c + 1, false);
    for (const local_id f : faces)
      entity(f + 1, true);
    out.end("Entities");
  }

  static void write_nodes(msh_encoder& out, const distributed_simplicial_mesh<2>& mesh,
                          const global_numbering& numbers, local_id face) {
    const auto points = static_cast<std::uint64_t>(numbers.points());
    out.begin("Nodes");
    out.count(1), out.count(points), out.count(1), out.count(points);
    out.integer(2), out.integer(face + 1), out.integer(0), out.count(points);
    for (std::uint64_t id = 1; id <= points; ++id)
      out.count(id);
    for (const vec3 p : mesh.skeleton.points)
      out.point(p);
    for (std::size_t p = 0; p < mesh.counts.size(); ++p) {
      const auto piece = mesh.load(static_cast<local_id>(p));
      for (std::size_t i = piece.skeleton_points.size(); i < piece.mesh.points.size(); ++i)
        out.point(piece.mesh.points[i]);
    }
    out.end("Nodes");
  }

  void write_elements(msh_encoder& out, const distributed_simplicial_mesh<2>& mesh,
                      const global_numbering& numbers, const std::vector<block>& blocks) const {
    const auto edges = curve_edges(mesh.skeleton);
    const auto triangles = static_cast<std::uint64_t>(numbers.elements());
    std::size_t curve_blocks = 0;
    for (std::size_t e = 0; e < edges.size(); ++e)
      curve_blocks += e == 0 || edges[e][0] != edges[e - 1][0] ? 1 : 0;
    out.begin("Elements");
    out.count(blocks.size() + curve_blocks), out.count(triangles + edges.size()), out.count(1),
        out.count(triangles + edges.size());
    std::uint64_t id = 0;
    simplicial_piece<2> piece;
    for (const block& b : blocks) {
      if (piece.subdomain != b.piece) {
        piece = mesh.load(b.piece);
        if (release && mesh.release)
          mesh.release(b.piece, {});
      }
      out.integer(2), out.integer(b.face + 1), out.integer(static_cast<int>(msh_type::triangle)),
          out.count(b.triangles);
      for (std::size_t e = 0; e < piece.mesh.elements.size(); ++e)
        if (piece.mesh.tags[e] == b.face) {
          out.count(++id);
          for (const local_id v : piece.mesh.elements[e])
            out.count(static_cast<std::uint64_t>(global_point(piece, numbers, v)) + 1);
        }
    }
    for (std::size_t first = 0, last; first < edges.size(); first = last) {
      for (last = first + 1; last < edges.size() && edges[last][0] == edges[first][0];)
        ++last;
      out.integer(1), out.integer(edges[first][0] + 1), out.integer(static_cast<int>(msh_type::line)),
          out.count(last - first);
      for (std::size_t e = first; e < last; ++e) {
        out.count(++id);
        out.count(static_cast<std::uint64_t>(edges[e][1]) + 1);
        out.count(static_cast<std::uint64_t>(edges[e][2]) + 1);
      }
    }
    out.end("Elements");
  }
};

} // namespace dovetail::io
