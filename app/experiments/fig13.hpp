/// @file
/// Figure 13 of the paper: times of both algorithms, from Tables 2 and 7.
#pragma once

#include "table7.hpp"

namespace dovetail::app::experiments {

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
