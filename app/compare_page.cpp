#include "compare_page.hpp"

#include "compare_groups.hpp"
#include "compare_plots.hpp"
#include "compare_svg.hpp"
#include "compare_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <span>

namespace dovetail::app {
namespace {

constexpr const char* style = R"(
body { font: 16px/1.5 system-ui, sans-serif; color: #222; background: #fff; max-width: 1140px;
       margin: 2em auto; padding: 0 1em; }
h1 { font-size: 1.6em; } h2 { font-size: 1.2em; margin-top: 2em; }
table { border-collapse: collapse; font-size: 13px; font-variant-numeric: tabular-nums; }
.wide { overflow-x: auto; }
th, td { padding: 3px 6px; border-bottom: 1px solid #ddd; text-align: right; white-space: nowrap; }
th { border-bottom: 2px solid #888; cursor: pointer; vertical-align: bottom; white-space: normal; }
.name { text-align: left; }
tr.failed td { color: #b00; }
svg { max-width: 100%; height: auto; }
figure { display: inline-block; width: 48%; margin: 0 1% 1em 0; vertical-align: top; }
figure img { width: 100%; height: auto; border: 1px solid #ddd; }
figcaption { font-size: 14px; color: #444; }
dt { font-weight: 600; } dd { margin: 0 0 .4em 1.5em; }
)";

/// Sorts a table by the column whose head is clicked, the other way round at the second click. Kept free of
/// characters that XML would want escaped.
constexpr const char* script = R"(
for (const head of document.querySelectorAll("table.sortable th")) head.onclick = function () {
  const body = head.closest("table").tBodies[0];
  const direction = head.dataset.sorted === "up" ? -1 : 1;
  head.dataset.sorted = direction === 1 ? "up" : "down";
  const text = function (row) { return row.cells[head.cellIndex].textContent; };
  const order = function (a, b) {
    const difference = parseFloat(text(a)) - parseFloat(text(b));
    return direction * (isNaN(difference) ? text(a).localeCompare(text(b)) : difference);
  };
  Array.from(body.rows).sort(order).forEach(function (row) { body.append(row); });
};
)";

std::string base64(std::span<const std::uint8_t> bytes) {
  constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - k);
    std::uint32_t group = 0;
    for (std::size_t i = 0; i < 3; ++i)
      group = group << 8 | (i < count ? bytes[k + i] : 0U);
    for (std::size_t i = 0; i < 4; ++i)
      text += i <= count ? digits[group >> (18 - 6 * i) & 63U] : '=';
  }
  return text;
}

std::string element(const std::string& name, const std::string& content, const std::string& attributes = {}) {
  std::string text = "<";
  text += name;
  if (!attributes.empty())
    text += ' ' + attributes;
  text += '>' + content;
  return text + "</" + name + ">\n";
}

std::string paragraph(const std::string& words) {
  return element("p", escaped(words));
}

std::string section(const std::string& title) {
  return element("h2", escaped(title));
}

std::string table_of(const comparison& compared, const std::vector<table_column>& columns) {
  std::string head;
  for (const char* name : {"partitioner", "mesher", "improver", "simplification"})
    head += element("th", name, "class=\"name\"");
  for (const auto& column : columns)
    head += element("th", escaped(column.heading), "title=\"" + escaped(column.meaning) + "\"");
  std::string body;
  for (const auto& row : compared.rows) {
    const combination& by = row.policies;
    std::string cells;
    for (const auto& name : {by.partitioner, by.mesher, by.improver, std::string(simplification_of(by))})
      cells += element("td", escaped(name), "class=\"name\"");
    for (const auto& column : columns) {
      const std::string text = column.text(row);
      cells += element("td", text.empty() ? "-" : text);
    }
    body += element("tr", cells, row.failed() ? "class=\"failed\"" : "");
  }
  return element(
      "div",
      element("table", element("thead", element("tr", head)) + element("tbody", body), "class=\"sortable\""),
      "class=\"wide\"");
}

std::string failures_of(const comparison& compared) {
  std::string items;
  for (const auto& row : compared.rows)
    if (row.failed())
      items += element("li", escaped(name_of(row.policies) + ", " + simplification_of(row.policies) +
                                     " simplification: " + row.error));
  return items.empty() ? "" : paragraph("Combinations that failed:") + element("ul", items);
}

std::string meanings(int dimension) {
  std::string list;
  for (const auto& columns : {result_columns(dimension), time_columns()})
    for (const auto& column : columns)
      list += element("dt", escaped(column.heading)) + element("dd", escaped(column.meaning));
  return element("details", element("summary", "What the columns mean") + element("dl", list));
}

/// Least and largest of a figure over the pairs; NaN without any.
struct range {
  double least = std::nan("");
  double largest = std::nan("");

  void include(double value) {
    least = std::fmin(least, value);
    largest = std::fmax(largest, value);
  }
  std::string text(int decimals) const {
    const std::string from = fixed(least, decimals);
    const std::string to = fixed(largest, decimals);
    return from == to ? from : from + " to " + to;
  }
};

range range_of(const std::vector<simplification_pair>& pairs,
               const std::function<double(const simplification_pair&)>& figure) {
  range all;
  for (const auto& pair : pairs)
    all.include(figure(pair));
  return all;
}

/// The smallest angle of either kind.
double smallest(const interface_row& row) {
  return std::fmin(row.min_face_angle, row.min_wedge);
}

std::string sentence_on_angles(const std::vector<simplification_pair>& pairs, const char* mesh,
                               interface_row comparison_row::*interfaces) {
  const auto angle = [&](const comparison_row& row) { return smallest(row.*interfaces); };
  const range with = range_of(pairs, [&](const auto& pair) { return angle(pair.with); });
  const range without = range_of(pairs, [&](const auto& pair) { return angle(pair.without); });
  if (std::isnan(with.least) || std::isnan(without.least))
    return std::string("There are no interfaces in the ") + mesh + ".";
  const auto better = std::count_if(pairs.begin(), pairs.end(),
                                    [&](const auto& pair) { return angle(pair.with) > angle(pair.without); });
  const range count_with =
      range_of(pairs, [&](const auto& pair) { return double((pair.with.*interfaces).under_threshold); });
  const range count_without =
      range_of(pairs, [&](const auto& pair) { return double((pair.without.*interfaces).under_threshold); });
  return std::string("In the ") + mesh + ", the smallest interface angle is " + with.text(1) +
         " degrees with simplification and " + without.text(1) + " without; it is larger with it in " +
         std::to_string(better) + " of " + std::to_string(pairs.size()) +
         " decompositions. Angles under the threshold: " + count_with.text(0) + " with, " +
         count_without.text(0) + " without.";
}

std::string claim_section(const comparison& compared) {
  std::string text = section("The method's claim, as a question");
  text += paragraph("Small angles where an interface meets itself, another interface or the " +
                    std::string(compared.dimension == 3 ? "surface" : "model's curves") +
                    " force bad elements on every subdomain beside them. The method contracts the background "
                    "mesh such that a "
                    "partitioner cannot choose " +
                    (compared.dimension == 3 ? "faces" : "edges") +
                    " with such angles. Does it keep angles under " + fixed(compared.angle_threshold, 0) +
                    " degrees away from the interfaces of this model, and at what price?");
  const auto answers = answer_to_the_claim(compared);
  if (answers.empty())
    return text + paragraph("No decomposition went well both with and without simplification: no answer.");
  std::string items;
  for (const auto& answer : answers)
    items += element("li", escaped(answer));
  return text + element("ul", items) + interfaces_plot(compared) +
         paragraph(
             std::string("The plot shows, for each partitioner and mesher, the smallest angle ") +
             (compared.dimension == 3
                  ? "of an interface's triangles (face) and the smallest angle between an interface and its "
                    "neighbours (wedge). "
                  : "between a line and another one or a CAD curve (corner). ") +
             "The dashed line is the threshold. Remeshing to the final size curves and refines interfaces, "
             "so the finished "
             "mesh may have smaller angles than the background mesh.");
}

std::string gallery(const std::string& title, const std::string& words,
                    const std::vector<captioned_picture>& pictures) {
  if (pictures.empty())
    return {};
  std::string text = section(title) + paragraph(words);
  for (const auto& [caption, png] : pictures) {
    std::string image = "<img alt=\"" + escaped(caption) + "\" src=\"data:image/png;base64,";
    image += base64(png) + "\"/>\n";
    text += element("figure", image + element("figcaption", escaped(caption)));
  }
  return text;
}

std::string plots_section(const comparison& compared) {
  const element_words words = words_of(compared.dimension);
  const std::string angle = words.angle;
  return section("Time per stage") + times_plot(compared) +
         paragraph("Wall time of the stages, one after the other. Mesher and improver share their stage in "
                   "proportion to what the workers spent on each.") +
         section("Quality against time") + quality_plot(compared) +
         paragraph("A point per combination, hollow without simplification; the lower left is best. A point "
                   "says its "
                   "name when the pointer rests on it.") +
         section("Smallest " + angle + "s") + histogram_plot(compared) +
         paragraph(
             "How many of a million elements have their smallest " + angle +
             " in each degree, for each mesher and improver. The scale is by powers of ten: the bad (red, "
             "under " +
             std::to_string(words.bad) + " degrees) and the low (orange, under " + std::to_string(words.low) +
             ") are what matters, and are few.");
}

} // namespace

std::vector<std::string> answer_to_the_claim(const comparison& compared) {
  const auto pairs = simplification_pairs(compared);
  if (pairs.empty())
    return {};
  const auto percent = [](const simplification_pair& pair) {
    return pair.without.coarse.faces == 0 ? std::nan("")
                                          : 100.0 * static_cast<double>(pair.with.coarse.faces) /
                                                    static_cast<double>(pair.without.coarse.faces) -
                                                100;
  };
  std::vector<std::string> answers{sentence_on_angles(pairs, "background mesh", &comparison_row::coarse),
                                   sentence_on_angles(pairs, "finished mesh", &comparison_row::fine)};
  if (const range cut = range_of(pairs, percent); !std::isnan(cut.least))
    answers.push_back("The cut, in " + std::string(compared.dimension == 3 ? "faces" : "edges") +
                      " of the background mesh, changes by " + cut.text(1) + " percent.");
  answers.push_back(
      "The imbalance, largest subdomain over the average in elements, is " +
      range_of(pairs, [](const auto& pair) { return pair.with.imbalance; }).text(3) + " with and " +
      range_of(pairs, [](const auto& pair) { return pair.without.imbalance; }).text(3) + " without.");
  return answers;
}

std::string page_html(const comparison& compared, const comparison_pictures& pictures) {
  const std::string title = "Comparison on " + compared.model;
  std::string body = element("h1", escaped(title));
  body += paragraph(std::to_string(compared.rows.size()) +
                    " combinations of partitioner, mesher and improver, with " +
                    "and without simplification of the background mesh; " + std::to_string(compared.workers) +
                    (compared.workers == 1 ? " worker." : " workers."));
  body += claim_section(compared);
  body += section("Results") + table_of(compared, result_columns(compared.dimension)) + failures_of(compared);
  body += paragraph("A click on a column's head sorts by it.") + meanings(compared.dimension);
  body += section("Seconds") + table_of(compared, time_columns());
  if (std::any_of(compared.rows.begin(), compared.rows.end(),
                  [](const comparison_row& row) { return row.background_reused; }))
    body +=
        paragraph("The background mesh depends on the mesher alone. It was made once for each; its time is "
                  "repeated in every row and contained in every total.");
  body += plots_section(compared);
  const element_words words = words_of(compared.dimension);
  body += gallery(
      "Decompositions",
      "The subdomains of the finished mesh" + std::string(compared.dimension == 3 ? ", pulled apart" : "") +
          ": for each partitioner, with and without simplification, of the first combination that "
          "went well.",
      pictures.decompositions);
  body += gallery("Interfaces",
                  "The interfaces between subdomains in the finished mesh, and the model's curves. Red: " +
                      std::string(compared.dimension == 3 ? "triangles and edges" : "corners") +
                      " with an angle under " + fixed(compared.angle_threshold, 0) +
                      " degrees, drawn in front of everything else.",
                  pictures.interfaces);
  body +=
      gallery("Worst elements",
              "The 200 elements with the smallest " + std::string(words.angle) +
                  "s, enlarged where they are too small to be seen. Red: under " + std::to_string(words.bad) +
                  " degrees; orange: under " + std::to_string(words.low) +
                  "; blue: better. For each mesher and improver, of the first combination that went well.",
              pictures.worst_elements);
  body += element("script", script);
  const std::string head = "<meta charset=\"utf-8\"/>\n" +
                           std::string("<meta name=\"viewport\" content=\"width=device-width\"/>\n") +
                           element("title", escaped(title)) + element("style", style);
  return "<!DOCTYPE html>\n" + element("html", element("head", head) + element("body", body), "lang=\"en\"");
}

} // namespace dovetail::app
