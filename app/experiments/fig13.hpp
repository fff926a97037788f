/// @file
/// Figure 13 of the paper: times of both algorithms, from Tables 2 and 7.
#pragma once

#include "table7.hpp"

#include <algorithm>

namespace dovetail::app::experiments {

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

inline experiment fig13() {
  const std::vector<std::string> sizes = {"F16-I", "F16-II", "F16-III", "F16-IV"};
  return {.name = "fig13",
          .title = "Times of both algorithms by elements",
          .runs = table7().runs,
          .rows = rows_of_both("/" + second_algorithm),
          .notes = notes_on_second,
          .plots = {{"Times by elements",
                     "Tetrahedra",
                     {"Algorithm 1", "Decomposition of Algorithm 1", second_algorithm,
                      "Decomposition of " + second_algorithm},
                     sizes,
                     true}}};
}

} // namespace dovetail::app::experiments
