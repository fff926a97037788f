/// @file
/// What may be asked of any policy, whether it has an answer of its own or not. One that holds another behind
/// one type (`any_mesher`, ...) answers for the one that it holds.
#pragma once

#include <concepts>
#include <string>

namespace dovetail {

namespace detail {

template <class Policy>
concept can_be_missing = requires(const Policy& policy) {
  static_cast<bool>(policy);
};
template <class Policy>
concept names_itself = requires(const Policy& policy) {
  { policy.name() } -> std::convertible_to<std::string>;
};
template <class Policy>
concept has_actual_traits = requires(const Policy& policy) {
  policy.actual_traits();
};

} // namespace detail

/// Whether there is a policy to call: one that holds another may hold none.
template <class Policy>
bool is_given(const Policy& policy) {
  if constexpr (detail::can_be_missing<Policy>)
    return static_cast<bool>(policy);
  else
    return true;
}

/// The name that a policy was given, for reports and errors; empty for one that has none.
template <class Policy>
std::string policy_name(const Policy& policy) {
  if constexpr (detail::names_itself<Policy>)
    return policy.name();
  else
    return {};
}

/// The traits of a policy, which may depend on its members.
template <class Policy>
auto policy_traits(const Policy& policy) {
  if constexpr (detail::has_actual_traits<Policy>)
    return policy.actual_traits();
  else
    return Policy::traits;
}

/// Whether a policy's type alone says that it must not run in threads.
template <class Policy>
constexpr bool is_never_thread_safe() {
  if constexpr (detail::has_actual_traits<Policy>)
    return false;
  else
    return !Policy::traits.thread_safe;
}

} // namespace dovetail
