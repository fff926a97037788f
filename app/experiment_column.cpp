#include "experiment_column.hpp"

#include "entire_scheme.hpp"

#include "dovetail/core/error.hpp"
#include "dovetail/experiments/simulation/simulate.hpp"
#include "dovetail/files/read_trace.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace dovetail::app {
namespace {

using json = nlohmann::ordered_json;

} // namespace

wanted_run run_for(const json& column, double scale) {
  for (const char* key : {"elements", "cores"})
    if (!column.contains(key))
      throw usage_error(std::string("a column of the paper without ") + key + " says nothing of a run");
  constexpr double workers_share = 10, least_elements = 5000;
  wanted_run wanted;
  const double elements = column.at("elements").get<double>();
  wanted.elements = elements / scale;
  wanted.workers = column.at("cores").get<std::int64_t>();
  if (wanted.workers == 1 || !column.contains("background"))
    return wanted;
  const double background = column.at("background").get<double>();
  wanted.background = background / scale;
  wanted.coarsening = std::max(1.0, std::cbrt(elements / background));
  const auto workers = static_cast<double>(wanted.workers);
  double subdomains = std::floor(std::min(workers_share * workers, wanted.elements / least_elements));
  if (subdomains > workers)
    subdomains -= std::fmod(subdomains, workers);
  wanted.subdomains = std::max(1, static_cast<int>(subdomains));
  return wanted;
}

json simulated_report(const json& report, const std::filesystem::path& trace, std::int64_t workers) {
  const auto run = simulation::simulate(simulation::workload_of(io::read_trace(trace)), {.workers = workers});
  json simulated = report;
  json& seconds = simulated["seconds"];
  const double meshing = seconds.at("meshing").get<double>();
  const double improvement = seconds.at("improvement").get<double>();
  for (json& value : seconds)
    value = 0.0;
  const auto add = [&](const std::string& part, double time) {
    seconds[part] = seconds.value(part, 0.0) + time;
  };
  const double share = meshing + improvement > 0 ? improvement / (meshing + improvement) : 0;
  for (const simulation::simulated_times& stage : run.stages) {
    const std::string part = part_of_stage(stage.stage);
    const double time = whole(stage);
    add(part, part == "meshing" ? time * (1 - share) : time);
    if (part == "meshing")
      add("improvement", time * share);
  }
  seconds["total"] = run.seconds;
  simulated["workers"] = workers;
  return simulated;
}

} // namespace dovetail::app
