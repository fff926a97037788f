/// @file
/// The main of a test that mpirun runs on all ranks: it initialises MPI. Included once, in place of doctest.
#pragma once

#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include "dovetail/distributed/mpi.hpp"
#include "dovetail/parallel/any_communicator.hpp"

#include <boost/mpi/environment.hpp>

#include <cstdio>
#include <cstdlib>

namespace dovetail::testing {

inline any_communicator* world = nullptr; ///< of main

} // namespace dovetail::testing

int main(int argc, char** argv) {
  const boost::mpi::environment started(argc, argv);
  const int expected = argc > 1 ? std::atoi(argv[1]) : 1;
  dovetail::any_communicator all = dovetail::parallel::mpi{};
  if (all.size() != expected) {
    std::fprintf(stderr, "%d ranks were asked for, and there are %d\n", expected, all.size());
    return 1;
  }
  dovetail::testing::world = &all;
  return doctest::Context().run();
}
