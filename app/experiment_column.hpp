/// @file
/// From a column of the paper to a run, and from the run to what more workers would make of it.
#pragma once

#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>

namespace dovetail::app {

/// What a run is asked for: the paper's column over the scale.
struct wanted_run {
  double elements = 0, background = 0;
  double coarsening = 1;    ///< edge length of the background mesh over the size; 1: there is none
  std::int64_t workers = 1; ///< of the paper's column, of which the machine may have fewer
  int subdomains = 1;       ///< 0: as many as the driver chooses
};

/// Elements and those of the background mesh in the paper's proportion. Ten subdomains per worker as in the
/// paper, but with 5,000 elements each at least, and as many for each worker where there are more than
/// these. Throws `usage_error` for a column without "elements" or "cores".
wanted_run run_for(const nlohmann::ordered_json& column, double scale);

/// The times of a run with a trace as they would be with more workers: its report with "workers" and
/// "seconds" from a simulation. Meshing and improvement are one task, and share its time as in the report.
nlohmann::ordered_json simulated_report(const nlohmann::ordered_json& report,
                                        const std::filesystem::path& trace, std::int64_t workers);

} // namespace dovetail::app
