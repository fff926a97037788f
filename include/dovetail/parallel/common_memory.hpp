/// @file
/// Memory that the tasks of a run fill and everybody reads afterwards. Linux.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/shared_array.hpp"
#include "dovetail/parallel/any_communicator.hpp"
#include "dovetail/parallel/executor_services.hpp"
#include "dovetail/parallel/map_tasks.hpp"
#include "dovetail/parallel/owned_descriptor.hpp"
#include "dovetail/parallel/run_results.hpp"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

/// Ranks that keep their results in one spool have it in a file there, which each machine holds once, in
/// pages that it can also put back to disk; ranks that do not, each in memory of its own. The file of a name
/// takes the place of that before it, which may not be read any more; the spool removes the last one.
class common_memory {
public:
  /// Of `bytes` zeros. Collective; throws `io_error` on all ranks when the file cannot be made.
  template <executor Executor>
  common_memory(const Executor& run, const std::string& name, std::size_t bytes)
      : network_(network_of(run)), bytes_(std::max<std::size_t>(bytes, 1)) {
    if (const auto store = store_of(run, "common"); has_others(run) && store->is_common())
      file_ = store->place_of_file(name);
    if (file_)
      once(run, [this] { make_file(); });
    else
      make_memory(has_others(run) || run.shares_process());
  }

  /// Runs `task(i)` for each i, which writes and returns nothing, through the same executor. An error of a
  /// task is thrown.
  template <executor Executor, class Task>
  void fill(const Executor& run, std::size_t count, const Task& task, const run_options& options) {
    if (has_others(run) && !file_) {
      for (std::size_t i = 0; i < count; ++i)
        task(i);
      return;
    }
    for (const auto& result : map_tasks(run, count, task, options))
      if (!result.value)
        throw mesh_error(options.stage + ": " + result.failure);
  }

  /// In a task: no two write the same bytes. Throws `io_error`, when the disk is full for example.
  template <class Items>
  void write(std::size_t at, const Items& items) const {
    const auto* bytes = reinterpret_cast<const std::byte*>(items.data());
    const std::size_t size = items.size() * sizeof(typename Items::value_type);
    if (file_)
      write_file(at, bytes, size);
    else if (size > 0)
      std::memcpy(memory_.get() + at, bytes, size);
  }

  /// Once it is filled: from here on it is only read. Collective; throws `io_error` on all ranks.
  void close();

  /// After `close`: items that were written at a place.
  template <class T>
  shared_array<T> array(std::size_t at, std::size_t count) const {
    return {std::span<const T>(reinterpret_cast<const T*>(memory_.get() + at), count), memory_};
  }

private:
  /// Where there is no file: of this process alone, or shared with processes forked later.
  void make_memory(bool alone);

  std::shared_ptr<std::byte> own_memory() const {
    auto* zeros = static_cast<std::byte*>(std::calloc(bytes_, 1));
    if (zeros == nullptr)
      throw std::bad_alloc();
    return {zeros, [](std::byte* p) { std::free(p); }};
  }

  /// Pages of a file, or with -1 of nothing that processes forked later share.
  std::shared_ptr<std::byte> mapped(int descriptor, int protection) const;

  void make_file() const;

  void write_file(std::size_t at, const std::byte* bytes, std::size_t size) const;

  detail::owned_descriptor descriptor(int flags) const;

  [[noreturn]] void fail(const char* what) const {
    const int reason = errno;
    throw io_error(std::string(what) + " " + file_->string() + ": " + std::strerror(reason));
  }

  any_communicator network_;
  std::size_t bytes_;
  std::optional<std::filesystem::path> file_;
  std::shared_ptr<std::byte> memory_;
};

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/parallel/common_memory.ipp"
#endif
