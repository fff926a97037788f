/// @file
/// The improver from netgen: the contract of all improvers.
#include "dovetail/adapters/netgen_improver.hpp"
#include "improver_contract.hpp"

using namespace improver_contract;

TEST_CASE("the contract of improvers") {
  check_whole_contract<dovetail::improvement::netgen>({"netgen", {}});
}
