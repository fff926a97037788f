/// @file
/// A policy that holds another and changes a part of what that does. What is not changed must not be lost: a
/// concept has optional members, and a policy without one is taken for a plainer one, in silence.
#pragma once

#include "dovetail/core/policy.hpp"

#include <concepts>
#include <type_traits>
#include <utility>

namespace dovetail {

/// The base of the `wraps` of each role. `Self` is the policy that derives from it.
template <class Self, class Policy>
struct wrapped_policy {
  /// What is wrapped.
  Policy wrapped{};

  wrapped_policy() = default;
  // Of nothing that converts to a policy, as a wrapper may itself.
  template <std::same_as<Policy> Given>
  wrapped_policy(Given policy) // NOLINT: converts, so that a list of members can begin with the policy
      : wrapped(std::move(policy)) {}

  /// The name of the wrapped policy.
  auto name() const requires detail::names_itself<Policy> { return wrapped.name(); }
  /// Whether the wrapped policy, which holds another one, holds any.
  explicit operator bool() const requires detail::can_be_missing<Policy> {
    return static_cast<bool>(wrapped);
  }

  /// The same, around another policy of the type.
  Self around(Policy other) const {
    Self changed = static_cast<const Self&>(*this);
    changed.wrapped = std::move(other);
    return changed;
  }
};

namespace detail {

template <class Self, class Policy>
std::type_identity<Self> self_of(const wrapped_policy<Self, Policy>& wrapper);

/// Whether a policy that derives from `wraps<Self, Policy>` is that `Self`: what is made of another one, such
/// as fallbacks, would lose what this one changes.
template <class Policy>
consteval bool wraps_by_itself() {
  if constexpr (requires(const Policy& policy) { self_of(policy); })
    return std::same_as<decltype(self_of(std::declval<const Policy&>())), std::type_identity<Policy>>;
  else
    return true;
}

} // namespace detail

} // namespace dovetail
