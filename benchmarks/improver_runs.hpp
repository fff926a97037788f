/// @file
/// Runs an improver on raw meshes (see improver_generate.cpp) and prints what it reached and how fast, one
/// line of JSON per mesh. For the programs improver*.cpp; improver.py makes tables of the lines.
#pragma once

#include "dovetail/improver/tetrahedra/mesh_exchange.hpp"
#include "dovetail/improver/tetrahedra/surface_limits.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include <malloc.h>
#include <sys/resource.h>

namespace improver_runs {

using namespace dovetail;

struct input {
  simplicial_mesh<3> mesh;
  frozen_entities<3> frozen;
};

inline input read_raw(const char* path) {
  std::ifstream in(path, std::ios::binary);
  std::int64_t header[3] = {};
  in.read(reinterpret_cast<char*>(header), sizeof header);
  input read;
  auto& mesh = read.mesh;
  mesh.points.resize(static_cast<std::size_t>(header[0]));
  mesh.elements.resize(static_cast<std::size_t>(header[1]));
  in.read(reinterpret_cast<char*>(mesh.points.data()),
          static_cast<std::streamsize>(mesh.points.size() * sizeof(vec3)));
  in.read(reinterpret_cast<char*>(mesh.elements.data()),
          static_cast<std::streamsize>(mesh.elements.size() * sizeof(simplex<3>)));
  if (!in) {
    std::cerr << "cannot read " << path << '\n';
    std::exit(1);
  }
  read.frozen.points = static_cast<local_id>(header[2]);
  return read;
}

/// The largest memory of this process since the last call of `forget_peak` (Linux).
inline double peak_bytes() {
  std::ifstream status("/proc/self/status");
  for (std::string key; status >> key;)
    if (key == "VmHWM:") {
      double kilobytes = 0;
      status >> kilobytes;
      return 1024 * kilobytes;
    }
  return 0;
}
inline double forget_peak() {
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";
  return peak_bytes();
}

/// Counted in the same way whoever made the mesh.
inline improvement::quality_counts quality_of(input counted) {
  const auto complex = improvement::take_mesh(counted.mesh, counted.frozen);
  return improvement::count_quality(complex, improvement::surface_limits(complex));
}

/// Processor time of this process and of its children that have ended: other programs on the machine do not
/// count.
inline double processor_seconds() {
  double seconds = 0;
  for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    getrusage(who, &usage);
    for (const timeval& time : {usage.ru_utime, usage.ru_stime})
      seconds += static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  }
  return seconds;
}

/// The median of the seconds of `repeats` runs.
template <class Improver>
void run(const std::string& name, const Improver& improver, int repeats, const char* path) {
  const input before = read_raw(path);
  const auto elements = static_cast<double>(before.mesh.elements.size());
  const double own =
      static_cast<double>(before.mesh.points.size() * sizeof(vec3)) + elements * sizeof(simplex<3>);
  std::vector<double> seconds;
  double peak = 0;
  input after;
  for (int k = 0; k < repeats; ++k) {
    after = before;
    const double start = forget_peak();
    const double begin = processor_seconds();
    improver(after.mesh, after.frozen, {});
    seconds.push_back(processor_seconds() - begin);
    peak = std::max(peak, peak_bytes() - start + own);
  }
  std::sort(seconds.begin(), seconds.end());
  const auto was = quality_of(before), is = quality_of(after);
  const auto print = [](const char* key, const improvement::quality_counts::of_class& counts) {
    std::printf("\"%s\": {\"elements\": %zu, \"bad\": %zu, \"low\": %zu, \"min_angle\": %.3f}", key,
                counts.elements, counts.bad, counts.low, counts.min_angle);
  };
  std::printf("{\"improver\": \"%s\", \"mesh\": \"%s\", \"elements\": %.0f, \"seconds\": %.4f, "
              "\"bytes_per_element\": %.0f, ",
              name.c_str(), path, elements, seconds[seconds.size() / 2], peak / elements);
  print("free_before", was.free);
  std::printf(", ");
  print("limited_before", was.limited);
  std::printf(", ");
  print("free", is.free);
  std::printf(", ");
  print("limited", is.limited);
  std::printf("}\n");
  std::fflush(stdout);
}

} // namespace improver_runs
