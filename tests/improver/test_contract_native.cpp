/// @file
/// The native improver and the one that does nothing: the contract of all improvers.
#include "dovetail/improver/native.hpp"
#include "improver_contract.hpp"

using namespace improver_contract;

TEST_CASE("the contract of improvers") {
  using dovetail::improvement::native;
  check_whole_contract<native>({"fast", native::fast()});
  check_whole_contract<native>({"fine", native::fine()});
  check_whole_contract<native>({"finest", native::finest()});
  check_whole_contract<dovetail::improvement::none>({"none", {}, false});
}
