/// @file
/// Joins the pieces of a mesh that was read from several files.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/mesh/loaded_mesh.hpp"

#include <cstddef>
#include <vector>

namespace dovetail::io {

/// Arrays that only some pieces have: global ids are dropped, scalars are filled with NaN.
void complete_point_data(loaded_mesh& mesh);

/// Appends one more part of a mesh, with points of its own that may be there already: `complete_point_data`
/// and `merge_points` make one mesh of it when all parts are there.
void append_part(loaded_mesh& mesh, loaded_mesh part);

namespace detail {

/// The chosen entries of an array, in the order of the choice.
template <class T>
std::vector<T> chosen(const std::vector<T>& values, const std::vector<local_id>& choice) {
  std::vector<T> result;
  result.reserve(choice.size());
  for (const auto i : choice)
    result.push_back(values[i]);
  return result;
}

} // namespace detail

/// Points that are the same in several pieces become one: those with the same global id, or, where the file
/// has none, at exactly the same place. The result is in the order of the ids, or of first occurrence.
/// Needs complete point data. Throws `input_error` (without a file name) when ids and places contradict each
/// other.
void merge_points(loaded_mesh& mesh);

/// Whether points of the same global number are there twice or more, all at the same place, as where a
/// program has joined the pieces of a mesh in one file.
bool repeats_points(const loaded_mesh& mesh);

} // namespace dovetail::io

#ifndef DOVETAIL_COMPILED
#include "dovetail/files/merge_points.ipp"
#endif
