/// @file
/// Any mesher of whole domains that follows lines behind one type, for the background mesh.
#pragma once

#include "dovetail/mesher/concepts.hpp"

#include <concepts>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

/// Holds any mesher of whole domains that follows lines by value; one converts to it. Made by default it
/// holds none: the background mesh is then made from the coarse surface by the mesher of the pieces. A call
/// costs one indirect call.
class any_line_keeping_mesher {
public:
  static constexpr mesher_traits traits{};

  any_line_keeping_mesher() = default;
  /// Holds none under a name.
  static any_line_keeping_mesher none(std::string name) {
    any_line_keeping_mesher nothing;
    nothing.name_ = std::move(name);
    return nothing;
  }
  template <class M>
    requires(!std::same_as<M, any_line_keeping_mesher> && line_keeping_mesher<M>)
  any_line_keeping_mesher(M policy, std::string name = {}) // NOLINT: converts, as std::function does
      : name_(std::move(name)),
        call_([held = std::move(policy)](const auto& lines, const auto& input, const auto& size) {
          return held.with_lines(lines)(input, size);
        }) {}

  const std::string& name() const { return name_; } ///< the name it was given, for reports; may be empty
  explicit operator bool() const { return static_cast<bool>(call_); } ///< whether it holds one

  any_line_keeping_mesher with_lines(std::vector<std::vector<vec3>> lines) const {
    any_line_keeping_mesher changed = *this;
    changed.lines_ = std::move(lines);
    return changed;
  }
  mesher_result<3> operator()(const mesher_input<3>& input, const any_sizing& size) const {
    return call_(lines_, input, size);
  }

private:
  std::string name_;
  std::function<mesher_result<3>(const std::vector<std::vector<vec3>>&, const mesher_input<3>&,
                                 const any_sizing&)>
      call_;
  std::vector<std::vector<vec3>> lines_;
};
static_assert(line_keeping_mesher<any_line_keeping_mesher>);

} // namespace dovetail
