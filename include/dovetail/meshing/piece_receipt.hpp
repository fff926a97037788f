/// @file
/// What a worker sends of a piece: where it is, and what all need of it without loading it, in few bytes,
/// since every rank gets that of every piece.
#pragma once

#include "dovetail/core/compact_bytes.hpp"
#include "dovetail/core/content_key.hpp"
#include "dovetail/core/report_codec.hpp"
#include "dovetail/mesh/quality_codec.hpp"
#include "dovetail/meshing/piece_work.hpp"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::detail {

inline void encode_warnings(byte_writer& to, const report& from) {
  encode_count(to, from.warnings.size());
  for (const std::string& warning : from.warnings)
    encode_short(to, warning);
}
inline std::vector<std::string> decode_warnings(byte_reader& from) {
  std::vector<std::string> warnings;
  for (auto left = decode_count(from); left > 0; --left)
    warnings.push_back(decode_short(from));
  return warnings;
}

/// Of the report of a piece what is summed up over all pieces. The rest is with the piece.
inline void encode_brief(byte_writer& to, const report& piece) {
  to.value(piece.seconds);
  encode_count(to, static_cast<std::uint64_t>(piece.get("rung")));
  encode_count(to, static_cast<std::uint64_t>(stops_by_clock(piece)));
  encode_warnings(to, piece);
  encode_count(to, piece.children.size());
  for (const report& part : piece.children) {
    encode_short(to, part.name);
    to.value(part.seconds);
    encode_warnings(to, part);
    std::vector<const report*> deviations;
    for (const report& child : part.children)
      if (child.name == "deviation")
        deviations.push_back(&child);
    encode_count(to, deviations.size());
    for (const report* deviation : deviations)
      dovetail::encode(to, *deviation);
  }
}

inline report decode_brief(byte_reader& from) {
  report piece;
  piece.seconds = from.value<double>();
  piece.set("rung", static_cast<double>(decode_count(from)));
  if (const auto stops = decode_count(from); stops > 0)
    piece.set("stops_by_clock", static_cast<double>(stops));
  piece.warnings = decode_warnings(from);
  for (auto left = decode_count(from); left > 0; --left) {
    report part;
    part.name = decode_short(from);
    part.seconds = from.value<double>();
    part.warnings = decode_warnings(from);
    for (auto deviations = decode_count(from); deviations > 0; --deviations)
      part.children.push_back(decode_report(from));
    piece.children.push_back(std::move(part));
  }
  return piece;
}

struct piece_receipt {
  content_key key = {};
  piece_summary summary = {}; ///< what is sent of its report is brief
  bool reused = false;        ///< the store had it

  byte_buffer encoded() const {
    byte_writer bytes;
    bytes.value(key);
    bytes.value<std::uint8_t>(reused);
    bytes.value(summary.counts.material);
    encode_count(bytes, static_cast<std::uint64_t>(summary.counts.inner_points));
    encode_count(bytes, static_cast<std::uint64_t>(summary.counts.elements));
    dovetail::encode(bytes, summary.quality);
    encode_brief(bytes, summary.summary);
    return bytes.take();
  }
  static piece_receipt decoded(const byte_buffer& buffer) {
    byte_reader bytes(buffer);
    piece_receipt receipt;
    receipt.key = bytes.value<content_key>();
    receipt.reused = bytes.value<std::uint8_t>() != 0;
    piece_summary& summary = receipt.summary;
    summary.counts.material = bytes.value<local_id>();
    summary.counts.inner_points = static_cast<global_id>(decode_count(bytes));
    summary.counts.elements = static_cast<global_id>(decode_count(bytes));
    summary.quality = decode_quality(bytes);
    summary.summary = decode_brief(bytes);
    return receipt;
  }
};

} // namespace dovetail::detail
