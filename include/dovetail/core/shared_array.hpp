/// @file
/// An array that its holder owns, or that lies in memory which others see as well.
#pragma once

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace dovetail {

/// Read as a vector is; a copy of one in shared memory is as cheap as a pointer. To change the items, take
/// `own()`.
template <class T>
  requires std::is_trivially_copyable_v<T>
class shared_array {
public:
  using value_type = T;            ///< of an item, as in containers
  using const_iterator = const T*; ///< a pointer to an item

  shared_array() = default;
  shared_array(std::vector<T> items) : own_(std::move(items)) {} // NOLINT: converts, it only holds them
  shared_array(std::initializer_list<T> items) : own_(items) {}
  /// Items in memory that somebody else writes no more; held as long as this or a copy is.
  shared_array(std::span<const T> items, std::shared_ptr<const void> memory)
      : shared_(items), memory_(std::move(memory)) {}

  std::size_t size() const { return memory_ ? shared_.size() : own_.size(); }
  bool empty() const { return size() == 0; }
  const T* data() const { return memory_ ? shared_.data() : own_.data(); }
  const T* begin() const { return data(); }
  const T* end() const { return data() + size(); }
  const T& operator[](std::size_t i) const { return data()[i]; }
  const T& front() const { return *data(); }
  const T& back() const { return data()[size() - 1]; }

  /// The items, to be changed by their holder alone: copied out of shared memory the first time.
  std::vector<T>& own() {
    if (memory_) {
      own_.assign(begin(), end());
      shared_ = {};
      memory_.reset();
    }
    return own_;
  }

  friend bool operator==(const shared_array& a, const shared_array& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end());
  }

private:
  std::vector<T> own_;
  std::span<const T> shared_;
  std::shared_ptr<const void> memory_;
};

template <class T>
std::span<const T> span_of(const shared_array<T>& items) {
  return {items.data(), items.size()};
}

} // namespace dovetail
