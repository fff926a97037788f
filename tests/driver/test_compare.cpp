#include "compare_page.hpp"
#include "compare_table.hpp"
#include "png.hpp"

#include "dovetail/core/xml_tree.hpp"
#include "files/scratch_folder.hpp"
#include "support/refusal.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace dovetail::app {
namespace {

comparison_row row_of(const std::string& partitioner, const std::string& improver, bool simplified) {
  comparison_row row;
  row.policies = {partitioner, "tetgen", improver, simplified ? "paper" : "none"};
  row.elements = 100'000;
  row.subdomains = 4;
  row.imbalance = simplified ? 1.05 : 1.02;
  row.seconds.background = 1.5;
  row.seconds.meshing = 2;
  row.seconds.total = 3.5;
  row.quality.elements = row.elements;
  row.quality.min_dihedrals.bins[11] = 30;
  row.quality.min_dihedrals.bins[50] = row.elements - 30;
  row.quality.min_dihedral_deg = 11.25;
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
    if (row.policies.partitioner == "greedy" && !row.policies.is_simplified())
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

std::vector<const xml_element*> elements_called(const xml_element& root, std::string_view name) {
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
  CHECK(lines[1][column("simplifier")] == "paper");
  CHECK(lines[2][column("simplifier")] == "none");
  CHECK(lines[1][column("elements")] == "100000");
  CHECK(lines[1][column("bad_per_million")] == "300.0");
  CHECK(lines[1][column("min_dihedral_deg")] == "11.25");
  CHECK(lines[1][column("coarse_min_face_deg")] == "30.5");
  CHECK(lines[2][column("coarse_under_30")] == "25");
  CHECK(lines[2][column("fine_min_dihedral_deg")] == "30.0");
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
  CHECK(terminal_text(example()).find("greedy + tetgen + none, simplifier none, failed: "
                                      "partition_error: part 3") != std::string::npos);
}

/// The body of a page as it is without its script.
class static_page {
public:
  explicit static_page(const std::string& page) {
    const std::size_t begin = page.find("<body>"), end = page.find("<script");
    REQUIRE(begin < end);
    REQUIRE(end != std::string::npos);
    text = page.substr(begin, end - begin) + "</body>";
    root = xml_parser(text, "page").parse();
  }
  std::string text;
  xml_element root;
};

/// The items of the first list: what was measured of the method's claim.
std::vector<std::string> answers_on(const static_page& page) {
  std::vector<std::string> answers;
  for (const auto* list : elements_called(page.root, "ul"))
    if (answers.empty())
      for (const auto& item : list->children)
        answers.emplace_back(item.text);
  return answers;
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
  const static_page page(page_html(compared, {}));
  CHECK(answers_on(page).front() == "There are no interfaces in the background mesh.");
  CHECK_FALSE(testing::contains(page.text, "nan"));
  CHECK_FALSE(testing::contains(page.text, "NaN"));
  CHECK_FALSE(testing::contains(page.text, "null"));
  CHECK_FALSE(testing::contains(page.text, "Infinity"));
}

TEST_CASE("the claim is answered with the measured figures, for each partitioner and mesher once") {
  const static_page page(page_html(example(), {}));
  const auto answers = answers_on(page);
  REQUIRE(answers.size() == 4);
  CHECK(testing::has(answers[0], "30.5 degrees with simplification and 14.0 without"));
  CHECK(testing::has(answers[0], "larger with it in 1 of 1 decompositions"));
  CHECK(testing::has(answers[0], "0 with, 25 without"));
  CHECK(testing::has(answers[1], "22.0 degrees with simplification and 13.0 without"));
  CHECK(testing::has(answers[2], "20.0 percent"));
  CHECK(testing::has(answers[3], "1.050 with and 1.020 without"));
  const auto plots = elements_called(page.root, "svg");
  REQUIRE(plots.size() == 4);
  CHECK(plots[0]->attribute("aria-label") == "Smallest interface angles with and without simplification");
  CHECK(elements_called(*plots[0], "circle").size() == 2 + 8); // the legend; two meshes, two kinds of angles
  CHECK(elements_called(*plots[1], "rect").size() == 7 + 6 * 7); // the legend; the stages of what went well
  CHECK(elements_called(*plots[2], "circle").size() == 6);
  CHECK(elements_called(*plots[3], "polyline").size() == 2); // one for each mesher and improver
}

TEST_CASE("each rule of simplification is held against none") {
  comparison compared = example();
  compared.rows.push_back(row_of("metis", "none", true));
  compared.rows.back().policies.simplifier = "shape";
  const static_page page(page_html(compared, {}));
  CHECK(testing::has(answers_on(page)[0], "larger with it in 2 of 2 decompositions"));
  CHECK(testing::has(page.text, ">metis + tetgen, shape<"));
  CHECK(testing::has(page.text, "metis + tetgen + none, simplifier none:"));
}

TEST_CASE("the page is well-formed, complete, and refers to nothing outside") {
  comparison_pictures pictures;
  const auto png = encode_png(raster_image(3, 2));
  pictures.decompositions = {{"metis, with simplification", png}, {"metis, <without>", png}};
  pictures.worst_elements = {{"tetgen + none", png}};
  comparison compared = example();
  compared.model += " </script>";
  const std::string html = page_html(compared, pictures);
  CHECK(html.starts_with("<!DOCTYPE html>"));
  CHECK_FALSE(testing::contains(html, "http"));
  CHECK(html.ends_with("</html>\n"));
  CHECK_FALSE(testing::contains(html, "OF_THE_COMPARISON"));
  const static_page page(html);
  CHECK(testing::has(
      html, "<title>Comparison on a &lt;odd&gt; &amp; &quot;quoted&quot; name &lt;/script&gt;</title>"));
  CHECK(elements_called(page.root, "noscript").empty());
  CHECK(elements_called(page.root, "svg").size() == 4);
  const auto images = elements_called(page.root, "img");
  REQUIRE(images.size() == 3);
  for (const auto* image : images)
    CHECK(image->attribute("src").starts_with("data:image/png;base64,iVBORw0KGgo"));
  CHECK(elements_called(page.root, "link").empty());
  CHECK(elements_called(page.root, "a").empty());
  const auto tables = elements_called(page.root, "tbody");
  REQUIRE(tables.size() == 2);
  for (const auto* table : tables)
    CHECK(table->children.size() == 8);
  // Of the four policies one is the same in all rows, which is said once.
  CHECK(tables[0]->children[0].children.size() == 3 + result_columns(3).size());
  CHECK(tables[1]->children[0].children.size() == 3 + time_columns().size());
  CHECK(tables[0]->children[0].children[3].text == "100000");
  CHECK(tables[0]->children[5].attribute("class") == "failed");
  CHECK(tables[0]->children[5].children[3].text == "-");
  CHECK(elements_called(page.root, "dt").size() == result_columns(3).size() + time_columns().size());
  CHECK(testing::has(page.text, "a &lt;odd&gt; &amp; &quot;quoted&quot; name &lt;/script&gt;"));
  CHECK(testing::has(page.text, "partition_error: part 3 is empty"));
}

TEST_CASE("names of any bytes leave the page well-formed") {
  comparison compared = example();
  compared.model = "BODY_OF_THE_COMPARISON \xff\x01 TITLE_OF_THE_COMPARISON";
  compared.origin = {{"command", "Command", ""}, {"input", "Checksum of \"\xc3\x28\"", "<&>"}};
  const std::string html = page_html(compared, {});
  const static_page page(html);
  CHECK(testing::has(html, "<title>Comparison on BODY_OF_THE_COMPARISON \xef\xbf\xbd\xef\xbf\xbd TITLE_OF"));
  CHECK(testing::has(page.text, "<code>&lt;&amp;&gt;</code>"));
  CHECK(testing::has(page.text, "<code></code>"));
}

TEST_CASE("a page about failures only is still a page") {
  comparison compared = example();
  for (auto& row : compared.rows)
    row.error = "mesher_error: no";
  const static_page page(page_html(compared, {}));
  CHECK(elements_called(page.root, "tr").size() == 18);
  CHECK(answers_on(page).front().starts_with("metis + tetgen + none: mesher_error"));
  CHECK(testing::has(page.text, "no answer"));
}

} // namespace
} // namespace dovetail::app
