#include "paper_figures.hpp"

#include "dovetail/core/error.hpp"
#include "paper_figures_text.hpp" // paper_figures.json as a string

namespace dovetail::app {

const nlohmann::ordered_json& paper_figures() {
  static const auto figures = nlohmann::ordered_json::parse(paper_figures_text);
  return figures;
}

const nlohmann::ordered_json& paper_table(const std::string& name) {
  const auto& tables = paper_figures().at("tables");
  if (!tables.contains(name))
    throw usage_error("the figures of the paper have no " + name);
  return tables.at(name);
}

} // namespace dovetail::app
