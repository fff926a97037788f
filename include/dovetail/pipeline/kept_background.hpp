/// @file
/// The background mesh in the spool of a run, where a resumed run finds it. A sizing field is a function and
/// stays with the caller; what the surface asks of it are data.
#pragma once

#include "dovetail/core/content_key.hpp"
#include "dovetail/parallel/any_executor.hpp"
#include "dovetail/parallel/entity_store.hpp"
#include "dovetail/pipeline/background.hpp"

#include <optional>

namespace dovetail {

namespace detail {

/// All that it is a function of is in the identity of the spool. Model and sizes are looked at here too, for
/// an identity that forgets them.
content_key background_key(int dimension, const any_geometry& model, const erased_sizing& size);

} // namespace detail

/// The background mesh that an earlier run of the spool's identity has kept; "kept" in its summary says so.
/// All ranks have what the one finds that leads.
template <int D>
std::optional<background_result<D>> find_background(const std::optional<spool>& disk,
                                                    const any_geometry& model, const erased_sizing& size,
                                                    const any_executor& run) {
  const stopwatch clock;
  if (!disk)
    return std::nullopt;
  auto found = run.once([&] {
    return entity_store(disk, "background")
        .find_value<background_result<D>>(detail::background_key(D, model, size));
  });
  if (!found)
    return std::nullopt;
  found->size = allowed_size<D>(enlarged(size, found->plan), found->bounds);
  found->summary.seconds = clock.seconds(); // of this run
  auto counts = found->summary.template as<background_counts>();
  counts.kept = 1;
  found->summary.set(counts);
  return found;
}

/// Puts a background mesh into the spool, if there is one.
template <int D>
void keep_background(const std::optional<spool>& disk, const any_geometry& model, const erased_sizing& size,
                     const background_result<D>& background, const any_executor& run) {
  if (disk && run.leads())
    entity_store(disk, "background").keep_value(detail::background_key(D, model, size), background);
}

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/pipeline/kept_background.ipp"
#endif
