/// @file
/// What `executor_services.hpp` declares.
#pragma once

#include "dovetail/core/bytes.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/parallel/executor_services.hpp"

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace dovetail::detail {

/// Each result ends with its task's number, so that none is lost or taken for another's.
inline task_function marked(const task_function& task) {
  return [&task](std::size_t i) {
    byte_buffer result = task(i);
    const auto number = static_cast<std::uint64_t>(i);
    const auto* bytes = reinterpret_cast<const std::byte*>(&number);
    result.reserve(result.size() + sizeof number);
    result.insert(result.end(), bytes, bytes + sizeof number);
    return result;
  };
}

inline bool take_mark(byte_buffer& result, std::size_t i) {
  std::uint64_t number = 0;
  if (result.size() < sizeof number)
    return false;
  std::memcpy(&number, result.data() + result.size() - sizeof number, sizeof number);
  result.resize(result.size() - sizeof number);
  return number == i;
}

DOVETAIL_INLINE std::vector<task_outcome> checked_outcomes(const task_runner& run, const std::string& name,
                                                           std::size_t count, const task_function& task,
                                                           const run_options& options) {
  const auto who = [&] { return named_policy("executor", name); };
  auto outcomes = call_policy<usage_error>(who, [&] { return run(count, marked(task), options); });
  if (outcomes.size() != count)
    throw usage_error(who() + " gave " + std::to_string(outcomes.size()) + " outcomes for " +
                      std::to_string(count) + " tasks");
  for (std::size_t i = 0; i < count; ++i)
    if (outcomes[i].ok && !take_mark(outcomes[i].result, i))
      throw usage_error(who() + " gave for task " + std::to_string(i) + " another result than it returned");
  return outcomes;
}

} // namespace dovetail::detail
