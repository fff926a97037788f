/// @file
/// The list of partitioners that need no library of others. The driver, the contract tests and the documents
/// read it, so a new one is a header and its line here. Adapters are not in it: who includes one has its
/// library.
#pragma once

#include "dovetail/core/policy_list.hpp"
#include "dovetail/partition/greedy.hpp"
#include "dovetail/partition/inertial.hpp"
#include "dovetail/partition/recursive_coordinate.hpp"
#include "dovetail/partition/space_filling_curve.hpp"

namespace dovetail::partition {

/// All of them with the names that the driver knows them by.
inline auto all() {
  // clang-format off
  return std::tuple{
      listed{"greedy", greedy{}},
      listed{"inertial", inertial{}},
      listed{"coordinate", recursive_coordinate{}},
      listed{"hilbert", space_filling_curve{}}
  };
  // clang-format on
}

} // namespace dovetail::partition
