#include "compare_groups.hpp"
#include "compare_page.hpp"
#include "compare_table.hpp"
#include "png.hpp"

#include "dovetail/core/xml_tree.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

namespace dovetail::app {
namespace {

comparison_row row_of(const std::string& partitioner, const std::string& improver, bool simplified) {
  comparison_row row;
  row.policies = {partitioner, "tetgen", improver, simplified};
  row.elements = 100'000;
  row.subdomains = 4;
  row.imbalance = simplified ? 1.05 : 1.02;
  row.seconds.background = 1.5;
  row.seconds.meshing = 2;
  row.seconds.total = 3.5;
  row.quality.elements = row.elements;
  row.quality.min_wedges.bins[11] = 30;
  row.quality.min_wedges.bins[50] = row.elements - 30;
  row.quality.min_wedge_deg = 11.25;
  row.coarse = {simplified ? 30.5 : 14.0, 31.0, simplified ? 120 : 100, simplified ? 0 : 25};
  row.fine = {simplified ? 22.0 : 13.0, 30.0, 400, simplified ? 3 : 40};
  return row;
}

/// Two partitioners, one of which fails without simplification, and two improvers.
comparison example() {
  comparison compared;
  compared.model = "a <odd> & \"quoted\" name";
  for (const char* partitioner : {"metis", "greedy"})
    for (const char* improver : {"none", "native"})
      for (const bool simplified : {true, false})
        compared.rows.push_back(row_of(partitioner, improver, simplified));
  for (auto& row : compared.rows)
    if (row.policies.partitioner == "greedy" && !row.policies.simplified)
      row.error = "partition_error: part 3 is empty, \"sorry\"";
  return compared;
}

/// The fields of CSV lines.
std::vector<std::vector<std::string>> parsed_csv(const std::string& text) {
  std::vector<std::vector<std::string>> lines(1, {""});
  bool quoted = false;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char c = text[k];
    if (c == '"' && quoted && k + 1 < text.size() && text[k + 1] == '"')
      lines.back().back() += text[++k];
    else if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      lines.back().emplace_back();
    else if (c == '\n' && !quoted)
      lines.push_back({""});
    else
      lines.back().back() += c;
  }
  lines.pop_back();
  return lines;
}

std::vector<const xml_element*> elements_called(const io::xml_element& root, std::string_view name) {
  std::vector<const xml_element*> found;
  if (root.name == name)
    found.push_back(&root);
  for (const auto& child : root.children) {
    const auto inside = elements_called(child, name);
    found.insert(found.end(), inside.begin(), inside.end());
  }
  return found;
}

TEST_CASE("the CSV has a line per row, and all lines have the head's columns") {
  const auto lines = parsed_csv(csv_text(example()));
  REQUIRE(lines.size() == 9);
  for (const auto& line : lines)
    CHECK(line.size() == lines.front().size());
  const auto column = [&](const std::string& key) {
    const auto at = std::find(lines.front().begin(), lines.front().end(), key);
    REQUIRE_MESSAGE(at != lines.front().end(), key);
    return static_cast<std::size_t>(at - lines.front().begin());
  };
  CHECK(lines[1][column("partitioner")] == "metis");
  CHECK(lines[1][column("simplification")] == "with");
  CHECK(lines[2][column("simplification")] == "without");
  CHECK(lines[1][column("elements")] == "100000");
  CHECK(lines[1][column("bad_per_million")] == "300.0");
  CHECK(lines[1][column("min_dihedral_deg")] == "11.25");
  CHECK(lines[1][column("coarse_min_face_deg")] == "30.5");
  CHECK(lines[2][column("coarse_under_30")] == "25");
  CHECK(lines[2][column("fine_min_wedge_deg")] == "30.0");
  CHECK(lines[1][column("cut")] == "120");
  CHECK(lines[1][column("imbalance")] == "1.050");
  CHECK(lines[1][column("seconds_meshing")] == "2.00");
}

TEST_CASE("a combination that failed is a row with its error and without figures") {
  const auto lines = parsed_csv(csv_text(example()));
  const auto& failed = lines[6];
  CHECK(failed[0] == "greedy");
  CHECK(failed[4] == "partition_error: part 3 is empty, \"sorry\"");
  CHECK(
      std::all_of(failed.begin() + 6, failed.end(), [](const std::string& field) { return field.empty(); }));
  CHECK(terminal_text(example()).find("greedy + tetgen + none, without simplification, failed: "
                                      "partition_error: part 3") != std::string::npos);
}

TEST_CASE("without interfaces there are no angles") {
  comparison compared = example();
  compared.rows.resize(2);
  for (auto& row : compared.rows)
    row.coarse = row.fine = {};
  const auto lines = parsed_csv(csv_text(compared));
  const auto& head = lines.front();
  const auto at =
      static_cast<std::size_t>(std::find(head.begin(), head.end(), "coarse_min_face_deg") - head.begin());
  CHECK(lines[1][at].empty());
  CHECK(answer_to_the_claim(compared).front() == "There are no interfaces in the background mesh.");
  CHECK(page_html(compared, {}).find("nan") == std::string::npos);
}

TEST_CASE("with and without simplification are paired once for each partitioner and mesher") {
  const auto pairs = simplification_pairs(example());
  REQUIRE(pairs.size() == 1);
  CHECK(pairs[0].name() == "metis + tetgen");
  CHECK(pairs[0].with.policies.simplified);
  CHECK_FALSE(pairs[0].without.policies.simplified);
  CHECK(first_of_each_meshing(example()).size() == 2);
}

TEST_CASE("the claim is answered with the measured figures") {
  const auto answers = answer_to_the_claim(example());
  REQUIRE(answers.size() == 4);
  CHECK(answers[0].find("30.5 degrees with simplification and 14.0 without") != std::string::npos);
  CHECK(answers[0].find("0 with, 25 without") != std::string::npos);
  CHECK(answers[1].find("22.0 degrees with simplification and 13.0 without") != std::string::npos);
  CHECK(answers[2].find("20.0 percent") != std::string::npos);
  CHECK(answers[3].find("1.050 with and 1.020 without") != std::string::npos);
  comparison failed = example();
  for (auto& row : failed.rows)
    row.error = "mesher_error: no";
  CHECK(answer_to_the_claim(failed).empty());
}

TEST_CASE("the page is well-formed, complete, and refers to nothing outside") {
  comparison_pictures pictures;
  const auto png = encode_png(raster_image(3, 2));
  pictures.decompositions = {{"metis, with simplification", png}, {"metis, <without>", png}};
  pictures.worst_elements = {{"tetgen + none", png}};
  const std::string page = page_html(example(), pictures);
  CHECK(page.starts_with("<!DOCTYPE html>"));
  const auto root = xml_parser(page, "page").parse();
  CHECK(root.name == "html");
  CHECK(elements_called(root, "svg").size() == 4);
  const auto images = elements_called(root, "img");
  REQUIRE(images.size() == 3);
  for (const auto* image : images)
    CHECK(image->attribute("src").starts_with("data:image/png;base64,iVBORw0KGgo"));
  CHECK(elements_called(root, "link").empty());
  CHECK(elements_called(root, "a").empty());
  CHECK(page.find("src=\"http") == std::string::npos);
  const auto tables = elements_called(root, "tbody");
  REQUIRE(tables.size() == 2);
  for (const auto* table : tables)
    CHECK(table->children.size() == 8);
  CHECK(page.find("a &lt;odd&gt; &amp; &quot;quoted&quot; name") != std::string::npos);
  CHECK(page.find("partition_error: part 3 is empty") != std::string::npos);
}

TEST_CASE("a page about failures only is still a page") {
  comparison compared = example();
  for (auto& row : compared.rows)
    row.error = "mesher_error: no";
  const auto root = xml_parser(page_html(compared, {}), "page").parse();
  CHECK(elements_called(root, "tr").size() == 18);
  CHECK(page_html(compared, {}).find("no answer") != std::string::npos);
}

} // namespace
} // namespace dovetail::app
