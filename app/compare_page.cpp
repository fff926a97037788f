#include "compare_page.hpp"

#include "base64.hpp"
#include "compare_claim.hpp"
#include "compare_page_template.hpp" // compare_page.html as a string
#include "compare_plots.hpp"
#include "compare_table.hpp"
#include "markup.hpp"

#include <algorithm>
#include <utility>

namespace dovetail::app {
namespace {

using policy = std::string combination::*;
constexpr std::pair<const char*, policy> all_policies[] = {{"partitioner", &combination::partitioner},
                                                           {"mesher", &combination::mesher},
                                                           {"improver", &combination::improver},
                                                           {"simplifier", &combination::simplifier}};

std::string heading(const std::string& text) {
  return element("h2", {}, escaped(text));
}
/// Empty where there are no items.
std::string list_of(const std::vector<std::string>& items) {
  std::string text;
  for (const std::string& item : items)
    text += element("li", {}, item);
  return text.empty() ? text : element("ul", {}, text);
}

/// A policy that is the same in all rows is said once, so that the tables fit.
bool varies(const comparison& compared, policy which) {
  const auto& rows = compared.rows;
  return rows.size() < 2 || std::any_of(rows.begin(), rows.end(), [&](const comparison_row& row) {
           return row.policies.*which != rows.front().policies.*which;
         });
}

std::string introduction(const comparison& compared) {
  std::string same;
  for (const auto& [name, which] : all_policies)
    if (!varies(compared, which))
      same += (same.empty() ? "" : ", ") + std::string(name) + " " + compared.rows.front().policies.*which;
  return paragraph(std::to_string(compared.rows.size()) +
                   " combinations of partitioner, mesher, improver and simplifier of the background mesh; " +
                   std::to_string(compared.workers) + (compared.workers == 1 ? " worker." : " workers.") +
                   (same.empty() ? "" : " In all of them: " + same + "."));
}

std::string claim(const comparison& compared) {
  const bool solid = compared.dimension == 3;
  std::string text =
      heading("The method's claim, as a question") +
      paragraph(
          "Small angles where an interface meets itself, another interface or the " +
          std::string(solid ? "surface" : "model's curves") +
          " force bad elements on every subdomain beside them. The method contracts the background mesh "
          "such that a partitioner cannot choose " +
          (solid ? "faces" : "edges") + " with such angles. Does it keep angles under " +
          fixed(compared.angle_threshold, 0) +
          " degrees away from the interfaces of this model, and at what cost?");
  const auto pairs = pairs_of(compared);
  if (pairs.empty())
    return text + paragraph("No decomposition went well both with and without simplification: no answer.");
  std::vector<std::string> answers;
  for (const std::string& answer : answers_of(compared, pairs))
    answers.push_back(escaped(answer));
  return text + list_of(answers) + plot_of_interfaces(compared, pairs) +
         paragraph("The plot shows, for each partitioner and mesher, the smallest angle " +
                   std::string(solid ? "of an interface's triangles (face) and the smallest angle between an "
                                       "interface and its neighbours (dihedral). "
                                     : "between a line and another one or a CAD curve (corner). ") +
                   "The dashed line is the threshold. Remeshing to the final size curves and refines "
                   "interfaces, so the finished mesh may have smaller angles than the background mesh.");
}

std::string table_html(const comparison& compared, const std::vector<table_column>& columns) {
  std::string head, body;
  for (const auto& [name, which] : all_policies)
    if (varies(compared, which))
      head += element("th", {{"class", "name"}}, name);
  for (const table_column& column : columns)
    head += element("th", {{"title", column.meaning}}, escaped(column.heading));
  for (const comparison_row& row : compared.rows) {
    std::string cells;
    for (const auto& [name, which] : all_policies)
      if (varies(compared, which))
        cells += element("td", {{"class", "name"}}, escaped(row.policies.*which));
    for (const table_column& column : columns) {
      const std::string text = column.text(row);
      cells += element("td", {}, text.empty() ? "-" : escaped(text));
    }
    body += row.failed() ? element("tr", {{"class", "failed"}}, cells) : element("tr", {}, cells);
  }
  return element(
      "div", {{"class", "wide"}},
      element("table", {}, element("thead", {}, element("tr", {}, head)) + element("tbody", {}, body)));
}

std::string failures(const comparison& compared) {
  std::vector<std::string> failed;
  for (const comparison_row& row : compared.rows)
    if (row.failed())
      failed.push_back(escaped(full_name_of(row.policies) + ": " + row.error));
  return failed.empty() ? std::string() : paragraph("Combinations that failed:") + list_of(failed);
}

std::string meanings(const comparison& compared) {
  std::string list;
  for (const auto& columns : {result_columns(compared.dimension), time_columns()})
    for (const table_column& column : columns)
      list += element("dt", {}, escaped(column.heading)) + element("dd", {}, escaped(column.meaning));
  return element("details", {}, element("summary", {}, "What the columns mean") + element("dl", {}, list));
}

std::string gallery(const std::string& title, const std::string& text,
                    const std::vector<captioned_picture>& pictures) {
  if (pictures.empty())
    return {};
  std::string all = heading(title) + paragraph(text);
  for (const auto& [caption, png] : pictures)
    all += element("figure", {},
                   element("img", {{"alt", caption}, {"src", "data:image/png;base64," + base64(png)}}) +
                       element("figcaption", {}, escaped(caption)));
  return all;
}

std::string galleries(const comparison& compared, const comparison_pictures& pictures) {
  const element_words words = words_of(compared.dimension);
  const bool solid = compared.dimension == 3;
  return gallery("Decompositions",
                 "The subdomains of the finished mesh" + std::string(solid ? ", pulled apart" : "") +
                     ": for each partitioner and simplifier, of the first combination that went well.",
                 pictures.decompositions) +
         gallery("Interfaces",
                 "The interfaces between subdomains in the finished mesh, and the model's curves. Red: " +
                     std::string(solid ? "triangles and edges" : "corners") + " with an angle under " +
                     fixed(compared.angle_threshold, 0) + " degrees, drawn in front of everything else.",
                 pictures.interfaces) +
         gallery("Worst elements",
                 "The 200 elements with the smallest " + std::string(words.angle) +
                     "s, enlarged where they are too small to be seen. Red: under " +
                     std::to_string(words.bad) + " degrees; orange: under " + std::to_string(words.low) +
                     "; blue: better. For each mesher and improver, of the first combination that went well.",
                 pictures.worst_elements);
}

std::string origin(const comparison& compared) {
  std::string facts;
  for (const known_fact& fact : compared.origin)
    facts +=
        element("dt", {}, escaped(fact.meaning)) + element("dd", {}, element("code", {}, escaped(fact.text)));
  std::vector<std::string> hashes;
  for (const comparison_row& row : compared.rows)
    if (!row.mesh_hash.empty())
      hashes.push_back(escaped(full_name_of(row.policies) + ": ") +
                       element("code", {}, escaped(row.mesh_hash)));
  return heading("Where this comes from") + (facts.empty() ? "" : element("dl", {}, facts)) +
         (hashes.empty()
              ? ""
              : element("details", {}, element("summary", {}, "Hashes of the meshes") + list_of(hashes)));
}

std::string plots(const comparison& compared) {
  const element_words words = words_of(compared.dimension);
  return heading("Time per stage") + plot_of_times(compared) +
         paragraph("Wall time of the stages, one after the other. Mesher and improver share their stage in "
                   "proportion to what the workers spent on each.") +
         heading("Quality against time") + plot_of_quality(compared) +
         paragraph("A point per combination, hollow without simplification; the lower left is best. A point "
                   "says its name when the pointer rests on it.") +
         heading("Smallest " + std::string(words.angle) + "s") + plot_of_angles(compared) +
         paragraph("How many of a million elements have their smallest " + std::string(words.angle) +
                   " in each degree, for each mesher and improver. The scale is by powers of ten: the bad "
                   "(red, under " +
                   std::to_string(words.bad) + " degrees) and the low (orange, under " +
                   std::to_string(words.low) + ") are what matters, and are few.");
}

} // namespace

std::string page_html(const comparison& compared, const comparison_pictures& pictures) {
  const std::string title = escaped("Comparison on " + compared.model);
  const bool reused = std::any_of(compared.rows.begin(), compared.rows.end(),
                                  [](const comparison_row& row) { return row.background_reused; });
  const std::string body =
      element("h1", {}, title) + introduction(compared) + claim(compared) + heading("Results") +
      table_html(compared, result_columns(compared.dimension)) + failures(compared) +
      element("p", {{"id", "sorts"}, {"hidden", "hidden"}}, "A click on a column's head sorts by it.") +
      meanings(compared) + heading("Seconds") + table_html(compared, time_columns()) +
      (reused ? paragraph("The background mesh depends on the mesher alone. It was made once for each; its "
                          "time is repeated in every row and contained in every total.")
              : "") +
      plots(compared) + galleries(compared, pictures) + origin(compared);
  std::string page = compare_page_template;
  put_in(page, "BODY_OF_THE_COMPARISON", body); // the first, since a name in the title may be any text
  put_in(page, "TITLE_OF_THE_COMPARISON", title);
  return page;
}

} // namespace dovetail::app
