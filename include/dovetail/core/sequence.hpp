/// @file
/// What is done to a whole vector (array, span), in one word. It goes through pointers and plain loops: a
/// vector's own iterators cost the compiler twice as much and more, anew for each type of element.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

namespace dovetail {

/// A view of a vector, which `std::span` makes too, but not before it has checked all that ranges promise.
template <class T>
std::span<const T> span_of(const std::vector<T>& items) {
  return {items.data(), items.size()};
}
template <class T>
std::span<T> span_of(std::vector<T>& items) {
  return {items.data(), items.size()};
}

/// Sorts all items, ascending or by `less`.
template <class Sequence>
void sort_all(Sequence&& items) {
  std::sort(items.data(), items.data() + items.size());
}
template <class Sequence, class Less>
void sort_all(Sequence&& items, Less less) {
  std::sort(items.data(), items.data() + items.size(), less);
}
/// Sorts all items, equal ones in their order.
template <class T, class Less>
void stable_sort_all(std::vector<T>& items, Less less) {
  std::stable_sort(items.data(), items.data() + items.size(), less);
}

/// Sorts the items and keeps one of those that are equal.
template <class T>
void sort_unique(std::vector<T>& items) {
  sort_all(items);
  const T* const end = std::unique(items.data(), items.data() + items.size());
  while (items.data() + items.size() != end)
    items.pop_back();
}

/// Adds all of another sequence behind the items; it must not be the same one.
template <class T, class Sequence>
void append(std::vector<T>& items, const Sequence& others) {
  for (const T& other : others)
    items.push_back(other);
}

} // namespace dovetail
