/// @file
/// The mesher that makes the background mesh, chosen at run time.
#pragma once

#include "dovetail/mesher/concepts.hpp"

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::app {

/// Holds any mesher of whole domains that follows lines; or none, and the background mesh is made from the
/// coarse surface by the mesher of the pieces.
class any_background_mesher {
public:
  static constexpr mesher_traits traits{};

  any_background_mesher() = default;
  template <line_keeping_mesher M>
  any_background_mesher(std::string name, M policy)
      : name_(std::move(name)),
        call_([held = std::move(policy)](const auto& lines, const auto& input, const auto& size) {
          return held.with_lines(lines)(input, size);
        }) {}

  const std::string& name() const { return name_; }
  bool meshes_whole_domains() const { return static_cast<bool>(call_); }

  any_background_mesher with_lines(std::vector<std::vector<vec3>> lines) const {
    any_background_mesher changed = *this;
    changed.lines_ = std::move(lines);
    return changed;
  }
  mesher_result<3> operator()(const mesher_input<3>& input, const any_sizing& size) const {
    return call_(lines_, input, size);
  }

private:
  std::string name_ = "native";
  std::function<mesher_result<3>(const std::vector<std::vector<vec3>>&, const mesher_input<3>&,
                                 const any_sizing&)>
      call_;
  std::vector<std::vector<vec3>> lines_;
};
static_assert(line_keeping_mesher<any_background_mesher>);

} // namespace dovetail::app
