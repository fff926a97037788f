/// @file
/// Lists of policies that have names.
#pragma once

#include "failure.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace dovetail::app {

template <class Policy>
std::vector<std::string> names_of(const std::vector<Policy>& policies) {
  std::vector<std::string> names;
  for (const auto& policy : policies)
    names.push_back(policy.name());
  return names;
}

/// The names in one text, with commas between them.
inline std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const auto& name : names)
    text += (text.empty() ? "" : ", ") + name;
  return text;
}

/// The name among those known, the first of them for an empty one. Throws `command_line_error` listing them.
inline std::string chosen_name(const std::vector<std::string>& known, const std::string& name,
                               const std::string& option) {
  if (name.empty())
    return known.front();
  if (std::find(known.begin(), known.end(), name) == known.end())
    throw command_line_error(option + ": there is no '" + name + "'; there are: " + joined(known));
  return name;
}

/// The policy of that name, the first one for an empty name. Throws `command_line_error` listing the names.
template <class Policy>
Policy chosen(const std::vector<Policy>& policies, const std::string& name, const std::string& option) {
  const std::string found = chosen_name(names_of(policies), name, option);
  return *std::find_if(policies.begin(), policies.end(),
                       [&](const Policy& policy) { return policy.name() == found; });
}

} // namespace dovetail::app
