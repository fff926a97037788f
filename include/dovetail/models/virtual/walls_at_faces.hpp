/// @file
/// Which faces have thin walls behind them, or in front.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/geometry/any_geometry.hpp"
#include "dovetail/sizing/concepts.hpp"
#include "dovetail/sizing/facing_search.hpp"
#include "dovetail/sizing/surface_samples.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace dovetail::virtual_topology::detail {

/// Where the wall behind a face, or in front of it, is thinner than half of the limit. Its two sides must be
/// meshed alike there, which lines along both of them do best. The model is sampled at the first question.
class walls_at_faces {
public:
  walls_at_faces(const any_geometry& model, const any_sizing& limit) : model_(model), limit_(limit) {}

  /// Whether it is so anywhere at a face.
  bool are_thin(local_id f) {
    const auto known = thin_.find(f);
    return known != thin_.end() ? known->second : thin_.emplace(f, is_thin(f)).first->second;
  }

private:
  static constexpr double thin = 0.5; ///< limits

  bool is_thin(local_id f) {
    if (!search_)
      sample();
    const auto& solids = model_.topology().faces[f].solids;
    return std::any_of(of_face_[f].begin(), of_face_[f].end(), [&](std::size_t k) {
      const sizing::surface_sample& s = search_->samples()[k];
      const double reach = thin * limit_(s.point);
      return (solids[0] != no_id && search_->find(s, 0, reach, reach)) ||
             (solids[1] != no_id && search_->find(s, 1, reach, reach));
    });
  }

  void sample() {
    const sizing::sampling_limits most{.per_face = 1000, .least_halvings = 3};
    const auto spacing = [this](const sizing::surface_sample& s) { return limit_(s.point); };
    std::vector<sizing::surface_sample> samples;
    for (std::size_t f = 0; f < model_.topology().faces.size(); ++f)
      try {
        const auto found = sizing::surface_sampler(model_, spacing, most).run(static_cast<local_id>(f));
        samples.insert(samples.end(), found.begin(), found.end());
      } catch (const geometry_error&) { // of a place where the kernel cannot evaluate the face
      }
    search_.emplace(std::move(samples), model_.topology());
    of_face_.resize(model_.topology().faces.size());
    for (std::size_t k = 0; k < search_->samples().size(); ++k)
      of_face_[search_->samples()[k].face].push_back(k);
  }

  const any_geometry& model_;
  any_sizing limit_;
  std::optional<sizing::facing_search> search_;
  std::vector<std::vector<std::size_t>> of_face_;
  std::map<local_id, bool> thin_; ///< by face, of those asked for
};

} // namespace dovetail::virtual_topology::detail
