/// @file
/// The native improver on raw meshes. Usage: improver PRESET[,PRESET...] REPEATS MESH.raw...
#include "dovetail/improver/native.hpp"
#include "improver_runs.hpp"

#include <sstream>

int main(int argc, char** argv) {
  using dovetail::improvement::native;
  if (argc < 4 || std::atoi(argv[2]) < 1) {
    std::cerr << "usage: improver PRESET[,PRESET...] REPEATS MESH.raw...\n";
    return 2;
  }
  std::stringstream presets(argv[1]);
  for (std::string name; std::getline(presets, name, ',');)
    for (int i = 3; i < argc; ++i) {
      native improver = name == "fast"     ? native::fast()
                        : name == "finest" ? native::finest()
                        : name == "hard"   ? native::hard()
                                           : native::fine();
      improver.statistics = false;
      improver_runs::run(name, improver, std::atoi(argv[2]), argv[i]);
    }
  return 0;
}
