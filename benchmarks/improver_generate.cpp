/// @file
/// Makes an input for `improver.cpp`, raw arrays, from a mesh file:
///   improver_generate fill SURFACE OUT.raw   fills a closed surface with tetrahedra by TetGen
///   improver_generate copy VOLUME OUT.raw    takes the tetrahedra as they are
/// SURFACE and VOLUME are MSH or VTU files. The surface consists of the file's triangles or, when it has
/// tetrahedra, of their boundary. TetGen is run as its users run it, `pYqm`: the surface kept, sizes graded
/// from the surface's own edge lengths. Inner shells bound voids.
///
/// The raw file holds three int64 (points, elements, frozen points), the points (3 doubles each) and the
/// elements (4 int32 each). A benchmark tool, not part of the library.
#include "dovetail/adapters/tetgen_library.hpp"
#include "dovetail/files/read_mesh.hpp"
#include "dovetail/improver/tetrahedra/tet_adjacency.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

namespace {

using namespace dovetail;
using improvement::match_sides;
using improvement::sorted_side;

/// The boundary of the tetrahedra if there are any, else the file's triangles; on points of their own.
simplicial_mesh<2> surface_of(const io::loaded_mesh& file) {
  simplicial_mesh<2> surface;
  surface.elements = file.triangles;
  if (!file.mesh.elements.empty()) {
    surface.elements.clear();
    const auto across = match_sides(file.mesh.elements, file.mesh.points.size());
    for (std::size_t e = 0; e < across.size(); ++e)
      for (std::size_t side = 0; side < 4; ++side)
        if (across[e][side] == no_id)
          surface.elements.push_back(sorted_side(file.mesh.elements[e], static_cast<int>(side)));
  }
  std::vector<local_id> place(file.mesh.points.size(), no_id);
  for (auto& triangle : surface.elements)
    for (auto& v : triangle) {
      auto& own = place[v];
      if (own == no_id) {
        own = static_cast<local_id>(surface.points.size());
        surface.points.push_back(file.mesh.points[v]);
      }
      v = own;
    }
  return surface;
}

/// The mean length of the edges at each point, TetGen's target size there.
std::vector<double> sizes_of(const simplicial_mesh<2>& surface) {
  std::vector<double> sum(surface.points.size(), 0.0), count(surface.points.size(), 0.0);
  for (const auto& t : surface.elements)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = static_cast<std::size_t>(t[k]), b = static_cast<std::size_t>(t[(k + 1) % 3]);
      for (const auto v : {a, b}) {
        sum[v] += distance(surface.points[a], surface.points[b]);
        count[v] += 1;
      }
    }
  for (std::size_t v = 0; v < sum.size(); ++v)
    sum[v] /= count[v];
  return sum;
}

/// Everything inside the outermost shell, voids too.
simplicial_mesh<3> fill_hull(const simplicial_mesh<2>& surface) {
  tetgenio in, out;
  in.numberofpoints = static_cast<int>(surface.points.size());
  in.pointlist = new double[3 * surface.points.size()];
  in.numberofpointmtrs = 1;
  in.pointmtrlist = new double[surface.points.size()];
  const auto sizes = sizes_of(surface);
  for (std::size_t i = 0; i < surface.points.size(); ++i) {
    for (int k = 0; k < 3; ++k)
      in.pointlist[3 * i + static_cast<std::size_t>(k)] = surface.points[i][k];
    in.pointmtrlist[i] = sizes[i];
  }
  in.numberoffacets = static_cast<int>(surface.elements.size());
  in.facetlist = new tetgenio::facet[surface.elements.size()];
  for (std::size_t i = 0; i < surface.elements.size(); ++i) {
    auto& facet = in.facetlist[i];
    tetgenio::init(&facet);
    facet.numberofpolygons = 1;
    facet.polygonlist = new tetgenio::polygon[1];
    tetgenio::init(facet.polygonlist);
    const auto& t = surface.elements[i];
    facet.polygonlist->numberofvertices = 3;
    facet.polygonlist->vertexlist = new int[3]{t[0], t[1], t[2]};
  }
  char switches[] = "pYqmQ";
  detail::tetgen_entry()(switches, &in, &out, nullptr, nullptr);
  simplicial_mesh<3> mesh;
  for (int v = 0; v < out.numberofpoints; ++v)
    mesh.points.push_back({out.pointlist[3 * v], out.pointlist[3 * v + 1], out.pointlist[3 * v + 2]});
  for (int e = 0; e < out.numberoftetrahedra; ++e) {
    const int* v = out.tetrahedronlist + 4 * e;
    mesh.elements.push_back({v[0], v[1], v[2], v[3]});
  }
  return mesh;
}

/// Keeps the elements that are reached from outside through an odd number of shells.
void empty_voids(simplicial_mesh<3>& mesh, const simplicial_mesh<2>& surface) {
  auto walls = surface.elements;
  for (auto& wall : walls)
    std::sort(wall.begin(), wall.end());
  std::sort(walls.begin(), walls.end());
  const auto across = match_sides(mesh.elements, mesh.points.size());
  std::vector<int> shells(mesh.elements.size(), 0); // passed on the way from outside; 0: not reached yet
  std::vector<local_id> reached;
  for (std::size_t e = 0; e < shells.size(); ++e)
    if (std::count(across[e].begin(), across[e].end(), no_id) > 0) {
      shells[e] = 1;
      reached.push_back(static_cast<local_id>(e));
    }
  // Elements behind a wall wait until all that is before it is done.
  for (int depth = 1; !reached.empty(); ++depth) {
    std::vector<local_id> behind;
    while (!reached.empty()) {
      const local_id e = reached.back();
      reached.pop_back();
      for (int side = 0; side < 4; ++side) {
        const auto half = across[e][side];
        if (half == no_id || shells[improvement::element_of(half)] != 0)
          continue;
        const local_id other = improvement::element_of(half);
        const auto key = sorted_side(mesh.elements[e], side);
        if (std::binary_search(walls.begin(), walls.end(), key)) {
          behind.push_back(other);
        } else {
          shells[other] = depth;
          reached.push_back(other);
        }
      }
    }
    for (const local_id e : behind)
      if (shells[e] == 0) {
        shells[e] = depth + 1;
        reached.push_back(e);
      }
  }
  std::size_t kept = 0;
  for (std::size_t e = 0; e < shells.size(); ++e)
    if (shells[e] % 2 == 1)
      mesh.elements[kept++] = mesh.elements[e];
  mesh.elements.resize(kept);
}

/// Leaves out points after the first `kept` that no element uses.
void drop_unused_points(simplicial_mesh<3>& mesh, std::size_t kept) {
  std::vector<local_id> place(mesh.points.size(), no_id);
  for (const auto& element : mesh.elements)
    for (const local_id v : element)
      place[v] = 0;
  std::size_t used = 0;
  for (std::size_t v = 0; v < place.size(); ++v)
    if (v < kept || place[v] != no_id) {
      mesh.points[used] = mesh.points[v];
      place[v] = static_cast<local_id>(used++);
    }
  mesh.points.resize(used);
  for (auto& element : mesh.elements)
    for (auto& v : element)
      v = place[v];
}

void write_raw(const char* path, const simplicial_mesh<3>& mesh, std::size_t frozen) {
  std::ofstream out(path, std::ios::binary);
  const std::int64_t header[3] = {static_cast<std::int64_t>(mesh.points.size()),
                                  static_cast<std::int64_t>(mesh.elements.size()),
                                  static_cast<std::int64_t>(frozen)};
  out.write(reinterpret_cast<const char*>(header), sizeof header);
  out.write(reinterpret_cast<const char*>(mesh.points.data()),
            static_cast<std::streamsize>(mesh.points.size() * sizeof(vec3)));
  out.write(reinterpret_cast<const char*>(mesh.elements.data()),
            static_cast<std::streamsize>(mesh.elements.size() * sizeof(simplex<3>)));
}

} // namespace

int main(int argc, char** argv) try {
  const std::string what = argc == 4 ? argv[1] : "";
  if (what != "fill" && what != "copy") {
    std::cerr << "usage: improver_generate fill|copy MESH OUT.raw\n";
    return 2;
  }
  const auto file = io::read_mesh(argv[2]);
  if (what == "copy") {
    write_raw(argv[3], file.mesh, 0);
    std::cout << file.mesh.elements.size() << " tetrahedra\n";
    return 0;
  }
  const auto surface = surface_of(file);
  auto mesh = fill_hull(surface);
  empty_voids(mesh, surface);
  drop_unused_points(mesh, surface.points.size());
  write_raw(argv[3], mesh, surface.points.size());
  std::cout << surface.elements.size() << " triangles, " << mesh.elements.size() << " tetrahedra\n";
} catch (const dovetail::error& problem) {
  std::cerr << problem.what() << '\n';
  return 1;
} catch (...) {
  std::cerr << "TetGen failed on " << argv[2] << '\n';
  return 1;
}
