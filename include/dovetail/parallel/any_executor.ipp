/// @file
/// What `any_executor.hpp` declares.
#pragma once

#include "dovetail/core/bytes.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/parallel/any_executor.hpp"
#include "dovetail/parallel/concepts.hpp"

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace dovetail {

DOVETAIL_INLINE std::vector<task_outcome> any_executor::run(std::size_t count, const task_function& task,
                                                            const run_options& options) const {
  const auto who = [&] { return named_policy("executor", name_); };
  auto outcomes = call_policy<usage_error>(who, [&] { return run_(count, marked(task), options); });
  if (outcomes.size() != count)
    throw usage_error(who() + " gave " + std::to_string(outcomes.size()) + " outcomes for " +
                      std::to_string(count) + " tasks");
  for (std::size_t i = 0; i < count; ++i)
    if (outcomes[i].ok && !take_mark(outcomes[i].result, i))
      throw usage_error(who() + " gave for task " + std::to_string(i) + " another result than it returned");
  return outcomes;
}

DOVETAIL_INLINE task_function any_executor::marked(const task_function& task) {
  return [&task](std::size_t i) {
    byte_buffer result = task(i);
    const auto number = static_cast<std::uint64_t>(i);
    const auto* bytes = reinterpret_cast<const std::byte*>(&number);
    result.reserve(result.size() + sizeof number);
    result.insert(result.end(), bytes, bytes + sizeof number);
    return result;
  };
}

DOVETAIL_INLINE bool any_executor::take_mark(byte_buffer& result, std::size_t i) {
  std::uint64_t number = 0;
  if (result.size() < sizeof number)
    return false;
  std::memcpy(&number, result.data() + result.size() - sizeof number, sizeof number);
  result.resize(result.size() - sizeof number);
  return number == i;
}

} // namespace dovetail
