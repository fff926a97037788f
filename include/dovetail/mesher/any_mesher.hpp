/// @file
/// Any mesher that keeps its boundary behind one type, so that the pipeline is compiled once and not once per
/// mesher.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/policy.hpp"
#include "dovetail/mesher/concepts.hpp"
#include "dovetail/mesher/fallbacks.hpp"
#include "dovetail/mesher/preferences.hpp"

#include <concepts>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

/// Holds a mesher with its traits, preferences, fallbacks and background form by value; a mesher converts to
/// it. Made by default it holds none: whoever calls it then gets a `usage_error`. A call costs one indirect
/// call.
template <int D>
class any_mesher {
public:
  /// What every held mesher promises; its own traits are `actual_traits`.
  static constexpr mesher_traits traits{.keeps_boundary = true, .may_crash = true};

  any_mesher() = default;
  template <class M>
    requires(!std::same_as<M, any_mesher> && boundary_keeping_mesher<M, D>)
  any_mesher(M policy, std::string name = {}) // NOLINT: converts, as std::function does
      : any_mesher(policy, std::move(name), without_fallbacks{}) {
    const std::vector<M> meshers = with_fallbacks(policy);
    for (std::size_t attempt = 1; attempt < meshers.size(); ++attempt)
      fallbacks_.push_back(any_mesher(meshers[attempt], name_, without_fallbacks{}));
    if constexpr (has_background_form<M>)
      background_ =
          std::make_shared<const any_mesher>(any_mesher(policy.for_background(), name_, without_fallbacks{}));
  }

  /// What is no mesher does not convert; where one is asked for by name, the compiler's error says why not.
  template <class M>
    requires(!std::same_as<M, any_mesher> && !boundary_keeping_mesher<M, D>)
  explicit any_mesher(const M&, const std::string& = {}) {
    static_assert(boundary_keeping_mesher<M, D>,
                  "any_mesher<D> holds a boundary_keeping_mesher of dimension D (mesher/concepts.hpp)");
  }

  /// The same with another mesher as the last fallback, for pieces that this one cannot mesh.
  any_mesher with_fallback(any_mesher other) const {
    any_mesher extended = *this;
    extended.fallbacks_.push_back(std::move(other));
    return extended;
  }

  /// The same without those fallbacks that must not run in several threads of one process.
  any_mesher for_threads() const {
    any_mesher reduced = *this;
    std::erase_if(reduced.fallbacks_,
                  [](const any_mesher& other) { return !other.actual_traits_.thread_safe; });
    return reduced;
  }

  /// The mesher for the mesh that is decomposed, with this one and its fallbacks after it; this one when it
  /// has no form for that.
  any_mesher for_background() const {
    if (!background_)
      return *this;
    any_mesher form = *background_;
    form.fallbacks_ = with_fallbacks(*this);
    return form;
  }

  /// Whether the mesher has a form for background meshes.
  bool has_form_for_background() const { return background_ != nullptr; }

  explicit operator bool() const { return static_cast<bool>(call_); } ///< whether it holds one
  /// The name it was given, for reports; may be empty.
  const std::string& name() const { return name_; }
  const mesher_traits& actual_traits() const { return actual_traits_; }
  /// What the mesher that it holds says.
  double elements_per_inverse_cubed_size() const { return elements_per_inverse_cubed_size_; }
  double elements_per_subdomain() const { return elements_per_subdomain_; }
  std::vector<any_mesher> fallbacks() const { return fallbacks_; } ///< those of the mesher that it holds
  mesher_result<D> operator()(const mesher_input<D>& input, const any_sizing& size) const {
    if (!call_)
      throw usage_error("no mesher was chosen: parameters<>{}.with_mesher(...)");
    return call_(input, size);
  }

private:
  struct without_fallbacks {};

  template <boundary_keeping_mesher<D> M>
  any_mesher(M policy, std::string name, without_fallbacks /*tag*/)
      : name_(std::move(name)), actual_traits_(policy_traits(policy)),
        elements_per_inverse_cubed_size_(dovetail::elements_per_inverse_cubed_size<M>()),
        elements_per_subdomain_(dovetail::elements_per_subdomain(policy)), call_(std::move(policy)) {}

  std::string name_;
  mesher_traits actual_traits_ = traits;
  double elements_per_inverse_cubed_size_ = 0;
  double elements_per_subdomain_ = default_elements_per_subdomain;
  std::function<mesher_result<D>(const mesher_input<D>&, const any_sizing&)> call_;
  std::vector<any_mesher> fallbacks_;
  std::shared_ptr<const any_mesher> background_; ///< its fallbacks are this one's
};
static_assert(boundary_keeping_mesher<any_mesher<2>, 2> && boundary_keeping_mesher<any_mesher<3>, 3>);

} // namespace dovetail
