/// Pieces at random that `mesher::native` does not fill, by families, and what it took to fill the others.
/// Usage: recovery [pieces per family (default 500)] [first seed (default 0)] [one family (default all)]
#include "dovetail/core/report.hpp"
#include "dovetail/mesher/native.hpp"
#include "mesher/random_pieces.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <string>

int main(int argc, char** argv) {
  const auto pieces = static_cast<unsigned>(argc > 1 ? std::atoi(argv[1]) : 500);
  const auto first = static_cast<unsigned>(argc > 2 ? std::atoi(argv[2]) : 0);
  const int only = argc > 3 ? std::atoi(argv[3]) : -1;
  std::printf("%-18s %7s %7s %6s %8s %7s %7s %9s %8s %8s\n", "family", "pieces", "refused", "wrong",
              "missing", "added", "left", "elements", "seconds", "longest");
  for (std::size_t f = 0; f < random_pieces::families().size(); ++f) {
    if (only >= 0 && f != static_cast<std::size_t>(only))
      continue;
    int refused = 0, wrong = 0;
    double missing = 0, added = 0, left = 0, elements = 0, longest = 0;
    const dovetail::stopwatch all;
    for (unsigned seed = first; seed < first + pieces; ++seed) {
      const auto piece = random_pieces::make(f, seed);
      const dovetail::stopwatch clock;
      std::string fault;
      try {
        const auto result =
            dovetail::mesher::native{}({piece.boundary, 0}, [&](dovetail::vec3) { return piece.size; });
        missing += result.summary.get("missing_edges") + result.summary.get("missing_triangles");
        left += result.summary.get("recovery_points");
        added += result.summary.get("recovery_points") + result.summary.get("recovery_points_removed");
        elements += static_cast<double>(result.mesh.elements.size());
        longest = std::max(longest, clock.seconds());
        fault = random_pieces::fault_of(piece.boundary, result.mesh);
        wrong += !fault.empty();
      } catch (const dovetail::mesher_error& problem) {
        longest = std::max(longest, clock.seconds());
        fault = problem.what();
        ++refused;
      }
      if (!fault.empty())
        std::fprintf(stderr, "%s, seed %u (%.2f s): %s\n", random_pieces::families()[f].name.c_str(), seed,
                     clock.seconds(), fault.c_str());
    }
    std::printf("%-18s %7u %7d %6d %8.0f %7.0f %7.0f %9.0f %8.2f %8.3f\n",
                random_pieces::families()[f].name.c_str(), pieces, refused, wrong, missing, added, left,
                elements, all.seconds(), longest);
    std::fflush(stdout);
  }
}
