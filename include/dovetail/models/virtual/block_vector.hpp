/// @file
/// A sequence whose copies share what is the same in both.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace dovetail::virtual_topology {

/// A vector in blocks. A copy has the same blocks, and one is copied when it is changed: attempts that change
/// little cost little, however long the sequence. Copies must not be used in several threads at a time.
template <class T>
class block_vector {
public:
  block_vector() = default;
  /// \param items are moved
  explicit block_vector(std::vector<T> items) {
    for (T& item : items)
      push_back(std::move(item));
  }

  std::size_t size() const {
    return blocks_.empty() ? 0 : (blocks_.size() - 1) * block_size + blocks_.back()->size();
  }
  const T& operator[](std::size_t i) const { return (*blocks_[i / block_size])[i % block_size]; }
  const T& back() const { return blocks_.back()->back(); }

  /// The item, to be changed in this sequence only. What `operator[]` gave before may be the item as it was.
  T& change(std::size_t i) { return own(i / block_size)[i % block_size]; }

  void push_back(T item) {
    if (blocks_.empty() || blocks_.back()->size() == block_size)
      blocks_.push_back(std::make_shared<std::vector<T>>());
    own(blocks_.size() - 1).push_back(std::move(item));
  }

private:
  static constexpr std::size_t block_size = 32;

  std::vector<T>& own(std::size_t block) {
    auto& shared = blocks_[block];
    if (shared.use_count() > 1)
      shared = std::make_shared<std::vector<T>>(*shared);
    return *shared;
  }

  std::vector<std::shared_ptr<std::vector<T>>> blocks_;
};

} // namespace dovetail::virtual_topology
