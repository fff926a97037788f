/// @file
/// What the method's paper prints in its tables: paper_figures.json.
#pragma once

#include <nlohmann/json.hpp>

#include <string_view>

namespace dovetail::app {

/// "paper": which one; "tables": of each its "place" and its "columns", of each of these the figures by their
/// names. Numbers are as printed, "28M" written out; times in seconds, speeds in elements per second and
/// core.
const nlohmann::ordered_json& paper_figures();

/// One table of them. Throws `usage_error` for one that is not there.
const nlohmann::ordered_json& paper_table(std::string_view name);

} // namespace dovetail::app
