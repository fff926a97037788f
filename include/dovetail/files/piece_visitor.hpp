/// @file
/// Meshes that are read one piece after the other, and what joins the pieces.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/files/merge_points.hpp"
#include "dovetail/mesh/loaded_mesh.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::io {

/// Takes the pieces of a mesh one after the other, with the file that each is from. The points of a piece
/// come in the order of their global numbers.
using piece_visitor = std::function<void(const loaded_mesh& piece, const std::filesystem::path& file)>;

namespace detail {

/// Puts the points of a piece into the order of their numbers, each of which it has once.
inline void order_points(loaded_mesh& piece, const std::filesystem::path& file) {
  const std::size_t points = piece.mesh.points.size();
  try {
    merge_points(piece);
  } catch (const input_error& problem) {
    throw input_error(file.string() + ": " + problem.what());
  }
  if (piece.mesh.points.size() != points)
    throw input_error(file.string() + ": points of one piece have the same global number; write the mesh "
                                      "anew");
}

/// The mesh whose pieces `for_each(visitor)` goes through.
template <class ForEach>
loaded_mesh joined_pieces(const std::filesystem::path& name, const ForEach& for_each) {
  loaded_mesh whole;
  for_each([&](const loaded_mesh& piece, const std::filesystem::path& file) {
    append_part(whole, piece);
    if (std::find(whole.files.begin(), whole.files.end(), file) == whole.files.end())
      whole.files.push_back(file);
  });
  complete_point_data(whole);
  try {
    merge_points(whole);
  } catch (const input_error& problem) {
    throw input_error(name.string() + ": " + problem.what());
  }
  return whole;
}

/// The ids of a side or an edge, ascending.
template <std::size_t N>
std::array<global_id, N> ascending(std::array<global_id, N> ids) {
  std::sort(ids.begin(), ids.end());
  return ids;
}

/// Is a side turned as the other one, or against it? Both have the same vertices.
template <class Id>
bool same_turn(const std::array<Id, 3>& a, std::array<Id, 3> b) {
  std::rotate(b.begin(), std::find(b.begin(), b.end(), a[0]), b.end());
  return a == b;
}

} // namespace detail

} // namespace dovetail::io
