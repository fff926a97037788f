#include "dovetail/adapters/netgen.hpp"
#include "mesher/mesher_contract.hpp"

#include <doctest/doctest.h>

using namespace dovetail;

TEST_CASE("Netgen keeps the boundary and fills every shape") {
  contract::check_shapes(mesher::netgen{});
}

TEST_CASE("Netgen's mean edge is the size asked for") {
  contract::check_calibration(mesher::netgen{}, 0.12, 12);
}

TEST_CASE("Netgen follows a graded field") {
  contract::check_grading(mesher::netgen{});
}

TEST_CASE("Netgen is as its traits say: non-manifold boundaries, threads, history") {
  contract::check_non_manifold(mesher::netgen{});
  contract::check_threads_and_history(mesher::netgen{});
}

TEST_CASE("Netgen's failures are typed") {
  contract::check_errors(mesher::netgen{});
  contract::check_self_intersection(mesher::netgen{});
}
