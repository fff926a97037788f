/// @file
/// What `report.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/report.hpp"

#include <string>

namespace dovetail {

DOVETAIL_INLINE void report::set(const std::string& key, double value) {
  for (auto& [name_of, old] : counters)
    if (name_of == key) {
      old = value;
      return;
    }
  counters.push_back({key, value});
}

DOVETAIL_INLINE double report::get(const std::string& key) const {
  std::string known;
  for (const auto& [name_of, value] : counters) {
    if (name_of == key)
      return value;
    known += (known.empty() ? " " : ", ") + name_of;
  }
  throw usage_error("the report '" + name + "' has no counter '" + key + "'; it has" +
                    (known.empty() ? " none" : known));
}

DOVETAIL_INLINE double report::get(const std::string& key, double otherwise) const {
  for (const auto& [name_of, value] : counters)
    if (name_of == key)
      return value;
  return otherwise;
}

DOVETAIL_INLINE const report& report::find(const std::string& part) const {
  static const report none{};
  for (const report& child : children)
    if (child.name == part)
      return child;
  for (const report& child : children)
    if (const report& found = child.find(part); !found.name.empty())
      return found;
  return none;
}

DOVETAIL_INLINE double stops_by_clock(const report& made) {
  double stops = made.as<clock_counts>().stops_by_clock;
  for (const report& part : made.children)
    stops += stops_by_clock(part);
  return stops;
}

} // namespace dovetail
