/// @file
/// How long a partitioner takes, for benchmarks.
#pragma once

#include "dovetail/partition/concepts.hpp"

#include <ctime>
#include <vector>

namespace dovetail_benchmark {

/// Processor time, which other programs on the machine do not lengthen.
class processor_clock {
public:
  double seconds() const { return static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC; }

private:
  std::clock_t start_ = std::clock();
};

/// A partitioner that tells how long it took.
template <dovetail::graph_partitioner P>
struct timed {
  P policy;
  double* seconds;
  std::vector<dovetail::local_id> operator()(const dovetail::csr_graph& graph, int parts) const {
    const processor_clock clock;
    auto part = policy(graph, parts);
    *seconds += clock.seconds();
    return part;
  }
};

} // namespace dovetail_benchmark
