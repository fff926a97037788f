/// Pieces at random that `mesher::native` does not fill, by families, and what it took to fill the others.
/// Usage: recovery [pieces per family (default 500)] [first seed (default 0)] [one family (default -1: all)]
///                 [file for a line per piece: family, seed, what became of it, hash of its mesh, operations]
/// 770 per family are ten thousand in all.
#include "dovetail/core/content_key.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/mesher/native.hpp"
#include "mesher/random_pieces.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

namespace {

/// Of every bit of a mesh: two files of lines tell which meshes a change of the mesher has changed.
std::string hash_of(const dovetail::simplicial_mesh<3>& mesh) {
  return to_string(dovetail::key_maker{}(mesh.points)(mesh.elements).key());
}

} // namespace

int main(int argc, char** argv) {
  const auto pieces = static_cast<unsigned>(argc > 1 ? std::atoi(argv[1]) : 500);
  const auto first = static_cast<unsigned>(argc > 2 ? std::atoi(argv[2]) : 0);
  const int only = argc > 3 ? std::atoi(argv[3]) : -1;
  std::ofstream lines;
  if (argc > 4)
    lines.open(argv[4]);
  std::printf("%-18s %7s %7s %6s %8s %7s %7s %9s %8s %8s %10s\n", "family", "pieces", "refused", "wrong",
              "missing", "added", "left", "elements", "seconds", "longest", "most ops.");
  for (std::size_t f = 0; f < random_pieces::families().size(); ++f) {
    if (only >= 0 && f != static_cast<std::size_t>(only))
      continue;
    int refused = 0, wrong = 0;
    double missing = 0, added = 0, left = 0, elements = 0, longest = 0, most_operations = 0;
    const dovetail::stopwatch all;
    for (unsigned seed = first; seed < first + pieces; ++seed) {
      const auto piece = random_pieces::make(f, seed);
      const dovetail::stopwatch clock;
      std::string fault;
      try {
        const auto result =
            dovetail::mesher::native{}({piece.boundary, 0}, [&](dovetail::vec3) { return piece.size; });
        const double operations = result.summary.get("recovery_operations");
        missing += result.summary.get("missing_edges") + result.summary.get("missing_triangles");
        left += result.summary.get("recovery_points");
        added += result.summary.get("recovery_points") + result.summary.get("recovery_points_removed");
        elements += static_cast<double>(result.mesh.elements.size());
        longest = std::max(longest, clock.seconds());
        most_operations = std::max(most_operations, operations);
        fault = random_pieces::fault_of(piece.boundary, result.mesh);
        wrong += !fault.empty();
        lines << f << ' ' << seed << (fault.empty() ? " filled " : " wrong ") << hash_of(result.mesh) << ' '
              << operations << '\n';
      } catch (const dovetail::mesher_error& problem) {
        longest = std::max(longest, clock.seconds());
        fault = problem.what();
        ++refused;
        lines << f << ' ' << seed << " refused 0 0\n";
      }
      if (!fault.empty())
        std::fprintf(stderr, "%s, seed %u (%.2f s): %s\n", random_pieces::families()[f].name.c_str(), seed,
                     clock.seconds(), fault.c_str());
    }
    std::printf("%-18s %7u %7d %6d %8.0f %7.0f %7.0f %9.0f %8.2f %8.3f %10.0f\n",
                random_pieces::families()[f].name.c_str(), pieces, refused, wrong, missing, added, left,
                elements, all.seconds(), longest, most_operations);
    std::fflush(stdout);
  }
}
