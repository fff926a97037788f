#include "paper_figures.hpp"

#include "dovetail/core/error.hpp"
#include "paper_figures_text.hpp" // paper_figures.json as a string

#include <string>

namespace dovetail::app {

const nlohmann::ordered_json& paper_figures() {
  static const auto figures = nlohmann::ordered_json::parse(paper_figures_text);
  return figures;
}

const nlohmann::ordered_json& paper_table(std::string_view name) {
  const auto& tables = paper_figures().at("tables");
  const auto table = tables.find(std::string(name));
  if (table == tables.end())
    throw usage_error("the figures of the paper have no " + std::string(name));
  return *table;
}

} // namespace dovetail::app
