/// @file
/// Figures that several experiments show.
#pragma once

#include "../entire_scheme.hpp"
#include "../experiment.hpp"

#include <string>
#include <utility>
#include <vector>

namespace dovetail::app::experiments {

/// The times of stages in a report.
inline summed seconds_of(const std::vector<std::string>& stages) {
  summed pointers;
  for (const std::string& stage : stages)
    pointers.push_back("/seconds/" + stage);
  return pointers;
}

inline summed decomposition_seconds() {
  return seconds_of(decomposition_parts());
}
inline summed other_seconds() {
  return seconds_of(other_parts());
}
inline summed all_seconds() {
  return seconds_of(scheme_parts());
}

inline experiment_row workers_row() {
  return {"Workers", "", 0, {{"/cores"}}, {{"/workers"}}};
}
inline experiment_row background_row() {
  return {"Background tetrahedra", "", as_count, {{"/background"}}, {{"/background_elements"}}};
}
inline experiment_row elements_row() {
  return {"Tetrahedra", "", as_count, {{"/elements"}}, {{"/elements"}}};
}
inline experiment_row surface_row() {
  return {"Surface triangles", "", as_count, {{"/surface"}}, {{"/boundary_triangles"}}};
}
/// Which the paper has in Table 4 only.
inline experiment_row subdomains_row() {
  return {"Subdomains", "", 0, {}, {{"/subdomains"}}};
}
inline experiment_row scheme_row() {
  return {"Entire scheme", "s", 2, {{"/scheme"}}, {all_seconds()}};
}
inline experiment_row decomposition_row() {
  return {"Domain decomposition", "s", 2, {{"/decomposition"}}, {decomposition_seconds()}};
}
inline experiment_row generation_row() {
  return {"Mesh generation", "s", 2, {{"/generation"}}, {seconds_of({"meshing"})}};
}
inline experiment_row improvement_row() {
  return {"Mesh improvement", "s", 2, {{"/improvement"}}, {seconds_of({"improvement"})}};
}

/// Elements per second and worker, by some of the time: the paper's index of performance.
inline experiment_row speed_row(const std::string& label, const std::string& paper, const summed& ours) {
  return {label,
          "per s and worker",
          as_count,
          {{"/elements"}, {{"/" + paper}, {"/cores"}}},
          {{"/elements"}, {ours, {"/workers"}}}};
}
/// By all of it, as the paper prints it.
inline experiment_row relative_speed_row() {
  experiment_row row = speed_row("Relative speed", "scheme", all_seconds());
  row.paper = {{"/speed"}};
  return row;
}

/// What every table with times has to say.
inline const std::string no_repartitioning =
    "There is no repartitioning between mesh generation and improvement here: each piece is improved where "
    "it "
    "was meshed, in the same task, and the two share the time of a task as the workers spent it.";

/// Tables 2 and 3: what the steps of our method take.
inline std::vector<experiment_row> rows_of_steps() {
  return {
      workers_row(),       background_row(),    elements_row(),
      surface_row(),       subdomains_row(),    scheme_row(),
      decomposition_row(), generation_row(),    {"Mesh repartitioning", "s", 2, {{"/repartitioning"}}, {}},
      improvement_row(),   relative_speed_row()};
}

/// What the simplification is for, before and after remeshing, and what is left of it in the elements.
inline std::vector<experiment_row> interface_rows() {
  const auto small = [](const std::string& of) {
    return summed{of + "/forced", of + "/refused", of + "/remeshing"};
  };
  return {
      subdomains_row(),
      {"Least angle between coarse interfaces", "degrees", 1, {}, {{"/interfaces/coarse/min_dihedral_deg"}}},
      {"Coarse angles under what the rule wants", "", 0, {}, {small("/interfaces/coarse")}},
      {"Least angle between interfaces", "degrees", 1, {}, {{"/interfaces/min_dihedral_deg"}}},
      {"Angles under what the rule wants", "", 0, {}, {small("/interfaces")}},
      {"Smallest dihedral angle", "degrees", 1, {}, {{"/quality/min_dihedral_deg"}}},
      {"Bad, per million", "", 1, {}, {{"/quality/bad_per_million"}}},
      {"Low quality, per million", "", 1, {}, {{"/quality/low_per_million"}}},
      scheme_row()};
}

/// The runs of ours, each on the aircraft with two seeds of the partitioner, and on another model. One run
/// alone says little: where few elements are poor, how many depends on chance.
inline std::vector<experiment_run> on_models_and_seeds(const std::vector<experiment_run>& runs) {
  std::vector<experiment_run> all;
  const auto add = [&](const std::string& label, const std::string& model,
                       const std::vector<std::string>& options) {
    for (experiment_run run : runs) {
      run.label = label + ", " + run.label;
      run.model = model;
      run.options.insert(run.options.end(), options.begin(), options.end());
      all.push_back(std::move(run));
    }
  };
  add("aircraft", "aircraft", {});
  add("aircraft, seed 2", "aircraft", {"--partitioner", "metis:2"});
  add("combustor", "combustor", {});
  return all;
}

/// Runs for columns of one of the paper's tables, on a model.
inline std::vector<experiment_run> runs_of(const std::string& table, const std::string& model,
                                           const std::vector<std::string>& columns) {
  std::vector<experiment_run> runs;
  for (const std::string& column : columns)
    runs.push_back({column, model, table, column, {}});
  return runs;
}

} // namespace dovetail::app::experiments
