/// @file
/// Lists of the models of a role, by name: what programs, tests and documents read instead of naming each.
#pragma once

#include <tuple>
#include <utility>

namespace dovetail {

/// A policy and the name under which a program offers it.
template <class Policy>
struct listed {
  const char* name; ///< as programs spell it
  Policy policy;    ///< a policy of that name, with its defaults
};
template <class Policy>
listed(const char*, Policy) -> listed<Policy>;

/// Calls `visit(name, policy)` for all in a list, in its order.
template <class... Policies, class Visit>
void for_each_policy(const std::tuple<listed<Policies>...>& list, const Visit& visit) {
  std::apply([&](const auto&... each) { (visit(each.name, each.policy), ...); }, list);
}

namespace detail {

template <class... Policies>
std::tuple<Policies...> types_in(const std::tuple<listed<Policies>...>&);

} // namespace detail

/// The types of the policies in a list, as a `std::tuple`.
template <class List>
using policy_types = decltype(detail::types_in(std::declval<List>()));

} // namespace dovetail
