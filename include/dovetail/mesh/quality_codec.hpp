/// @file
/// Statistics of angles as bytes: of the histograms what is not zero, a tenth of what they take in memory.
#pragma once

#include "dovetail/core/compact_bytes.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/mesh/quality.hpp"

#include <cstddef>
#include <cstdint>

namespace dovetail {

/// Where the bins that are not empty begin, how many there are from the first to the last, and these.
inline void encode(byte_writer& to, const angle_histogram& histogram) {
  std::size_t first = 0, end = histogram.bins.size();
  while (end > 0 && histogram.bins[end - 1] == 0)
    --end;
  while (first < end && histogram.bins[first] == 0)
    ++first;
  encode_count(to, first);
  encode_count(to, end - first);
  for (std::size_t k = first; k < end; ++k)
    encode_count(to, static_cast<std::uint64_t>(histogram.bins[k]));
}

/// Throws `input_error` for what `encode` has not written.
inline angle_histogram decode_histogram(byte_reader& from) {
  angle_histogram histogram;
  const std::uint64_t first = decode_count(from), count = decode_count(from);
  if (first > histogram.bins.size() || count > histogram.bins.size() - first)
    throw input_error("binary data have more than 180 degrees");
  for (std::uint64_t k = first; k < first + count; ++k)
    histogram.bins[static_cast<std::size_t>(k)] = static_cast<std::int64_t>(decode_count(from));
  return histogram;
}

inline void encode(byte_writer& to, const quality_statistics& quality) {
  encode_count(to, static_cast<std::uint64_t>(quality.elements));
  to.value(quality.min_wedge_deg);
  to.value(quality.max_wedge_deg);
  to.value(quality.min_face_deg);
  to.value(quality.sum_of_min_wedge_deg);
  encode_count(to, static_cast<std::uint64_t>(quality.worst_element + 1)); // is -1 without elements
  encode(to, quality.min_wedges);
  encode(to, quality.max_wedges);
}

/// Throws `input_error` for what `encode` has not written.
inline quality_statistics decode_quality(byte_reader& from) {
  quality_statistics quality;
  quality.elements = static_cast<std::int64_t>(decode_count(from));
  quality.min_wedge_deg = from.value<double>();
  quality.max_wedge_deg = from.value<double>();
  quality.min_face_deg = from.value<double>();
  quality.sum_of_min_wedge_deg = from.value<double>();
  quality.worst_element = static_cast<global_id>(decode_count(from)) - 1;
  quality.min_wedges = decode_histogram(from);
  quality.max_wedges = decode_histogram(from);
  return quality;
}

} // namespace dovetail
