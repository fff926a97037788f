/// @file
/// Runs the native improver on raw meshes (see improver_generate.cpp) and prints what it reached and how
/// fast.
///
/// Usage: improver_benchmark PRESET[,PRESET...] REPEATS MESH.raw...
#include "dovetail/improver/native.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
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

void print(const std::string& preset, const char* path, const report& r, double seconds) {
  const double n = r.get("elements before");
  const double statistics = r.get("statistics before seconds") + r.get("statistics after seconds");
  const auto per_million = [&](const char* key) { return 1e6 * r.get(key) / n; };
  std::printf(
      "%-7s %-24s %8.0f el %7.3f s (%.3f stat) %8.0f k/s | free: bad %5.1f low %8.1f min %5.2f max %6.2f "
      "| limited: bad %4.0f low %5.0f | was low %.0f\n",
      preset.c_str(), path, n, seconds, statistics, n / (seconds - statistics) / 1e3,
      per_million("after free bad"), per_million("after free low"), r.get("after free min angle"),
      r.get("after free max angle"), r.get("after limited bad"), r.get("after limited low"),
      per_million("before free low"));
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
      std::vector<double> seconds;
      report last;
      for (int k = 0; k < repeats; ++k) {
        frozen_entities<3> frozen;
        auto mesh = read_raw(argv[i], frozen.points);
        last = preset_called(preset)(mesh, frozen, {});
        seconds.push_back(last.seconds);
      }
      std::sort(seconds.begin(), seconds.end());
      print(preset, argv[i], last, seconds[seconds.size() / 2]);
      if (verbose)
        for (const auto& [key, value] : last.counters)
          std::printf("    %-32s %.6g\n", key.c_str(), value);
    }
  return 0;
}
