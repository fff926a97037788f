/// @file
/// The paper's Algorithm 1, which is ours, beside its Algorithm 2, which bisects the fine surface.
#pragma once

#include "common.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::app::experiments {

inline const std::string second_algorithm = "Algorithm 2";

inline summed of_second(summed pointers) {
  for (std::string& pointer : pointers)
    pointer.insert(0, "/" + second_algorithm);
  return pointers;
}

/// Runs for columns of a table of Algorithm 1, and beside each one for that of Algorithm 2.
inline std::vector<experiment_run> runs_of_both(const std::string& table, const std::string& second_table,
                                                const std::vector<std::string>& columns) {
  std::vector<experiment_run> runs = runs_of(table, "aircraft", columns);
  for (experiment_run& run : runs) {
    experiment_run second{second_algorithm, run.model, second_table, run.column};
    second.options = {"--decomposition", "bisection"};
    second.has_background = false;
    run.beside = {second};
  }
  return runs;
}

/// Of the report of Algorithm 2: the fine surface, with the coarse one that it is made from.
inline summed surface_seconds() {
  return of_second(seconds_of({"background", "skeleton", "intersection"}));
}
inline summed bisection_seconds() {
  return of_second(seconds_of({"bisection"}));
}
inline summed second_scheme_seconds() {
  return of_second(all_seconds());
}

/// The rows of Algorithm 2. `paper` is before the keys of its figures in the paper's column, and `suffix`
/// after them.
inline std::vector<experiment_row> second_rows(const std::string& paper, const std::string& suffix = "") {
  const auto printed = [&](const std::string& key) { return figure{{paper + "/" + key + suffix}}; };
  const auto label = [](const std::string& of) { return second_algorithm + ": " + of; };
  const summed workers = of_second({"/workers"}), elements = of_second({"/elements"});
  return {{label("tetrahedra"), "", as_count, {}, {elements}},
          {label("subdomains"), "", 0, {}, {of_second({"/subdomains"})}},
          {label("entire scheme"), "s", 2, printed("scheme"), {second_scheme_seconds()}},
          {label("surface meshing"), "s", 2, printed("surface_meshing"), {surface_seconds()}},
          {label("domain decomposition"), "s", 2, printed("decomposition"), {bisection_seconds()}},
          {label("other steps"), "s", 2, printed("other"), {of_second(other_seconds())}},
          {label("relative speed"),
           "per s and worker",
           as_count,
           printed("speed"),
           {elements, {second_scheme_seconds(), workers}}}};
}

/// How much longer Algorithm 2 takes.
inline experiment_row gap_row(const std::string& paper) {
  return {
      "Performance gap", "%", 1, {{paper}}, {second_scheme_seconds(), {all_seconds()}, all_seconds(), 100}};
}

inline const std::vector<std::string> notes_on_second = {
    "Algorithm 2 has as many subdomains as Algorithm 1 is asked for, unless no plane divides them further.",
    "Surface meshing of Algorithm 2 is by our own surface step, with the coarse surface that it begins with.",
    no_repartitioning};

/// A table of Algorithm 2, with the times of ours that it is held against.
inline experiment table_of_second(const std::string& name, const std::string& title,
                                  std::vector<experiment_run> runs) {
  experiment result{.name = name,
                    .title = title,
                    .runs = std::move(runs),
                    .rows = second_rows("/" + second_algorithm),
                    .notes = notes_on_second};
  result.rows.insert(result.rows.begin(), {workers_row(), scheme_row()});
  result.rows[1].label = "Algorithm 1: entire scheme";
  result.rows.push_back(gap_row("/" + second_algorithm + "/gap"));
  return result;
}

/// Times of both algorithms and of their decompositions. `paper` and `suffix` are those of `second_rows`.
inline std::vector<experiment_row> rows_of_both(const std::string& paper, const std::string& suffix = "") {
  const auto printed = [&](const std::string& key) { return figure{{paper + "/" + key + suffix}}; };
  return {workers_row(),
          elements_row(),
          {"Algorithm 1", "s", 2, {{"/scheme"}}, {all_seconds()}},
          {"Decomposition of Algorithm 1", "s", 2, {{"/decomposition"}}, {decomposition_seconds()}},
          {second_algorithm, "s", 2, printed("scheme"), {second_scheme_seconds()}},
          {"Decomposition of " + second_algorithm, "s", 2, printed("decomposition"), {bisection_seconds()}}};
}

/// Of the entire schemes, over the run with the fewest workers.
inline void add_speedups(std::vector<experiment_row>& rows) {
  for (const std::string& of : {std::string("Algorithm 1"), second_algorithm}) {
    experiment_row row =
        *std::find_if(rows.begin(), rows.end(), [&](const experiment_row& each) { return each.label == of; });
    row.label = "Speedup of " + of;
    row.unit = "";
    row.over_first = true;
    rows.push_back(row);
  }
}

} // namespace dovetail::app::experiments
