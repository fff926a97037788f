#include "commands.hpp"
#include "entire_scheme.hpp"
#include "failure.hpp"
#include "fixed.hpp"
#include "paper_figures.hpp"
#include "terminal_progress.hpp"

#include "dovetail/core/error.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/experiments/simulation/memory.hpp"
#include "dovetail/experiments/simulation/workload.hpp"
#include "dovetail/files/read_trace.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

namespace dovetail::app {
namespace {

simulation::workload wanted_work(const simulate_options& options) {
  std::vector<simulation::workload> known;
  for (const std::string& trace : options.traces)
    known.push_back(simulation::workload_of(io::read_trace(trace)));
  std::sort(known.begin(), known.end(), [](const auto& a, const auto& b) { return a.elements < b.elements; });
  if (!options.elements && known.size() > 1)
    throw command_line_error("several traces are for another number of elements; give --elements or one "
                             "trace");
  if (!(known.front().elements > 0))
    throw usage_error("a trace of a run that made no elements cannot be simulated");
  if (!options.elements)
    return known.front();
  if (known.size() != 2)
    throw command_line_error("--elements: a law needs two traces of different sizes; give a smaller and a "
                             "larger one");
  const std::string& one = known.front().subject;
  const std::string& other = known.back().subject;
  if (!one.empty() && !other.empty() && one != other)
    std::fprintf(stderr, "warning: the traces are of %s and of %s; a law needs two of one model\n",
                 one.c_str(), other.c_str());
  return simulation::scaled_to(*options.elements, known.front(), known.back());
}

double seconds_in(const std::vector<std::string>& parts, const simulation::simulated_run& run) {
  double seconds = 0;
  for (const simulation::simulated_times& stage : run.stages)
    if (std::find(parts.begin(), parts.end(), part_of_stage(stage.stage)) != parts.end())
      seconds += whole(stage);
  return seconds;
}

/// One column per number of workers.
class columns {
public:
  void row(const std::string& label, const std::function<std::string(std::size_t)>& value) {
    std::printf("  %-38s", label.c_str());
    for (std::size_t k = 0; k < count_; ++k)
      std::printf(" %9s", value(k).c_str());
    std::printf("\n");
  }
  explicit columns(std::size_t count) : count_(count) {}

private:
  std::size_t count_;
};

/// What the paper measured of its Algorithm 1 with as many cores.
void print_paper(const std::vector<std::int64_t>& workers) {
  const auto& measured = paper_table("table9").at("columns");
  columns table(workers.size());
  const auto row = [&](const char* label, const char* figure, int digits) {
    table.row(label, [&](std::size_t k) {
      const auto column = measured.find(std::to_string(workers[k]));
      return column == measured.end() ? "-" : fixed(column->at(figure).get<double>(), digits);
    });
  };
  std::printf("Measured by the paper, Table 9, about 1 billion tetrahedra of an aircraft\n");
  row("Entire scheme (s)", "scheme", 1);
  row("  Domain decomposition", "decomposition", 1);
  row("  Other steps", "other", 1);
  row("Relative speed (elements/s/core)", "speed", 0);
}

/// Every stage that takes a hundredth of a second, how much of it no worker shares, and which takes longest.
void print_stages(const std::vector<simulation::simulated_run>& runs,
                  const std::vector<std::int64_t>& workers) {
  constexpr double shortest = 0.01;
  columns table(runs.size());
  std::printf("Stages (s), and what of them is not spread over workers\n");
  for (std::size_t s = 0; s < runs.front().stages.size(); ++s) {
    const auto stage = [&](std::size_t k) -> const simulation::simulated_times& { return runs[k].stages[s]; };
    const auto not_spread = [&](std::size_t k) { return stage(k).alike + stage(k).once; };
    const auto in_any = [&](const auto& seconds) {
      for (std::size_t k = 0; k < runs.size(); ++k)
        if (seconds(k) >= shortest)
          return true;
      return false;
    };
    if (in_any([&](std::size_t k) { return whole(stage(k)); }))
      table.row(stage(0).stage, [&](std::size_t k) { return fixed(whole(stage(k)), 2); });
    if (in_any(not_spread))
      table.row("  not spread", [&](std::size_t k) { return fixed(not_spread(k), 2); });
  }
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const auto& most = simulation::bottleneck(runs[k]);
    std::printf("With %lld workers %s takes longest\n", static_cast<long long>(workers[k]),
                most.stage.c_str());
  }
}

/// What a node needs for a rank with one worker on each core, and for one rank with all of them.
void print_memory(const simulate_options& options, const mesh_sizes& sizes) {
  if (!sizes.are_known()) {
    std::printf("Memory of a node: not known, as a trace does not say how large background, skeleton and "
                "largest piece are; make it again by mesh --trace\n");
    return;
  }
  struct arrangement {
    const char* name;
    bool one_rank;
  };
  constexpr double gigabyte = 1e9;
  columns table(options.workers.size());
  std::printf("Memory of a node (GB), with up to %lld workers on it\n",
              static_cast<long long>(*options.cores_per_node));
  std::string exceeded;
  for (const arrangement& on_node : {arrangement{"ranks of one worker", false}, {"one rank", true}}) {
    const auto needed = [&](std::size_t k) {
      const std::int64_t workers = std::min(options.workers[k], *options.cores_per_node);
      const simulation::rank_memory memory;
      return (on_node.one_rank ? memory.of_node(sizes, 1, workers) : memory.of_node(sizes, workers, 1)) /
             gigabyte;
    };
    table.row(std::string("  ") + on_node.name, [&](std::size_t k) { return fixed(needed(k), 2); });
    for (std::size_t k = 0; options.memory_per_node && k < options.workers.size(); ++k)
      if (needed(k) > *options.memory_per_node)
        exceeded += "With " + std::to_string(options.workers[k]) + " workers, " + on_node.name +
                    " on a node, more than its " + number_text(*options.memory_per_node) + " GB\n";
  }
  std::fputs(exceeded.c_str(), stdout);
}

void print(const simulate_options& options, double elements,
           const std::vector<simulation::simulated_run>& runs) {
  const auto scheme = [&](std::size_t k) { return seconds_in(scheme_parts(), runs[k]); };
  const auto speed = [&](std::size_t k) {
    return elements / scheme(k) / static_cast<double>(options.workers[k]);
  };
  columns table(runs.size());
  std::printf("Simulated, for %s tetrahedra\n", count_text(elements).c_str());
  table.row("No. of workers", [&](std::size_t k) { return std::to_string(options.workers[k]); });
  table.row("Entire scheme (s)", [&](std::size_t k) { return fixed(scheme(k), 2); });
  table.row("  Domain decomposition",
            [&](std::size_t k) { return fixed(seconds_in(decomposition_parts(), runs[k]), 2); });
  table.row("  Other steps", [&](std::size_t k) { return fixed(seconds_in(other_parts(), runs[k]), 2); });
  table.row("Reading and finishing (s)",
            [&](std::size_t k) { return fixed(runs[k].seconds - scheme(k), 2); });
  table.row("Relative speed (elements/s/worker)", [&](std::size_t k) { return count_text(speed(k)); });
  table.row("  of that of the first (percent)",
            [&](std::size_t k) { return fixed(100 * speed(k) / speed(0), 0); });
  const auto share_row = [&](const char* label, double simulation::simulated_times::*seconds) {
    table.row(label, [&](std::size_t k) {
      double sum = 0;
      for (const auto& stage : runs[k].stages)
        sum += stage.*seconds;
      return fixed(100 * sum / runs[k].seconds, 2);
    });
  };
  share_row("Manager (percent of the run)", &simulation::simulated_times::managing);
  share_row("Manager's link (percent of the run)", &simulation::simulated_times::link);
  print_stages(runs, options.workers);
  if (std::abs(elements / 1e9 - 1) < 0.1)
    print_paper(options.workers);
}

} // namespace

int run_simulate(const simulate_options& options) {
  const simulation::workload work = wanted_work(options);
  std::vector<simulation::simulated_run> runs;
  for (const std::int64_t workers : options.workers) {
    simulation::simulated_machine machine = options.machine;
    machine.workers = workers;
    runs.push_back(simulation::simulate(work, machine));
  }
  if (!(seconds_in(scheme_parts(), runs.front()) > 0))
    throw usage_error("the trace has no stage of the entire scheme");
  print(options, work.elements, runs);
  if (options.cores_per_node)
    print_memory(options, work.sizes);
  return exit_ok;
}

} // namespace dovetail::app
