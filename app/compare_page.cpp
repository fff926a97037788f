#include "compare_page.hpp"

#include "base64.hpp"
#include "compare_page_template.hpp" // compare_page.html as a string
#include "compare_table.hpp"
#include "json_text.hpp"

#include <nlohmann/json.hpp>

#include <utility>

namespace dovetail::app {
namespace {

using json = nlohmann::json;

constexpr std::pair<const char*, double stage_seconds::*> stages[] = {
    {"background mesh", &stage_seconds::background}, {"simplification", &stage_seconds::simplification},
    {"partition", &stage_seconds::partition},        {"skeleton", &stage_seconds::skeleton},
    {"crossings", &stage_seconds::intersection},     {"meshing", &stage_seconds::meshing},
    {"improvement", &stage_seconds::improvement}};

/// Angles that there are not become null, as all NaN do.
json json_of(const interface_row& row) {
  return {{"face", row.min_face_angle},
          {"dihedral", row.min_dihedral},
          {"faces", row.faces},
          {"under", row.under_threshold}};
}

json json_of(const comparison_row& row, const element_words& words) {
  json seconds = json::array();
  for (const auto& [name, member] : stages)
    seconds.push_back(row.seconds.*member);
  const auto& bins = row.quality.min_dihedrals.bins;
  return {{"partitioner", row.policies.partitioner},
          {"mesher", row.policies.mesher},
          {"improver", row.policies.improver},
          {"simplifier", row.policies.simplifier},
          {"error", row.error},
          {"hash", row.mesh_hash},
          {"reused", row.background_reused},
          {"elements", row.elements},
          {"imbalance", row.imbalance},
          {"low", row.quality.per_million_under(words.low)},
          {"histogram", std::vector<std::int64_t>(bins.begin(), bins.begin() + words.best)},
          {"stages", seconds},
          {"total", row.seconds.total},
          {"coarse", json_of(row.coarse)},
          {"fine", json_of(row.fine)}};
}

json table_of(const comparison& compared, const std::vector<table_column>& columns) {
  json table{{"columns", json::array()}, {"cells", json::array()}};
  for (const auto& column : columns)
    table["columns"].push_back({{"heading", column.heading}, {"meaning", column.meaning}});
  for (const auto& row : compared.rows) {
    json cells = json::array();
    for (const auto& column : columns)
      cells.push_back(column.text(row));
    table["cells"].push_back(std::move(cells));
  }
  return table;
}

json json_of(const std::vector<captioned_picture>& pictures) {
  json list = json::array();
  for (const auto& [caption, png] : pictures)
    list.push_back({{"caption", caption}, {"png", base64(png)}});
  return list;
}

} // namespace

std::string page_html(const comparison& compared, const comparison_pictures& pictures) {
  const element_words words = words_of(compared.dimension);
  json origin = json::array();
  for (const auto& fact : compared.origin)
    origin.push_back({{"meaning", fact.meaning}, {"text", fact.text}});
  json data{{"model", compared.model},
            {"origin", std::move(origin)},
            {"dimension", compared.dimension},
            {"workers", compared.workers},
            {"threshold", compared.angle_threshold},
            {"words", {{"angle", words.angle}, {"bad", words.bad}, {"low", words.low}, {"best", words.best}}},
            {"results", table_of(compared, result_columns(compared.dimension))},
            {"seconds", table_of(compared, time_columns())},
            {"stages", json::array()},
            {"rows", json::array()},
            {"pictures",
             {{"decompositions", json_of(pictures.decompositions)},
              {"interfaces", json_of(pictures.interfaces)},
              {"worst_elements", json_of(pictures.worst_elements)}}}};
  for (const auto& [name, member] : stages)
    data["stages"].push_back(name);
  for (const auto& row : compared.rows)
    data["rows"].push_back(json_of(row, words));

  // Names may be any bytes; a "<" in one must not end the script.
  std::string text = text_of_json(data, -1, true);
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at))
    text.replace(at, 1, "\\u003c");
  std::string page = compare_page_template;
  const std::string place = "DATA_OF_THE_COMPARISON";
  return page.replace(page.find(place), place.size(), text);
}

} // namespace dovetail::app
