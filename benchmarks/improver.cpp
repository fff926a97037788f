/// @file
/// Runs the native improver on raw meshes (see improver_generate.cpp) and prints what it reached and how
/// fast.
///
/// Usage: improver_benchmark PRESET[,PRESET...] REPEATS MESH.raw...
#include "dovetail/improver/native.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

namespace {

using namespace dovetail;

simplicial_mesh<3> read_raw(const char* path, local_id& frozen_points) {
  std::ifstream in(path, std::ios::binary);
  std::int64_t header[3] = {};
  in.read(reinterpret_cast<char*>(header), sizeof header);
  simplicial_mesh<3> mesh;
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
  frozen_points = static_cast<local_id>(header[2]);
  return mesh;
}

improvement::native preset_called(const std::string& name) {
  return name == "fast"     ? improvement::native::fast()
         : name == "finest" ? improvement::native::finest()
         : name == "hard"   ? improvement::native::hard()
                            : improvement::native::fine();
}

/// One timed run without statistics, in processor time: other programs on the machine do not count.
double seconds_of(improvement::native improver, const char* path) {
  frozen_entities<3> frozen;
  auto mesh = read_raw(path, frozen.points);
  improver.statistics = false;
  const std::clock_t start = std::clock();
  improver(mesh, frozen, {});
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

void print(const std::string& preset, const char* path, const report& r, double seconds) {
  const double n = r.get("elements before");
  const auto per_million = [&](const char* key) { return 1e6 * r.get(key) / n; };
  std::printf(
      "%-7s %-20s %8.0f el %6.3f s %6.0f k/s | free per M: bad %.1f low %.1f (was %.0f) angles %.2f..%.2f"
      " | limited: %.0f el, bad %.0f low %.0f\n",
      preset.c_str(), path, n, seconds, n / seconds / 1e3, per_million("after free bad"),
      per_million("after free low"), per_million("before free low"), r.get("after free min angle"),
      r.get("after free max angle"), r.get("after limited elements"), r.get("after limited bad"),
      r.get("after limited low"));
}

} // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    std::cerr << "usage: improver_benchmark PRESET[,PRESET...] REPEATS MESH.raw...\n";
    return 2;
  }
  std::stringstream presets(argv[1]);
  const int repeats = std::atoi(argv[2]);
  const bool verbose = std::getenv("VERBOSE") != nullptr;
  for (std::string preset; std::getline(presets, preset, ',');)
    for (int i = 3; i < argc; ++i) {
      const auto improver = preset_called(preset);
      std::vector<double> seconds;
      for (int k = 0; k < repeats; ++k)
        seconds.push_back(seconds_of(improver, argv[i]));
      std::sort(seconds.begin(), seconds.end());
      frozen_entities<3> frozen;
      auto mesh = read_raw(argv[i], frozen.points);
      const report last = improver(mesh, frozen, {});
      print(preset, argv[i], last, seconds[seconds.size() / 2]);
      if (verbose)
        for (const auto& [key, value] : last.counters)
          std::printf("    %-32s %.6g\n", key.c_str(), value);
    }
  return 0;
}
