/// @file
/// Which tasks of a run are taken, and by whom, in memory that forked workers share. Linux.
#pragma once

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <system_error>

#include <sys/mman.h>

namespace dovetail::detail {

/// Each worker takes its next task from here by itself, so that it never waits for its parent, and none waits
/// behind another one's long task. A task is taken in one step that says by whom: however a worker ends, its
/// parent knows which task that was. Tasks are named by their places in the order of the run. 4 bytes each.
class task_board {
public:
  using worker_id = std::uint32_t; ///< above 0

  explicit task_board(std::size_t count) : count_(count), takers_(map(count)) {
    std::uninitialized_value_construct_n(takers_.get(), count);
  }

  /// The first free task at or behind `from`, from now on this worker's.
  std::optional<std::size_t> take(worker_id worker, std::size_t from) {
    for (std::size_t place = from; place < count_; ++place)
      if (worker_id nobody = 0; takers_[place].compare_exchange_strong(nobody, worker))
        return place;
    return std::nullopt;
  }

  /// Whether a worker started now might find a task. O(1) on average.
  bool has_free() {
    while (first_free_ < count_ && takers_[first_free_].load() != 0)
      ++first_free_;
    return first_free_ < count_;
  }

  bool is_taken_by(worker_id worker, std::size_t place) const { return takers_[place].load() == worker; }

  /// Nobody here may take a task until it is given back: others may have it.
  void keep_all_back() {
    for (std::size_t place = 0; place < count_; ++place)
      takers_[place].store(kept_back);
    first_free_ = count_;
  }
  /// Makes a task free for whoever comes next.
  void give_back(std::size_t place) {
    takers_[place].store(0);
    first_free_ = std::min(first_free_, place);
  }

private:
  static constexpr worker_id kept_back = ~worker_id{0};
  using word = std::atomic<std::uint32_t>;
  static_assert(word::is_always_lock_free, "a lock would not be shared between processes");

  struct unmap {
    std::size_t bytes;
    void operator()(word* first) const { ::munmap(first, bytes); }
  };
  static std::unique_ptr<word[], unmap> map(std::size_t words) {
    void* memory =
        ::mmap(nullptr, words * sizeof(word), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED)
      throw std::system_error(errno, std::generic_category(), "cannot map memory for worker processes");
    return {static_cast<word*>(memory), unmap{words * sizeof(word)}};
  }

  std::size_t count_;
  std::unique_ptr<word[], unmap> takers_; ///< per place; 0 is nobody
  std::size_t first_free_ = 0;            ///< the parent's: none before it is free
};

} // namespace dovetail::detail
