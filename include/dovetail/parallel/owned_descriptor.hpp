/// @file
/// A file descriptor that closes itself.
#pragma once

#include <utility>

#include <unistd.h>

namespace dovetail::detail {

/// Owns a descriptor, or -1: none.
class owned_descriptor {
public:
  explicit owned_descriptor(int descriptor = -1) : descriptor_(descriptor) {}
  owned_descriptor(owned_descriptor&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  owned_descriptor& operator=(owned_descriptor&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }
  ~owned_descriptor() { close(); }

  int get() const { return descriptor_; }
  void close() {
    if (descriptor_ >= 0)
      ::close(descriptor_);
    descriptor_ = -1;
  }

private:
  int descriptor_;
};

} // namespace dovetail::detail
