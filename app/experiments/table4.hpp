/// @file
/// Table 4 of the paper: the steps of domain decomposition.
#pragma once

#include "common.hpp"

namespace dovetail::app::experiments {

inline experiment table4() {
  return {
      .name = "table4",
      .title = "Domain decomposition of the third aircraft",
      .runs = runs_of("table4", "aircraft", {"16", "32", "64", "128"}),
      .rows = {workers_row(),
               background_row(),
               elements_row(),
               {"Subdomains before any is merged", "", 0, {{"/subdomains"}}, {{"/subdomains", "/merges"}}},
               decomposition_row(),
               {"Background mesh", "s", 2, {{"/background_seconds"}}, {seconds_of({"background"})}},
               {"Simplification and partition",
                "s",
                2,
                {{"/simplification"}},
                {seconds_of({"simplification", "partition"})}},
               {"Intersection detection", "s", 2, {{"/intersection"}}, {seconds_of({"intersection"})}},
               {"Remeshing of subdomain boundaries", "s", 2, {{"/remeshing"}}, {seconds_of({"skeleton"})}},
               {"Subdomains merged away", "", 0, {{"/merged"}}, {{"/merges"}}},
               {"Subdomains merged into one, at most", "", 0, {{"/largest"}}, {{"/largest_merged"}}}},
      .notes = {"Of ours, the intersection's time is also that of measuring interface angles and of local "
                "repartition. Lines that cross are refined before anything is merged, which takes time of "
                "the remeshing."}};
}

} // namespace dovetail::app::experiments
