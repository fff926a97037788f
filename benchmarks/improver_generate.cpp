/// @file
/// Makes an input for `improver.cpp`: fills the closed surface of a Gmsh 2.2 ASCII mesh with tetrahedra by
/// TetGen (`pYqm`, the boundary kept, sizes graded from the surface's own edge lengths) and writes raw
/// arrays.
///
/// Usage: improver_generate SURFACE.msh OUT.raw
/// The raw file holds three int64 (points, elements, frozen points), the points (3 doubles each) and the
/// elements (4 int32 each). A benchmark tool, not part of the library.
#ifndef TETLIBRARY
#define TETLIBRARY
#endif
#include <tetgen.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iostream>
#include <map>
#include <string>
#include <vector>

namespace {

struct surface {
  std::vector<std::array<double, 3>> points;
  std::vector<std::array<int, 3>> triangles;
};

surface read_msh2(const char* path) {
  std::ifstream in(path);
  std::string line;
  surface s;
  std::map<long, int> index_of;
  std::map<long, std::array<double, 3>> nodes;
  while (in >> line) {
    if (line == "$Nodes") {
      std::size_t n = 0;
      in >> n;
      for (std::size_t i = 0; i < n; ++i) {
        long id = 0;
        std::array<double, 3> p{};
        in >> id >> p[0] >> p[1] >> p[2];
        nodes[id] = p;
      }
    } else if (line == "$Elements") {
      std::size_t n = 0;
      in >> n;
      for (std::size_t i = 0; i < n; ++i) {
        long id = 0;
        int type = 0, tags = 0;
        in >> id >> type >> tags;
        for (int k = 0, t = 0; k < tags; ++k)
          in >> t;
        const int count = type == 15 ? 1 : type == 1 ? 2 : 3;
        std::array<long, 3> v{};
        for (int k = 0; k < count; ++k)
          in >> v[static_cast<std::size_t>(k)];
        if (type != 2)
          continue;
        std::array<int, 3> triangle{};
        for (std::size_t k = 0; k < 3; ++k) {
          const auto [it, is_new] = index_of.try_emplace(v[k], static_cast<int>(s.points.size()));
          if (is_new)
            s.points.push_back(nodes.at(v[k]));
          triangle[k] = it->second;
        }
        s.triangles.push_back(triangle);
      }
    }
  }
  return s;
}

/// The mean length of the edges at each point, TetGen's target size there.
std::vector<double> sizes_of(const surface& s) {
  std::vector<double> sum(s.points.size(), 0.0), count(s.points.size(), 0.0);
  for (const auto& t : s.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = static_cast<std::size_t>(t[k]), b = static_cast<std::size_t>(t[(k + 1) % 3]);
      const auto &p = s.points[a], &q = s.points[b];
      const double length = std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
      for (const auto v : {a, b}) {
        sum[v] += length;
        count[v] += 1;
      }
    }
  for (std::size_t v = 0; v < sum.size(); ++v)
    sum[v] /= count[v];
  return sum;
}

void fill_with_tetrahedra(const surface& s, tetgenio& out) {
  tetgenio in;
  in.numberofpoints = static_cast<int>(s.points.size());
  in.pointlist = new double[3 * s.points.size()];
  in.numberofpointmtrs = 1;
  in.pointmtrlist = new double[s.points.size()];
  const auto sizes = sizes_of(s);
  for (std::size_t i = 0; i < s.points.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k)
      in.pointlist[3 * i + k] = s.points[i][k];
    in.pointmtrlist[i] = sizes[i];
  }
  in.numberoffacets = static_cast<int>(s.triangles.size());
  in.facetlist = new tetgenio::facet[s.triangles.size()];
  for (std::size_t i = 0; i < s.triangles.size(); ++i) {
    auto& facet = in.facetlist[i];
    tetgenio::init(&facet);
    facet.numberofpolygons = 1;
    facet.polygonlist = new tetgenio::polygon[1];
    tetgenio::init(facet.polygonlist);
    facet.polygonlist->numberofvertices = 3;
    facet.polygonlist->vertexlist = new int[3]{s.triangles[i][0], s.triangles[i][1], s.triangles[i][2]};
  }
  char switches[] = "pYqmQ";
  tetrahedralize(switches, &in, &out);
}

void write_raw(const char* path, const tetgenio& mesh, std::size_t frozen) {
  std::ofstream out(path, std::ios::binary);
  const std::int64_t header[3] = {mesh.numberofpoints, mesh.numberoftetrahedra,
                                  static_cast<std::int64_t>(frozen)};
  out.write(reinterpret_cast<const char*>(header), sizeof header);
  out.write(reinterpret_cast<const char*>(mesh.pointlist),
            static_cast<std::streamsize>(sizeof(double)) * 3 * mesh.numberofpoints);
  for (int t = 0; t < mesh.numberoftetrahedra; ++t) {
    const int* v = mesh.tetrahedronlist + 4 * t;
    const std::int32_t element[4] = {v[0], v[1], v[2], v[3]};
    out.write(reinterpret_cast<const char*>(element), sizeof element);
  }
}

} // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::cerr << "usage: improver_generate SURFACE.msh OUT.raw\n";
    return 2;
  }
  const auto s = read_msh2(argv[1]);
  tetgenio mesh;
  try {
    fill_with_tetrahedra(s, mesh);
  } catch (...) {
    std::cerr << "TetGen failed on " << argv[1] << '\n';
    return 1;
  }
  write_raw(argv[2], mesh, s.points.size());
  std::cout << s.triangles.size() << " triangles, " << mesh.numberoftetrahedra << " tetrahedra\n";
  return 0;
}
