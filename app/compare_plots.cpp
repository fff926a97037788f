#include "compare_plots.hpp"

#include "markup.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>

namespace dovetail::app {
namespace {

// Lengths are pixels, x to the right and y down.
constexpr double plot_width = 940;
constexpr const char* faint = "#ddd";
constexpr const char* quiet = "#777";
constexpr const char* dark_grey = "#333";

constexpr std::pair<const char*, double stage_seconds::*> stages[] = {
    {"background mesh", &stage_seconds::background}, {"simplification", &stage_seconds::simplification},
    {"partition", &stage_seconds::partition},        {"skeleton", &stage_seconds::skeleton},
    {"crossings", &stage_seconds::intersection},     {"meshing", &stage_seconds::meshing},
    {"improvement", &stage_seconds::improvement}};

using rows_shown = std::vector<const comparison_row*>;

/// Colours that stay apart for most who confuse some.
const char* colour(std::size_t k) {
  constexpr std::array colours{"#0072b2", "#e69f00", "#009e73", "#cc79a7",
                               "#56b4e9", "#d55e00", "#8c6bb1", "#8d8d3b"};
  return colours[k % colours.size()];
}

std::string label(double x, double y, const std::string& text, const char* anchor = "start",
                  const char* fill = dark_grey) {
  return element("text", {{"x", x}, {"y", y}, {"text-anchor", anchor}, {"fill", fill}}, escaped(text));
}
std::string line(double x1, double y1, double x2, double y2, const char* stroke = faint) {
  return element("line", {{"x1", x1}, {"y1", y1}, {"x2", x2}, {"y2", y2}, {"stroke", stroke}});
}
/// What the pointer is told that rests on something.
std::string tip(const std::string& text) {
  return text.empty() ? text : element("title", {}, escaped(text));
}
std::string bar(double x, double y, double length, double height, const char* fill,
                const std::string& text = {}) {
  return element("rect", {{"x", x}, {"y", y}, {"width", length}, {"height", height}, {"fill", fill}},
                 tip(text));
}
std::string disc(double x, double y, double r, const char* stroke, bool filled,
                 const std::string& text = {}) {
  return element("circle",
                 {{"cx", x},
                  {"cy", y},
                  {"r", r},
                  {"fill", filled ? stroke : "#fff"},
                  {"stroke", stroke},
                  {"stroke-width", 1.8}},
                 tip(text));
}
std::string drawing(const std::string& what, double height, const std::string& content) {
  return element("svg",
                 {{"viewBox", "0 0 " + fixed(plot_width, 0) + " " + fixed(height, 0)},
                  {"width", plot_width},
                  {"role", "img"},
                  {"aria-label", what},
                  {"font-family", "system-ui, sans-serif"},
                  {"font-size", 12}},
                 content);
}
double width_of(const std::vector<std::string>& names) {
  std::size_t longest = 0;
  for (const std::string& name : names)
    longest = std::max(longest, name.size());
  return 7 * static_cast<double>(longest);
}

/// From values, which begin at 0, to pixels.
struct plot_axis {
  double highest, first, last;
  double operator()(double value) const { return first + value / highest * (last - first); }
};

std::string x_axis(const plot_axis& x, double top, double bottom, const std::string& text) {
  const double power = std::pow(10, std::floor(std::log10(x.highest / 8)));
  double step = 10 * power;
  for (const double factor : {5, 2, 1})
    if (factor * power >= x.highest / 8)
      step = factor * power;
  std::string parts;
  for (int k = 0; k * step <= x.highest + 1e-9; ++k)
    parts += line(x(k * step), top, x(k * step), bottom) + label(x(k * step), bottom + 16,
                                                                 fixed(k * step, step < 0.1 ? 2
                                                                                 : step < 1 ? 1
                                                                                            : 0),
                                                                 "middle", quiet);
  return parts + label((x.first + x.last) / 2, bottom + 34, text, "middle");
}

/// Counts that may be zero, on a scale of powers of ten.
double log_of(double count) {
  return std::log10(1 + count);
}
std::string log_axis(const plot_axis& y, double left, double right, const std::string& text) {
  std::string parts;
  for (double count = 0; log_of(count) <= y.highest; count = count > 0 ? 10 * count : 1)
    parts += line(left, y(log_of(count)), right, y(log_of(count))) +
             label(left - 8, y(log_of(count)) + 4, fixed(count, 0), "end", quiet);
  return parts + label(left, y.last - 8, text);
}

struct plot_legend {
  std::string parts;
  double height;
};
plot_legend legend(double left, const std::vector<std::string>& names) {
  std::string parts;
  double x = left, y = 6;
  for (std::size_t k = 0; k < names.size(); ++k) {
    const double length = 24 + 7.2 * static_cast<double>(names[k].size());
    if (x + length > plot_width) {
      x = left;
      y += 20;
    }
    parts += bar(x, y, 12, 12, colour(k)) + label(x + 17, y + 10, names[k]);
    x += length;
  }
  return {parts, y + 14};
}

rows_shown rows_of(const comparison& compared) {
  rows_shown rows;
  for (const comparison_row& row : compared.rows)
    if (!row.failed())
      rows.push_back(&row);
  return rows;
}
double longest_time(const rows_shown& rows) {
  double longest = 0.01;
  for (const comparison_row* row : rows)
    longest = std::max(longest, row->seconds.total);
  return longest;
}
std::string meshing_of(const comparison_row& row) {
  return row.policies.mesher + " + " + row.policies.improver;
}
std::size_t place_of(const std::string& name, const std::vector<std::string>& names) {
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

} // namespace

std::string plot_of_times(const comparison& compared) {
  const rows_shown rows = rows_of(compared);
  std::vector<std::string> names, stage_names;
  for (const comparison_row* row : rows)
    names.push_back(full_name_of(row->policies));
  for (const auto& [name, member] : stages)
    stage_names.emplace_back(name);
  const double left = 20 + width_of(names), top = 48, height = 20;
  const double bottom = top + height * static_cast<double>(rows.size());
  const plot_axis x{1.02 * longest_time(rows), left, plot_width - 60};
  std::string parts = legend(10, stage_names).parts + x_axis(x, top, bottom, "seconds");
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const double y = top + height * static_cast<double>(r) + 3;
    parts += label(left - 8, y + 11, names[r], "end");
    double done = 0;
    for (std::size_t k = 0; k < std::size(stages); ++k) {
      const double seconds = rows[r]->seconds.*stages[k].second, begin = done;
      done += seconds;
      parts += bar(x(begin), y, x(done) - x(begin), height - 6, colour(k),
                   stage_names[k] + ": " + fixed(seconds, 2) + " s");
    }
    parts += label(x(rows[r]->seconds.total) + 6, y + 11, fixed(rows[r]->seconds.total) + " s");
  }
  return drawing("Seconds per stage", bottom + 44, parts);
}

std::string plot_of_quality(const comparison& compared) {
  const rows_shown rows = rows_of(compared);
  const int low = words_of(compared.dimension).low;
  const auto low_of = [&](const comparison_row& row) {
    return row.elements > 0 ? row.quality.per_million_under(low) : 0;
  };
  std::vector<std::string> meshings;
  double most = 10;
  for (const comparison_row* row : rows) {
    most = std::max(most, low_of(*row));
    if (place_of(meshing_of(*row), meshings) == meshings.size())
      meshings.push_back(meshing_of(*row));
  }
  const double left = 80, height = 400;
  const plot_legend names = legend(left, meshings);
  const plot_axis x{1.05 * longest_time(rows), left, plot_width - 30};
  const plot_axis y{log_of(1.5 * most), height - 50, names.height + 36};
  std::string parts =
      names.parts + x_axis(x, y.last, y.first, "seconds in total") +
      log_axis(y, left, plot_width - 30, "elements under " + std::to_string(low) + " degrees per million");
  for (const comparison_row* row : rows)
    parts += disc(x(row->seconds.total), y(log_of(low_of(*row))), 5.5,
                  colour(place_of(meshing_of(*row), meshings)), row->policies.is_simplified(),
                  full_name_of(row->policies) + ": " + fixed(low_of(*row)) + " per million, " +
                      fixed(row->seconds.total) + " s");
  return drawing("Low-quality elements against time", height, parts);
}

std::string plot_of_angles(const comparison& compared) {
  const element_words words = words_of(compared.dimension);
  // For each mesher and improver the first row, of those with simplification if there is one.
  std::vector<std::string> meshings;
  rows_shown first;
  for (const bool simplified : {true, false})
    for (const comparison_row* row : rows_of(compared))
      if (row->policies.is_simplified() == simplified &&
          place_of(meshing_of(*row), meshings) == meshings.size()) {
        meshings.push_back(meshing_of(*row));
        first.push_back(row);
      }
  const auto share = [](const comparison_row& row, int degree) {
    const auto count = static_cast<double>(row.quality.min_dihedrals.bins[degree]);
    return row.elements > 0 ? 1e6 * count / static_cast<double>(row.elements) : 0;
  };
  double most = 10;
  for (const comparison_row* row : first)
    for (int degree = 0; degree < words.best; ++degree)
      most = std::max(most, share(*row, degree));
  const double left = 80, height = 400;
  const plot_legend names = legend(left, meshings);
  const plot_axis x{static_cast<double>(words.best + 1), left, plot_width - 30};
  const plot_axis y{log_of(1.5 * most), height - 50, names.height + 36};
  std::string parts =
      names.parts + bar(x(0), y.last, x(words.bad) - x(0), y.first - y.last, "#fbe3e0") +
      bar(x(words.bad), y.last, x(words.low) - x(words.bad), y.first - y.last, "#fdf1dc") +
      x_axis(x, y.last, y.first, "smallest " + std::string(words.angle) + " of an element (degrees)") +
      log_axis(y, left, plot_width - 30, "elements per million and degree");
  for (std::size_t r = 0; r < first.size(); ++r) {
    std::string points;
    for (int degree = 0; degree < words.best; ++degree)
      points.append(degree == 0 ? "" : " ")
          .append(fixed(x(degree + 0.5)))
          .append(",")
          .append(fixed(y(log_of(share(*first[r], degree)))));
    parts += element("polyline",
                     {{"points", points}, {"fill", "none"}, {"stroke", colour(r)}, {"stroke-width", 1.6}});
  }
  return drawing("Smallest " + std::string(words.angle) + "s", height, parts);
}

std::string plot_of_interfaces(const comparison& compared, const std::vector<simplified_pair>& pairs) {
  struct angle_kind {
    const char* name;
    double interface_row::*angle;
    std::size_t place;
  };
  struct of_mesh {
    const char* name;
    interface_row comparison_row::*row;
  };
  constexpr of_mesh meshes[] = {{"background mesh", &comparison_row::coarse},
                                {"finished mesh", &comparison_row::fine}};
  // Edges have no angles of their own.
  const std::vector<angle_kind> kinds =
      compared.dimension == 3 ? std::vector<angle_kind>{{"face", &interface_row::min_face_angle, 0},
                                                        {"dihedral", &interface_row::min_dihedral, 1}}
                              : std::vector<angle_kind>{{"corner", &interface_row::min_dihedral, 1}};
  std::vector<std::string> names;
  double widest = compared.angle_threshold + 10;
  for (const simplified_pair& pair : pairs) {
    names.push_back(pair.name);
    for (const of_mesh& mesh : meshes)
      for (const comparison_row* row : {pair.with, pair.without})
        for (const double angle : {(row->*mesh.row).min_face_angle, (row->*mesh.row).min_dihedral})
          widest = std::fmax(widest, 10 * std::ceil(angle / 10)); // NaN is passed over
  }
  const double left = 60 + width_of(names), panel = (plot_width - left - 60) / 2, height = 46, top = 62;
  const double bottom = top + height * static_cast<double>(pairs.size());
  std::string parts = disc(left + 6, 14, 5, colour(0), true) + label(left + 18, 18, "with simplification") +
                      disc(left + 156, 14, 5, colour(0), false) + label(left + 168, 18, "without");
  for (std::size_t side = 0; side < std::size(meshes); ++side) {
    const double begin = left + static_cast<double>(side) * (panel + 40);
    const plot_axis x{widest, begin, begin + panel};
    const double threshold = x(compared.angle_threshold);
    parts += label(begin, top - 12, meshes[side].name) + x_axis(x, top, bottom, "smallest angle (degrees)") +
             element("line", {{"x1", threshold},
                              {"y1", top},
                              {"x2", threshold},
                              {"y2", bottom},
                              {"stroke", "#c33"},
                              {"stroke-width", 1.2},
                              {"stroke-dasharray", "4 3"}});
    for (std::size_t p = 0; p < pairs.size(); ++p)
      for (const angle_kind& kind : kinds) {
        const double y = top + height * static_cast<double>(p) + 14 + 18 * static_cast<double>(kind.place);
        if (side == 0)
          parts += label(left - 10, y + 4, kind.name, "end", quiet);
        const double having = (pairs[p].with->*meshes[side].row).*kind.angle;
        const double lacking = (pairs[p].without->*meshes[side].row).*kind.angle;
        if (!std::isnan(having) && !std::isnan(lacking))
          parts +=
              line(x(lacking), y, x(having), y, quiet) +
              disc(x(lacking), y, 5, colour(kind.place), false, "without: " + fixed(lacking) + " degrees") +
              disc(x(having), y, 5, colour(kind.place), true, "with: " + fixed(having) + " degrees");
      }
  }
  for (std::size_t p = 0; p < pairs.size(); ++p)
    parts += label(10, top + height * static_cast<double>(p) + 27, names[p]);
  return drawing("Smallest interface angles with and without simplification", bottom + 44, parts);
}

} // namespace dovetail::app
