/// @file
/// Items in rows, and the counting sort that makes them.
#pragma once

#include "dovetail/core/sequence.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace dovetail {

/// Row r is items[begins[r]] ... items[begins[r + 1] - 1].
template <class Item>
struct compressed_rows {
  std::vector<std::size_t> begins{0}; ///< size rows + 1
  std::vector<Item> items;            ///< all items, row by row

  std::size_t size() const { return begins.size() - 1; }
  template <class Row>
  std::span<const Item> operator[](Row row) const {
    const auto r = static_cast<std::size_t>(row);
    return span_of(items).subspan(begins[r], begins[r + 1] - begins[r]);
  }
  template <class Row>
  std::span<Item> operator[](Row row) {
    const auto r = static_cast<std::size_t>(row);
    return span_of(items).subspan(begins[r], begins[r + 1] - begins[r]);
  }
};

/// Sorts items into `rows` rows by counting: `for_each_item(put)` calls `put(row, item)` for each, and is
/// called twice. Rows keep the order of the calls. Linear.
template <class Item, class ForEachItem>
compressed_rows<Item> sorted_into_rows(std::size_t rows, const ForEachItem& for_each_item) {
  compressed_rows<Item> sorted;
  sorted.begins.assign(rows + 1, 0);
  for_each_item([&](auto row, const Item& /*item*/) { ++sorted.begins[static_cast<std::size_t>(row) + 1]; });
  for (std::size_t r = 0; r < rows; ++r)
    sorted.begins[r + 1] += sorted.begins[r];
  sorted.items.resize(sorted.begins[rows]);
  std::vector<std::size_t> next(sorted.begins.begin(), sorted.begins.end() - 1);
  for_each_item([&](auto row, const Item& item) { sorted.items[next[row]++] = item; });
  return sorted;
}

} // namespace dovetail
