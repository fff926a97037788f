/// @file
/// Reports as bytes, for workers' results and the spool.
#pragma once

#include "dovetail/core/bytes.hpp"
#include "dovetail/core/report.hpp"

#include <cstdint>
#include <string>
#include <utility>

namespace dovetail {

inline void encode(byte_writer& to, const report& r) {
  to.text(r.name);
  to.value(r.seconds);
  to.value<std::uint64_t>(r.counters.size());
  for (const auto& [key, value] : r.counters) {
    to.text(key);
    to.value(value);
  }
  to.value<std::uint64_t>(r.warnings.size());
  for (const std::string& warning : r.warnings)
    to.text(warning);
  to.value<std::uint64_t>(r.children.size());
  for (const report& child : r.children)
    encode(to, child);
  to.value<std::uint64_t>(r.files.size());
  for (const std::string& file : r.files)
    to.text(file);
}

inline report decode_report(byte_reader& from) {
  report r;
  r.name = from.text();
  r.seconds = from.value<double>();
  for (auto left = from.value<std::uint64_t>(); left > 0; --left) {
    std::string key = from.text();
    const auto value = from.value<double>();
    r.counters.push_back({std::move(key), value});
  }
  for (auto left = from.value<std::uint64_t>(); left > 0; --left)
    r.warnings.push_back(from.text());
  for (auto left = from.value<std::uint64_t>(); left > 0; --left)
    r.children.push_back(decode_report(from));
  for (auto left = from.value<std::uint64_t>(); left > 0; --left)
    r.files.push_back(from.text());
  return r;
}

} // namespace dovetail
