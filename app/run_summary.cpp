#include "run_figures.hpp"
#include "terminal_progress.hpp"

#include "dovetail/remesh/surface_deviation.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::app {
namespace {

/// Rows of a label and a right-aligned value.
class table {
public:
  void heading(const std::string& text) { text_ += text + '\n'; }
  void row(const std::string& label, const std::string& value) {
    char line[200];
    std::snprintf(line, sizeof line, "  %-42s %18s\n", label.c_str(), value.c_str());
    text_ += line;
  }
  template <class Value>
  void row(const std::string& label, const char* format, Value value) {
    char buffer[80];
    std::snprintf(buffer, sizeof buffer, format, value);
    row(label, buffer);
  }
  void whole(const std::string& label, std::int64_t value) { row(label, grouped(value)); }
  void whole(const std::string& label, std::int64_t value, std::int64_t of_these) {
    row(label, grouped(value) + " (" + grouped(of_these) + ")");
  }
  const std::string& text() const { return text_; }

private:
  static std::string grouped(std::int64_t value) {
    std::string digits = std::to_string(value);
    for (std::size_t at = digits.size(); at > 3; at -= 3)
      digits.insert(at - 3, 1, ',');
    return digits;
  }
  std::string text_;
};

void add_general(table& rows, const run_figures& figures) {
  rows.heading("General data");
  rows.row("Model", figures.model);
  rows.whole("No. of workers", figures.workers);
  const bool solid = figures.dimension == 3;
  rows.whole(solid ? "No. of background tetrahedra" : "No. of background triangles",
             figures.background_elements);
  rows.whole("No. of subdomains", figures.subdomains);
  if (!figures.only.empty())
    rows.whole("  Of a total of", figures.of_subdomains);
  rows.whole(solid ? "No. of tetrahedra" : "No. of triangles", figures.elements);
  rows.whole("No. of vertices", figures.vertices);
  rows.whole(solid ? "No. of surface elements" : "No. of boundary edges", figures.boundary_triangles);
  rows.row("Largest subdomain / average", "%.3f", figures.imbalance);
}

void add_timing(table& rows, const run_figures& figures) {
  const stage_seconds& s = figures.seconds;
  rows.heading("Timing (seconds)");
  rows.row("Entire run", "%.2f", s.total);
  rows.row("  Geometry", "%.2f", s.geometry);
  if (s.scaling > 0)
    rows.row("  Sizes for the number of elements", "%.2f", s.scaling);
  rows.row("  Domain decomposition", "%.2f",
           s.background + s.simplification + s.partition + s.skeleton + s.intersection + s.bisection);
  rows.row("    Bkg. mesh generation", "%.2f", s.background);
  rows.row("    Bkg. mesh simplification", "%.2f", s.simplification);
  rows.row("    Partition", "%.2f", s.partition);
  rows.row("    Remeshing of subdomain boundaries", "%.2f", s.skeleton);
  rows.row("    Intersection detection", "%.2f", s.intersection);
  if (s.bisection > 0)
    rows.row("    Bisection of the fine surface", "%.2f", s.bisection);
  rows.row("  Mesh generation", "%.2f", s.meshing);
  if (s.fine_partition > 0)
    rows.row("  Partition of the fine mesh", "%.2f", s.fine_partition);
  rows.row("  Mesh improvement", "%.2f", s.improvement);
  if (s.redistribution > 0)
    rows.row("  Redistribution of elements", "%.2f", s.redistribution);
  if (s.first_pass > 0)
    rows.row("  Improvement again, first pass", "%.2f", s.first_pass);
  if (s.second_pass > 0) {
    rows.row("    Elements at interfaces", "%.2f", s.between_passes);
    rows.row("    Second pass", "%.2f", s.second_pass);
    rows.row("    Writing back", "%.2f", s.writing_back);
  }
  rows.row("  Output", "%.2f", s.output);
  if (s.total > 0)
    rows.row("Relative speed (elements/second/worker)",
             count_text(static_cast<double>(figures.elements) / s.total / std::max(1, figures.workers)));
  rows.row("Peak memory of a process (MiB)", "%.0f", static_cast<double>(figures.peak_rss_bytes) / (1 << 20));
}

void add_interfaces(table& rows, const run_figures& figures) {
  rows.heading("Interfaces                                        coarse          fine");
  const auto pair = [&](const char* label, const char* format, auto coarse, auto fine) {
    char values[80];
    const std::string both = std::string(format) + format;
    std::snprintf(values, sizeof values, both.c_str(), coarse, fine);
    rows.row(label, values);
  };
  const auto angle = [](const std::optional<double>& degrees) {
    char text[16] = "none";
    if (degrees)
      std::snprintf(text, sizeof text, "%.1f", *degrees);
    return std::string(text);
  };
  const auto angles = [&](const char* label, const auto& coarse, const auto& fine) {
    pair(label, "%14s", angle(coarse).c_str(), angle(fine).c_str());
  };
  const auto& coarse = figures.coarse_interfaces;
  const auto& fine = figures.interfaces;
  const bool solid = figures.dimension == 3;
  pair(solid ? "No. of faces" : "No. of edges", "%14lld", static_cast<long long>(coarse.faces),
       static_cast<long long>(fine.faces));
  if (solid) // edges have no angles of their own
    angles("Minimum face angle (degrees)", coarse.min_face_angle_deg, fine.min_face_angle_deg);
  angles(solid ? "Minimum dihedral (degrees)" : "Minimum angle (degrees)", coarse.min_dihedral_deg,
         fine.min_dihedral_deg);
  pair("Below the threshold, forced by the CAD", "%14lld", static_cast<long long>(coarse.forced),
       static_cast<long long>(fine.forced));
  pair("Below the threshold, refused by the bound", "%14lld", static_cast<long long>(coarse.refused),
       static_cast<long long>(fine.refused));
  pair("Below the threshold since remeshing", "%14lld", static_cast<long long>(coarse.remeshing),
       static_cast<long long>(fine.remeshing));
  rows.heading("Intersection suppression");
  rows.whole("Difference of the number of subdomains", figures.merges);
  rows.whole("Maximal size of a merged subdomain", figures.largest_merged);
  if (figures.failed_subdomains > 0)
    rows.whole("FAILED SUBDOMAINS", figures.failed_subdomains);
}

void add_triangle_quality(table& rows, const quality_statistics& quality) {
  rows.heading("Quality: minimum angle a of the triangles (degrees)");
  rows.whole("No. of triangles", quality.elements);
  rows.row("Minimum angle", "%.2f", quality.min_dihedral_deg);
  rows.row("Mean of the minimum angles", "%.2f", quality.mean_min_dihedral_deg());
  rows.row("Maximum angle", "%.2f", quality.max_dihedral_deg);
}

void add_tetrahedron_quality(table& rows, const quality_statistics& quality) {
  rows.heading("Volume mesh quality: minimum dihedral angle a (degrees)");
  const auto under = quality.under_6_12_18_24();
  rows.whole("No. of tetrahedra", quality.elements);
  rows.row("Minimum dihedral angle", "%.2f", quality.min_dihedral_deg);
  rows.row("Maximum dihedral angle", "%.2f", quality.max_dihedral_deg);
  rows.whole("No. of tets with  0 < a <  6", under[0]);
  rows.whole("No. of tets with  6 <= a < 12", under[1] - under[0]);
  rows.whole("No. of tets with 12 <= a < 18", under[2] - under[1]);
  rows.whole("No. of tets with 18 <= a < 24", under[3] - under[2]);
  rows.whole("No. of tets with  0 < a < 12 (bad)", under[1]);
  rows.whole("No. of tets with  0 < a < 24 (low quality)", under[3]);
}

/// Elements by their distance from interfaces, where there are any.
void add_at_interfaces(table& rows, const quality_at_interfaces& at_interfaces, int dimension) {
  if (at_interfaces.touching.elements == 0)
    return;
  rows.heading("Elements at interfaces (degrees)              number  least   bad    low");
  const quality_limits under = limits_of(dimension);
  const auto ring = [&](const char* label, const ring_quality& found) {
    char values[80];
    std::snprintf(values, sizeof values, "%9s%7.1f%6lld%7lld",
                  count_text(static_cast<double>(found.elements)).c_str(), found.min_dihedral_deg,
                  static_cast<long long>(found.min_dihedrals.below(under.bad)),
                  static_cast<long long>(found.min_dihedrals.below(under.low)));
    if (found.elements > 0)
      rows.row(label, values);
  };
  ring("Touching one", at_interfaces.touching);
  ring("Next ring", at_interfaces.next_ring);
  ring("All others", at_interfaces.rest);
}

/// By their causes, where there are any.
void add_poor_elements(table& rows, const poor_elements& poor, int dimension) {
  const auto all = std::accumulate(poor.low.begin(), poor.low.end(), std::int64_t{0});
  if (all == 0)
    return;
  rows.heading(dimension == 3 ? "Low-quality tets by cause (of these bad)"
                              : "Low-quality triangles by cause (of these bad)");
  for (std::size_t k = 0; k < poor_causes; ++k)
    if (const auto cause = static_cast<poor_cause>(k); poor.low_by(cause) > 0) {
      std::string label(name_of_cause(cause, dimension));
      label.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(label.front())));
      rows.whole(label, poor.low_by(cause), poor.bad_by(cause));
    }
}

/// What the mesh does not have of the model, where there is something.
void add_suppressed(table& rows, const std::vector<suppressed_detail>& details) {
  using kind = suppressed_detail::kind;
  if (details.empty())
    return;
  rows.heading("Details of the model left out");
  for (const auto& [what, label] : {std::pair(kind::narrow_face, "Narrow faces"),
                                    {kind::narrow_end, "Narrow ends of faces"},
                                    {kind::narrow_gap, "Narrow gaps between edges"},
                                    {kind::short_edge, "Short edges"},
                                    {kind::joined_face, "Faces joined to others"}})
    if (const auto count = std::count_if(details.begin(), details.end(),
                                         [what = what](const auto& each) { return each.what == what; });
        count > 0)
      rows.whole(label, count);
  const auto widest = std::max_element(details.begin(), details.end(),
                                       [](const auto& a, const auto& b) { return a.length < b.length; });
  rows.row("Largest width or length", "%.3g", widest->length);
}

void add_deviation(table& rows, const report& deviation) {
  rows.heading("Largest distance from the CAD (in units of the local size)");
  const surface_deviation largest = deviation_in(deviation);
  rows.row("Of points", "%.2g", largest.points);
  rows.row("Of centres of triangles", "%.2g", largest.centres);
}

void add_quality(table& rows, const quality_statistics& quality, int dimension) {
  if (dimension == 3)
    add_tetrahedron_quality(rows, quality);
  else
    add_triangle_quality(rows, quality);
}

} // namespace

std::string summary_text(const run_figures& figures) {
  table rows;
  add_general(rows, figures);
  add_timing(rows, figures);
  if (figures.subdomains > 1)
    add_interfaces(rows, figures);
  add_suppressed(rows, figures.suppressed);
  if (!figures.deviation.children.empty())
    add_deviation(rows, figures.deviation);
  add_quality(rows, figures.quality, figures.dimension);
  add_at_interfaces(rows, figures.at_interfaces, figures.dimension);
  add_poor_elements(rows, figures.poor, figures.dimension);
  if (!figures.repeatable)
    rows.heading("NOT REPEATABLE: a limit of wall-clock time has decided on a part of the mesh");
  for (const auto& warning : figures.warnings)
    rows.heading("warning: " + warning);
  if (!figures.out.empty())
    rows.heading("The mesh is in " + figures.out);
  return rows.text();
}

std::string plan_text(const plan_figures& figures) {
  table rows;
  const auto mebibytes = [&](const char* label, double bytes) { rows.row(label, "%.0f", bytes / (1 << 20)); };
  rows.heading("Prediction");
  rows.row("Model", figures.model);
  rows.row(figures.dimension == 3 ? "No. of tetrahedra" : "No. of triangles", count_text(figures.elements));
  rows.row("  within (percent)", "%.1f", 100 * figures.relative_error);
  rows.whole("No. of subdomains", figures.subdomains);
  rows.row("Background size / size", "%.2f", figures.coarsening);
  rows.whole("No. of workers", figures.workers);
  rows.row("Time", "about " + duration_text(figures.seconds));
  mebibytes("Memory of a worker (MiB)", figures.worker_bytes);
  mebibytes("Memory of the parent (MiB)", figures.parent_bytes);
  mebibytes("Disk, with the spool (MiB)", figures.disk_bytes);
  for (const auto& warning : figures.warnings)
    rows.heading("warning: " + warning);
  return rows.text();
}

std::string quality_text(const quality_statistics& quality, int dimension) {
  table rows;
  add_quality(rows, quality, dimension);
  return rows.text();
}

std::string at_interfaces_text(const quality_at_interfaces& found, int dimension) {
  table rows;
  add_at_interfaces(rows, found, dimension);
  return rows.text();
}

} // namespace dovetail::app
