/// @file
/// How fast and how well the surface remesher works: on a plane and on the faces of CAD files.
///
/// Usage: remesh_benchmark SIZE_FRACTION [FILE...]: edges are the model's diagonal divided by SIZE_FRACTION.
#include "dovetail/background/coarse_surface.hpp"
#include "dovetail/models/occt_model.hpp"
#include "dovetail/parallel/serial.hpp"
#include "dovetail/remesh/patch_remesher.hpp"

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>

namespace {

using namespace dovetail;

/// Processor time: other programs on the machine do not count.
double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

void print(const std::string& name, const report& r, double seconds) {
  std::printf("%-40s %9.0f triangles %8.2f s %9.0f triangles/s  min %5.2f  mean of min %5.2f deg\n",
              name.c_str(), r.get("triangles"), seconds, r.get("triangles") / seconds, r.get("min_angle_deg"),
              r.get("mean_min_angle_deg"));
}

void run_plane(int n) {
  const remesh::plane_surface plane{};
  patch_boundary boundary;
  const vec2 corners[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}};
  for (int side = 0; side < 4; ++side)
    for (int i = 0; i < n; ++i) {
      boundary.uv.push_back(corners[side] +
                            (static_cast<double>(i) / n) * (corners[side + 1] - corners[side]));
      boundary.points.push_back(plane.frame(boundary.uv.back()).point);
      boundary.labels.push_back(static_cast<local_id>(boundary.labels.size()));
    }
  const auto count = static_cast<local_id>(boundary.uv.size());
  for (local_id v = 0; v < count; ++v)
    boundary.segments.push_back({v, (v + 1) % count});
  const double start = processor_seconds();
  const patch_mesh mesh = remesh::patch_remesher{}(plane, boundary, [n](vec3) { return 1.0 / n; });
  print("plane", mesh.summary, processor_seconds() - start);
}

void run_file(const char* path, double fraction) {
  const auto read = read_occt_model(path);
  const double size = read.model.bounds().diagonal() / fraction;
  const double start = processor_seconds();
  const auto made = background::coarse_surface(
      read.model, [size](vec3) { return size; }, {}, parallel::serial{}, remesh::patch_remesher{});
  print(path, made.summary, processor_seconds() - start);
}

} // namespace

int main(int argc, char** argv) {
  const double fraction = argc > 1 ? std::atof(argv[1]) : 100;
  if (!(fraction > 0)) {
    std::fputs("usage: remesh_benchmark SIZE_FRACTION [FILE...]\n", stderr);
    return 2;
  }
  run_plane(static_cast<int>(fraction) + 1);
  for (int i = 2; i < argc; ++i)
    try {
      run_file(argv[i], fraction);
    } catch (const error& failure) {
      std::printf("%-40s %s\n", argv[i], failure.what());
    }
}
