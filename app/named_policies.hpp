/// @file
/// Lists of policies that have names.
#pragma once

#include "failure.hpp"

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

/// The policy of that name, the first one for an empty name. Throws `command_line_error` listing the names.
template <class Policy>
Policy chosen(const std::vector<Policy>& policies, const std::string& name, const std::string& option) {
  if (name.empty())
    return policies.front();
  for (const auto& policy : policies)
    if (policy.name() == name)
      return policy;
  std::string known;
  for (const std::string& other : names_of(policies))
    known += (known.empty() ? "" : ", ") + other;
  throw command_line_error(option + ": there is no '" + name + "'; there are: " + known);
}

} // namespace dovetail::app
