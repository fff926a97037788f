/// @file
/// Figure 15 of the paper: times and speedups of both algorithms for its largest mesh, from Table 9.
#pragma once

#include "table9.hpp"

namespace dovetail::app::experiments {

inline experiment fig15() {
  const std::vector<std::string> workers = {"32", "64", "128", "256", "512"};
  experiment result{
      .name = "fig15",
      .title = "Times and speedups of both algorithms for the fourth aircraft",
      .runs = table9().runs,
      .rows = rows_of_both("", "_2"),
      .notes = notes_on_second,
      .plots = {
          {"Entire scheme", "Workers", {"Algorithm 1", second_algorithm}, workers, true},
          {"Speedup", "Workers", {"Speedup of Algorithm 1", "Speedup of " + second_algorithm}, workers}}};
  add_speedups(result.rows);
  return result;
}

} // namespace dovetail::app::experiments
