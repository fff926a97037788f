/// @file
/// Figure 14 of the paper: times and speedups of both algorithms for one mesh, from Tables 3 and 8.
#pragma once

#include "table8.hpp"

namespace dovetail::app::experiments {

inline experiment fig14() {
  const std::vector<std::string> workers = {"16", "32", "64", "128"};
  experiment result{
      .name = "fig14",
      .title = "Times and speedups of both algorithms by workers",
      .runs = table8().runs,
      .rows = rows_of_both("/" + second_algorithm),
      .notes = notes_on_second,
      .plots = {
          {"Domain decomposition",
           "Workers",
           {"Decomposition of Algorithm 1", "Decomposition of " + second_algorithm},
           workers,
           true},
          {"Entire scheme", "Workers", {"Algorithm 1", second_algorithm}, workers, true},
          {"Speedup", "Workers", {"Speedup of Algorithm 1", "Speedup of " + second_algorithm}, workers}}};
  add_speedups(result.rows);
  return result;
}

} // namespace dovetail::app::experiments
