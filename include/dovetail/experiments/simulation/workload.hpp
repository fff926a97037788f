/// @file
/// The work of a run as a simulation needs it, and as it would be for a larger mesh.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/parallel/execution_trace.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::simulation {

/// A task: its time on a worker, and the size of its result, which every rank gets.
struct simulated_task {
  double seconds = 0; ///< on a worker
  double bytes = 0;   ///< of its result
};

/// What is done in a stage: what all do alike; what one process does for all, who wait and are told; and the
/// tasks, where the next batch begins when the last is done.
struct simulated_stage {
  std::string stage;                                     ///< its name
  double seconds_alike = 0;                              ///< in which all do the same
  std::vector<simulated_task> once = {};                 ///< what one process does for all
  std::vector<std::vector<simulated_task>> batches = {}; ///< of tasks
};

/// The work of a run.
struct workload {
  double elements = 0;                      ///< of the mesh that it makes
  std::vector<simulated_stage> stages = {}; ///< in their order
  mesh_sizes sizes = {};                    ///< what the memory of a rank goes with
  std::string subject = {};                 ///< what is meshed; empty where it is not known
};

/// The stages of a trace by their names, in the order in which they are first met; a batch belongs to the
/// stage of its name if that is under way, or else to the one in which it begins. Tasks are in the order in
/// which they began. Throws `usage_error` for a trace without stages.
inline workload workload_of(const execution_trace& trace) {
  if (trace.stages.empty())
    throw usage_error("a trace without stages cannot be simulated; give the progress of the run to traced");
  workload work{.elements = trace.elements, .sizes = trace.sizes, .subject = trace.subject};
  const auto stage_called = [&](const std::string& name) -> simulated_stage& {
    const auto found = std::find_if(work.stages.begin(), work.stages.end(),
                                    [&](const simulated_stage& s) { return s.stage == name; });
    return found != work.stages.end() ? *found : work.stages.emplace_back(simulated_stage{name});
  };
  const auto stage_of = [&](const batch_span& batch) {
    std::string under_way;
    for (const stage_span& span : trace.stages) {
      if (span.stage == batch.stage && span.begin <= batch.end && batch.begin <= span.end)
        return batch.stage;
      if (under_way.empty() || span.begin <= batch.begin)
        under_way = span.stage;
    }
    return under_way;
  };
  for (const stage_span& span : trace.stages)
    stage_called(span.stage).seconds_alike += seconds_alike(trace, span.begin, span.end);
  for (const batch_span& batch : trace.batches) {
    if (batch.tasks.empty())
      continue;
    std::vector<task_span> begun = batch.tasks;
    std::stable_sort(begun.begin(), begun.end(),
                     [](const task_span& a, const task_span& b) { return a.begin < b.begin; });
    simulated_stage& stage = stage_called(stage_of(batch));
    auto& tasks = batch.once ? stage.once : stage.batches.emplace_back();
    for (const task_span& task : begun)
      tasks.push_back({task.seconds, static_cast<double>(task.result_bytes)});
  }
  return work;
}

namespace detail {

/// Sums over a stage.
struct stage_sums {
  double alike = 0, once = 0, tasks = 0, seconds = 0;
};

inline std::map<std::string, stage_sums> sums_of(const workload& work) {
  std::map<std::string, stage_sums> sums;
  for (const simulated_stage& stage : work.stages) {
    stage_sums& of = sums[stage.stage];
    of.alike += stage.seconds_alike;
    for (const simulated_task& task : stage.once)
      of.once += task.seconds;
    for (const auto& batch : stage.batches) {
      of.tasks += static_cast<double>(batch.size());
      for (const simulated_task& task : batch)
        of.seconds += task.seconds;
    }
  }
  return sums;
}

/// By how much a quantity grows with the elements: an exponent, between the two that are given.
inline double growth(double small, double large, double times_elements, double least, double most) {
  if (!(small > 0) || !(large > 0))
    return most < 1 ? most : 1;
  return std::clamp(std::log(large / small) / std::log(times_elements), least, most);
}

/// Sizes for a mesh of `factor` times the elements of the larger run, which has `times` those of the smaller.
inline mesh_sizes sizes_scaled(double factor, const mesh_sizes& small, const mesh_sizes& large,
                               double times) {
  if (!small.are_known() || !large.are_known())
    return {};
  const auto scaled = [&](double mesh_sizes::*size) {
    return large.*size * std::pow(factor, growth(small.*size, large.*size, times, 0, 1));
  };
  return {scaled(&mesh_sizes::background_elements), scaled(&mesh_sizes::skeleton_sides),
          scaled(&mesh_sizes::largest_piece)};
}

} // namespace detail

/// The work for a mesh of so many elements, by power laws through two runs of different sizes, of which the
/// larger one gives the order of batches and how tasks differ: for each stage a law for what all do alike,
/// for what one does for all, for the number of tasks and for the time of one; and for each of the sizes, if
/// both runs know them. What takes less than `short_time` in the larger run grows with the elements. Throws
/// `usage_error` unless the second run has at least 1.5 times the elements.
inline workload scaled_to(double elements, const workload& smaller, const workload& larger,
                          double short_time = 1e-3) {
  const double times = larger.elements / smaller.elements;
  if (!(smaller.elements > 0) || !(times >= 1.5))
    throw usage_error("a law needs two runs of different sizes; give traces of meshes with at least 1.5 "
                      "times as many elements, one after the other");
  const double factor = elements / larger.elements;
  const auto small = detail::sums_of(smaller), large = detail::sums_of(larger);
  workload scaled{.elements = elements,
                  .sizes = detail::sizes_scaled(factor, smaller.sizes, larger.sizes, times)};
  for (const simulated_stage& stage : larger.stages) {
    const detail::stage_sums now = large.at(stage.stage);
    const auto before = small.find(stage.stage);
    const detail::stage_sums was = before != small.end() ? before->second : detail::stage_sums{};
    const auto by_law = [&](double a, double b, double least, double most) {
      return std::pow(factor, detail::growth(a, b, times, least, most));
    };
    const auto by_law_unless_short = [&](double a, double b) {
      return b > short_time ? by_law(a, b, 0, 1.5) : factor;
    };
    const double once = by_law_unless_short(was.once, now.once);
    const double count = now.tasks > 0 ? by_law(was.tasks, now.tasks, 0, 1) : 1;
    const double each = now.tasks > 0 && was.tasks > 0
                            ? by_law(was.seconds / was.tasks, now.seconds / now.tasks, -0.5, 1)
                            : 1;
    simulated_stage next{stage.stage, stage.seconds_alike * by_law_unless_short(was.alike, now.alike)};
    for (const simulated_task& task : stage.once)
      next.once.push_back({task.seconds * once, task.bytes * once});
    for (const auto& batch : stage.batches) {
      const auto wanted =
          static_cast<std::size_t>(std::max(1.0, std::round(static_cast<double>(batch.size()) * count)));
      auto& tasks = next.batches.emplace_back();
      for (std::size_t i = 0; i < wanted; ++i) { // the costliest stay first
        const simulated_task& like = batch[i * batch.size() / wanted];
        tasks.push_back({like.seconds * each, like.bytes * each});
      }
    }
    scaled.stages.push_back(std::move(next));
  }
  return scaled;
}

} // namespace dovetail::simulation
