/// @file
/// What `common_memory.hpp` declares.
#pragma once

#include "dovetail/core/linkage.hpp"
#include "dovetail/parallel/common_memory.hpp"
#include "dovetail/parallel/owned_descriptor.hpp"

#include <cerrno>
#include <cstddef>
#include <exception>
#include <filesystem>
#include <memory>
#include <new>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

namespace dovetail {

DOVETAIL_INLINE void common_memory::make_memory(bool alone) {
  memory_ = alone ? own_memory() : mapped(-1, PROT_READ | PROT_WRITE);
}

DOVETAIL_INLINE void common_memory::close() {
  if (!file_)
    return;
  std::exception_ptr failure;
  try {
    memory_ = mapped(descriptor(O_RDONLY).get(), PROT_READ);
  } catch (...) {
    failure = std::current_exception();
  }
  network_.agree(failure); // the next file of this name may come now
}

DOVETAIL_INLINE std::shared_ptr<std::byte> common_memory::mapped(int descriptor, int protection) const {
  const int kind = MAP_SHARED | (descriptor < 0 ? MAP_ANONYMOUS : 0);
  void* pages = ::mmap(nullptr, bytes_, protection, kind, descriptor, 0);
  if (pages == MAP_FAILED && descriptor >= 0)
    fail("cannot map");
  if (pages == MAP_FAILED)
    throw std::bad_alloc();
  return {static_cast<std::byte*>(pages), [bytes = bytes_](std::byte* p) { ::munmap(p, bytes); }};
}

DOVETAIL_INLINE void common_memory::make_file() const {
  std::error_code ignored;
  std::filesystem::remove(*file_, ignored);
  const detail::owned_descriptor made = descriptor(O_RDWR | O_CREAT | O_EXCL);
  if (::ftruncate(made.get(), static_cast<off_t>(bytes_)) != 0)
    fail("cannot make");
}

DOVETAIL_INLINE void common_memory::write_file(std::size_t at, const std::byte* bytes,
                                               std::size_t size) const {
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

DOVETAIL_INLINE detail::owned_descriptor common_memory::descriptor(int flags) const {
  detail::owned_descriptor open(::open(file_->c_str(), flags | O_CLOEXEC, 0666));
  if (open.get() < 0)
    fail("cannot open");
  return open;
}

} // namespace dovetail
