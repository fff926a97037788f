/// @file
/// Arrays of several types that the tasks of a run fill, each task its part, and everybody reads afterwards.
#pragma once

#include "dovetail/core/shared_array.hpp"
#include "dovetail/parallel/common_memory.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace dovetail {

/// They lie one behind the other in `common_memory`, whose promises are theirs.
template <class... Items>
class common_arrays {
  static_assert((std::is_trivially_copyable_v<Items> && ...));
  template <std::size_t I>
  using item = std::tuple_element_t<I, std::tuple<Items...>>;

public:
  /// So many items of each type, all of them zeros. Collective; throws `io_error` on all ranks when they
  /// cannot be made.
  template <executor Executor>
  common_arrays(const Executor& run, const std::string& name,
                const std::array<std::size_t, sizeof...(Items)>& counts)
      : counts_(counts), begins_(begins_of(counts)), memory_(run, name, begins_.back()) {}

  /// Runs `task(i)` for each i, which writes and returns nothing, through the same executor. An error of a
  /// task is thrown.
  template <executor Executor, class Task>
  void fill(const Executor& run, std::size_t count, const Task& task, const run_options& options) {
    memory_.fill(run, count, task, options);
  }

  /// In a task: the items of array `I` from its item `first` on. No two tasks write the same. Throws
  /// `io_error`, when the disk is full for example.
  template <std::size_t I>
  void write(std::size_t first, const std::vector<item<I>>& items) const {
    memory_.write(begins_[I] + first * sizeof(item<I>), items);
  }

  /// Once they are filled: from here on they are only read. Collective; throws `io_error` on all ranks.
  std::tuple<shared_array<Items>...> close() {
    memory_.close();
    return arrays(std::index_sequence_for<Items...>{});
  }

private:
  template <std::size_t... I>
  std::tuple<shared_array<Items>...> arrays(std::index_sequence<I...>) const {
    return {memory_.array<Items>(begins_[I], counts_[I])...};
  }

  /// The place of each array, and the end of the last.
  static std::array<std::size_t, sizeof...(Items) + 1>
  begins_of(const std::array<std::size_t, sizeof...(Items)>& counts) {
    constexpr std::array sizes{sizeof(Items)...};
    std::array<std::size_t, sizeof...(Items) + 1> begins{};
    for (std::size_t k = 0; k < sizes.size(); ++k) {
      const std::size_t end = begins[k] + counts[k] * sizes[k];
      begins[k + 1] =
          (end + alignof(std::max_align_t) - 1) / alignof(std::max_align_t) * alignof(std::max_align_t);
    }
    return begins;
  }

  std::array<std::size_t, sizeof...(Items)> counts_;
  std::array<std::size_t, sizeof...(Items) + 1> begins_;
  common_memory memory_;
};

} // namespace dovetail
