/// @file
/// Memory that the tasks of a run fill and everybody reads afterwards. Linux.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/shared_array.hpp"
#include "dovetail/parallel/any_executor.hpp"
#include "dovetail/parallel/entity_store.hpp"
#include "dovetail/parallel/map_tasks.hpp"
#include "dovetail/parallel/owned_descriptor.hpp"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

namespace dovetail {

/// Ranks that see one spool have it in a file there, which each machine holds once, in pages that it can also
/// put back to disk; ranks that do not, each in memory of its own. The file of a name takes the place of that
/// before it, which may not be read any more; the spool removes the last one.
class common_memory {
public:
  /// Of `bytes` zeros. Collective; throws `io_error` on all ranks when the file cannot be made.
  common_memory(const any_executor& run, const entity_store& store, const std::string& name,
                std::size_t bytes)
      : run_(run), bytes_(std::max<std::size_t>(bytes, 1)) {
    if (run.has_others() && store.is_common())
      file_ = store.place_of_file(name);
    if (file_)
      run_.once([this] { make_file(); });
    else if (run.has_others() || run.shares_process())
      memory_ = own_memory();
    else
      memory_ = mapped(-1, PROT_READ | PROT_WRITE);
  }

  /// Runs `task(i)` for each i, which writes and returns nothing. An error of a task is thrown.
  template <class Task>
  void fill(std::size_t count, const Task& task, const run_options& options) {
    if (run_.has_others() && !file_) {
      for (std::size_t i = 0; i < count; ++i)
        task(i);
      return;
    }
    for (const auto& result : map_tasks(run_, count, task, options))
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
  void close() {
    if (!file_)
      return;
    std::exception_ptr failure;
    try {
      memory_ = mapped(descriptor(O_RDONLY).get(), PROT_READ);
    } catch (...) {
      failure = std::current_exception();
    }
    run_.network().agree(failure); // the next file of this name may come now
  }

  /// After `close`: items that were written at a place.
  template <class T>
  shared_array<T> array(std::size_t at, std::size_t count) const {
    return {std::span<const T>(reinterpret_cast<const T*>(memory_.get() + at), count), memory_};
  }

private:
  std::shared_ptr<std::byte> own_memory() const {
    auto* zeros = static_cast<std::byte*>(std::calloc(bytes_, 1));
    if (zeros == nullptr)
      throw std::bad_alloc();
    return {zeros, [](std::byte* p) { std::free(p); }};
  }

  /// Pages of a file, or with -1 of nothing that processes forked later share.
  std::shared_ptr<std::byte> mapped(int descriptor, int protection) const {
    const int kind = MAP_SHARED | (descriptor < 0 ? MAP_ANONYMOUS : 0);
    void* pages = ::mmap(nullptr, bytes_, protection, kind, descriptor, 0);
    if (pages == MAP_FAILED && descriptor >= 0)
      fail("cannot map");
    if (pages == MAP_FAILED)
      throw std::bad_alloc();
    return {static_cast<std::byte*>(pages), [bytes = bytes_](std::byte* p) { ::munmap(p, bytes); }};
  }

  void make_file() const {
    std::error_code ignored;
    std::filesystem::remove(*file_, ignored);
    const detail::owned_descriptor made = descriptor(O_RDWR | O_CREAT | O_EXCL);
    if (::ftruncate(made.get(), static_cast<off_t>(bytes_)) != 0)
      fail("cannot make");
  }

  void write_file(std::size_t at, const std::byte* bytes, std::size_t size) const {
    const detail::owned_descriptor open = descriptor(O_WRONLY);
    while (size > 0) {
      const ssize_t written = ::pwrite(open.get(), bytes, size, static_cast<off_t>(at));
      if (written < 0 && errno == EINTR)
        continue;
      if (written <= 0)
        fail("cannot write");
      bytes += written;
      at += static_cast<std::size_t>(written);
      size -= static_cast<std::size_t>(written);
    }
  }

  detail::owned_descriptor descriptor(int flags) const {
    detail::owned_descriptor open(::open(file_->c_str(), flags | O_CLOEXEC, 0666));
    if (open.get() < 0)
      fail("cannot open");
    return open;
  }

  [[noreturn]] void fail(const char* what) const {
    const int reason = errno;
    throw io_error(std::string(what) + " " + file_->string() + ": " + std::strerror(reason));
  }

  any_executor run_;
  std::size_t bytes_;
  std::optional<std::filesystem::path> file_;
  std::shared_ptr<std::byte> memory_;
};

} // namespace dovetail
