#include "compare_plots.hpp"

#include "compare_groups.hpp"
#include "compare_svg.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace dovetail::app {
namespace {

constexpr double width = 940;
constexpr const char* faint = "#ddd";
constexpr const char* quiet = "#777";

/// Colours that stay apart for most who confuse some.
std::string colour_of(std::size_t k) {
  constexpr std::array colours{"#0072b2", "#e69f00", "#009e73", "#cc79a7",
                               "#56b4e9", "#d55e00", "#8c6bb1", "#8d8d3b"};
  return colours[k % colours.size()];
}

/// A round step that divides `range` into about `count` parts.
double round_step(double range, int count) {
  const double rough = std::max(range, 1e-9) / count;
  const double power = std::pow(10, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= rough)
      return factor * power;
  return 10 * power;
}

std::string tick_text(double value, double step) {
  return fixed(value, step < 0.1 ? 2 : step < 1 ? 1 : 0);
}

/// From values to pixels, on one axis.
struct axis {
  double lowest, highest; ///< values
  double first, last;     ///< pixels

  double at(double value) const { return first + (value - lowest) / (highest - lowest) * (last - first); }
};

void draw_x_axis(svg_drawing& svg, const axis& x, double top, double bottom, const std::string& label) {
  const double step = round_step(x.highest - x.lowest, 8);
  for (double value = x.lowest; value <= x.highest + 1e-9; value += step) {
    svg.line(x.at(value), top, x.at(value), bottom, faint);
    svg.text(x.at(value), bottom + 16, tick_text(value, step), text_anchor::middle, quiet);
  }
  svg.text(0.5 * (x.first + x.last), bottom + 34, label, text_anchor::middle);
}

/// Counts that may be zero, on a scale of powers of ten.
double log_of_count(double count) {
  return std::log10(1 + count);
}

void draw_log_axis(svg_drawing& svg, const axis& y, double left, double right, const std::string& label) {
  svg.line(left, y.at(0), right, y.at(0), faint);
  svg.text(left - 8, y.at(0) + 4, "0", text_anchor::end, quiet);
  for (double count = 1; log_of_count(count) <= y.highest; count *= 10) {
    const double at = y.at(log_of_count(count));
    svg.line(left, at, right, at, faint);
    svg.text(left - 8, at + 4, fixed(count, 0), text_anchor::end, quiet);
  }
  svg.text(left, y.last - 8, label);
}

/// A row of coloured squares with names; returns the height taken.
double draw_legend(svg_drawing& svg, double left, double top, const std::vector<std::string>& names,
                   const std::vector<std::string>& colours) {
  double x = left;
  double y = top;
  for (std::size_t k = 0; k < names.size(); ++k) {
    const double length = 24 + 7.2 * static_cast<double>(names[k].size());
    if (x + length > width) {
      x = left;
      y += 20;
    }
    svg.rectangle(x, y, 12, 12, colours[k]);
    svg.text(x + 17, y + 10, names[k]);
    x += length;
  }
  return y + 20 - top;
}

struct timed_stage {
  const char* name;
  double stage_seconds::*seconds;
};
constexpr std::array<timed_stage, 7> stages{{{"background mesh", &stage_seconds::background},
                                             {"simplification", &stage_seconds::simplification},
                                             {"partition", &stage_seconds::partition},
                                             {"skeleton", &stage_seconds::skeleton},
                                             {"crossings", &stage_seconds::intersection},
                                             {"meshing", &stage_seconds::meshing},
                                             {"improvement", &stage_seconds::improvement}}};

std::vector<comparison_row> successful(const comparison& compared) {
  std::vector<comparison_row> rows;
  std::copy_if(compared.rows.begin(), compared.rows.end(), std::back_inserter(rows),
               [](const comparison_row& row) { return !row.failed(); });
  return rows;
}

double longest_time(const std::vector<comparison_row>& rows) {
  double longest = 0.01;
  for (const auto& row : rows)
    longest = std::max(longest, row.seconds.total);
  return longest;
}

std::string full_name(const comparison_row& row) {
  return name_of(row.policies) + (row.policies.simplified ? "" : ", without simplification");
}

/// About the width of the longest of some names.
template <class Items, class Name>
double width_of_names(const Items& items, Name name) {
  std::size_t longest = 0;
  for (const auto& item : items)
    longest = std::max(longest, name(item).size());
  return 7.0 * static_cast<double>(longest);
}

/// What is drawn of a pair: one kind of angle, in one of the two meshes.
struct angle_kind {
  const char* name;
  interface_row comparison_row::*mesh;
  double interface_row::*angle;
};
constexpr std::array<angle_kind, 4> angle_kinds{{
    {"face", &comparison_row::coarse, &interface_row::min_face_angle},
    {"wedge", &comparison_row::coarse, &interface_row::min_wedge},
    {"face", &comparison_row::fine, &interface_row::min_face_angle},
    {"wedge", &comparison_row::fine, &interface_row::min_wedge},
}};

} // namespace

std::string times_plot(const comparison& compared) {
  const auto rows = successful(compared);
  const double left = 20 + width_of_names(rows, full_name);
  constexpr double row_height = 20;
  const double top = 48;
  const double bottom = top + row_height * static_cast<double>(rows.size());
  svg_drawing svg(width, bottom + 44);
  std::vector<std::string> names;
  std::vector<std::string> colours;
  for (std::size_t k = 0; k < stages.size(); ++k) {
    names.emplace_back(stages[k].name);
    colours.push_back(colour_of(k));
  }
  draw_legend(svg, 10, 6, names, colours);
  const axis x{0, 1.02 * longest_time(rows), left, width - 60};
  draw_x_axis(svg, x, top, bottom, "seconds");
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const double y = top + row_height * static_cast<double>(r) + 3;
    svg.text(left - 8, y + 11, full_name(rows[r]), text_anchor::end);
    double done = 0;
    for (std::size_t k = 0; k < stages.size(); ++k) {
      const double seconds = rows[r].seconds.*stages[k].seconds;
      svg.rectangle(x.at(done), y, x.at(done + seconds) - x.at(done), row_height - 6, colours[k],
                    std::string(stages[k].name) + ": " + fixed(seconds, 2) + " s");
      done += seconds;
    }
    svg.text(x.at(rows[r].seconds.total) + 6, y + 11, fixed(rows[r].seconds.total, 1) + " s");
  }
  return svg.element("Seconds per stage");
}

std::string quality_plot(const comparison& compared) {
  const auto rows = successful(compared);
  const auto pairs = distinct_meshings(rows);
  const int low_angle = words_of(compared.dimension).low;
  constexpr double left = 80;
  constexpr double height = 400;
  svg_drawing svg(width, height);
  std::vector<std::string> names;
  std::vector<std::string> colours;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    names.push_back(pairs[k].name());
    colours.push_back(colour_of(k));
  }
  const double legend = draw_legend(svg, left, 6, names, colours);
  double most = 10;
  for (const auto& row : rows)
    most = std::max(most, row.quality.per_million_under(low_angle));
  const axis x{0, 1.05 * longest_time(rows), left, width - 30};
  const axis y{0, log_of_count(1.5 * most), height - 50, legend + 36};
  draw_x_axis(svg, x, y.last, y.first, "seconds in total");
  draw_log_axis(svg, y, left, width - 30,
                "elements under " + std::to_string(low_angle) + " degrees per million");
  for (const auto& row : rows) {
    const auto pair = std::find(pairs.begin(), pairs.end(), meshing_of(row)) - pairs.begin();
    const double low = row.quality.per_million_under(low_angle);
    svg.disc(x.at(row.seconds.total), y.at(log_of_count(low)), 5.5, colour_of(static_cast<std::size_t>(pair)),
             row.policies.simplified,
             full_name(row) + ": " + fixed(low, 1) + " per million, " + fixed(row.seconds.total, 1) + " s");
  }
  return svg.element("Low-quality elements against time");
}

std::string histogram_plot(const comparison& compared) {
  const auto rows = first_of_each_meshing(compared);
  constexpr double left = 80;
  constexpr double height = 400;
  const element_words words = words_of(compared.dimension);
  const int last_bin = words.best;
  svg_drawing svg(width, height);
  std::vector<std::string> names;
  std::vector<std::string> colours;
  double most = 10;
  const auto share = [](const comparison_row& row, int degrees) {
    return row.quality.elements == 0
               ? 0.0
               : 1e6 * static_cast<double>(row.quality.min_wedges.bins[static_cast<std::size_t>(degrees)]) /
                     static_cast<double>(row.quality.elements);
  };
  for (std::size_t r = 0; r < rows.size(); ++r) {
    names.push_back(meshing_of(rows[r]).name());
    colours.push_back(colour_of(r));
    for (int k = 0; k < last_bin; ++k)
      most = std::max(most, share(rows[r], k));
  }
  const double legend = draw_legend(svg, left, 6, names, colours);
  const axis x{0, last_bin + 1.0, left, width - 30};
  const axis y{0, log_of_count(1.5 * most), height - 50, legend + 36};
  svg.rectangle(x.at(0), y.last, x.at(words.bad) - x.at(0), y.first - y.last, "#fbe3e0");
  svg.rectangle(x.at(words.bad), y.last, x.at(words.low) - x.at(words.bad), y.first - y.last, "#fdf1dc");
  draw_x_axis(svg, x, y.last, y.first, "smallest " + std::string(words.angle) + " of an element (degrees)");
  draw_log_axis(svg, y, left, width - 30, "elements per million and degree");
  for (std::size_t r = 0; r < rows.size(); ++r) {
    std::vector<std::pair<double, double>> points;
    for (int k = 0; k < last_bin; ++k)
      points.emplace_back(x.at(k + 0.5), y.at(log_of_count(share(rows[r], k))));
    svg.curve(points, colours[r]);
  }
  return svg.element("Smallest " + std::string(words.angle) + "s");
}

std::string interfaces_plot(const comparison& compared) {
  const auto pairs = simplification_pairs(compared);
  const double left = 60 + width_of_names(pairs, [](const simplification_pair& pair) { return pair.name(); });
  const double panel = (width - left - 60) / 2;
  constexpr double row_height = 46;
  constexpr double top = 62;
  const double bottom = top + row_height * static_cast<double>(pairs.size());
  svg_drawing svg(width, bottom + 44);
  svg.disc(left + 6, 14, 5, colour_of(0), true);
  svg.text(left + 18, 18, "with simplification");
  svg.disc(left + 156, 14, 5, colour_of(0), false);
  svg.text(left + 168, 18, "without");
  double widest = compared.angle_threshold + 10;
  for (const auto& pair : pairs)
    for (const auto& kind : angle_kinds)
      for (const comparison_row* row : {&pair.with, &pair.without})
        if (const double angle = row->*kind.mesh.*kind.angle; !std::isnan(angle))
          widest = std::max(widest, 10 * std::ceil(angle / 10));
  for (std::size_t side = 0; side < 2; ++side) {
    const double begin = left + static_cast<double>(side) * (panel + 40);
    const axis x{0, widest, begin, begin + panel};
    svg.text(begin, top - 12, side == 0 ? "background mesh" : "finished mesh");
    draw_x_axis(svg, x, top, bottom, "smallest angle (degrees)");
    svg.line(x.at(compared.angle_threshold), top, x.at(compared.angle_threshold), bottom, "#c33", 1.2, true);
    for (std::size_t p = 0; p < pairs.size(); ++p)
      for (std::size_t k = 0; k < 2; ++k) {
        if (compared.dimension == 2 && k == 0) // edges have no angles of their own
          continue;
        const auto& kind = angle_kinds[2 * side + k];
        const double y = top + row_height * static_cast<double>(p) + 14 + 18 * static_cast<double>(k);
        if (side == 0)
          svg.text(left - 10, y + 4, compared.dimension == 3 ? kind.name : "corner", text_anchor::end, quiet);
        const double with = pairs[p].with.*kind.mesh.*kind.angle;
        const double without = pairs[p].without.*kind.mesh.*kind.angle;
        if (std::isnan(with) || std::isnan(without))
          continue;
        svg.line(x.at(without), y, x.at(with), y, quiet);
        svg.disc(x.at(without), y, 5, colour_of(k), false, "without: " + fixed(without) + " degrees");
        svg.disc(x.at(with), y, 5, colour_of(k), true, "with: " + fixed(with) + " degrees");
      }
  }
  for (std::size_t p = 0; p < pairs.size(); ++p)
    svg.text(10, top + row_height * static_cast<double>(p) + 27, pairs[p].name());
  return svg.element("Smallest interface angles with and without simplification");
}

} // namespace dovetail::app
