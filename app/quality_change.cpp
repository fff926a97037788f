#include "quality_change.hpp"

#include "run_figures.hpp"

#include <cstdio>
#include <string>

namespace dovetail::app {
namespace {

/// How the quality of elements of one dimension is named.
struct quality_terms {
  const char* count;
  const char* least;
  const char* most;
};
template <int D>
constexpr quality_terms terms =
    D == 3 ? quality_terms{"No. of tetrahedra", "Minimum dihedral angle (degrees)",
                           "Maximum dihedral angle (degrees)"}
           : quality_terms{"No. of triangles", "Minimum angle (degrees)", "Maximum angle (degrees)"};

} // namespace

void print_change(int dimension, const quality_statistics& before, const quality_statistics& after,
                  double seconds) {
  const quality_terms& name = dimension == 3 ? terms<3> : terms<2>;
  const auto row = [](const char* label, const char* format, auto old_value, auto new_value) {
    char values[2][40];
    std::snprintf(values[0], sizeof values[0], format, old_value);
    std::snprintf(values[1], sizeof values[1], format, new_value);
    std::printf("  %-32s %14s %14s\n", label, values[0], values[1]);
  };
  const auto per_million = [&](const char* word, int degrees) {
    const std::string label = std::string(word) + " (under " + std::to_string(degrees) + ") per million";
    row(label.c_str(), "%.1f", before.per_million_under(degrees), after.per_million_under(degrees));
  };
  std::printf("  %-32s %14s %14s\n", "", "before", "after");
  row(name.count, "%lld", static_cast<long long>(before.elements), static_cast<long long>(after.elements));
  row(name.least, "%.3f", before.min_dihedral_deg, after.min_dihedral_deg);
  row(name.most, "%.3f", before.max_dihedral_deg, after.max_dihedral_deg);
  per_million("Bad", limits_of(dimension).bad);
  per_million("Low", limits_of(dimension).low);
  std::printf("  %-32s %14.2f\n", "Seconds", seconds);
  if (seconds > 0)
    std::printf("  %-32s %14.0f\n", "Elements per second", static_cast<double>(before.elements) / seconds);
}

} // namespace dovetail::app
