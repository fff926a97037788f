/// @file
/// The improver from gmsh: the contract of all improvers.
#include "dovetail/adapters/gmsh_improver.hpp"
#include "improver_contract.hpp"

using namespace improver_contract;

TEST_CASE("the contract of improvers") {
  check_whole_contract<dovetail::improvement::gmsh>({"gmsh", {}});
}
