/// @file
/// The list of rules. The driver, the contract tests and the documents read it, so a new rule is a header and
/// its line here.
#pragma once

#include "dovetail/core/policy_list.hpp"
#include "dovetail/simplification/aspect_ratio.hpp"
#include "dovetail/simplification/dihedrals_only.hpp"
#include "dovetail/simplification/flow_aligned.hpp"
#include "dovetail/simplification/none.hpp"
#include "dovetail/simplification/paper.hpp"
#include "dovetail/simplification/shape_only.hpp"

namespace dovetail::simplifier {

/// All rules with the names that the driver knows them by; the first is the default.
inline auto all() {
  // clang-format off
  return std::tuple{
      listed{"paper", paper{}},
      listed{"none", none{}},
      listed{"shape", shape_only{}},
      listed{"dihedrals", dihedrals_only{}},
      listed{"aspect", aspect_ratio{}},
      listed{"flow-x", flow_aligned{}}
  };
  // clang-format on
}

} // namespace dovetail::simplifier
