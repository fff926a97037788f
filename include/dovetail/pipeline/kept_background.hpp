/// @file
/// The background mesh of a run that keeps its results on a disk, where a resumed run finds it. A sizing
/// field is a function and stays with the caller; what the surface asks of it are data.
#pragma once

#include "dovetail/geometry/any_geometry.hpp"
#include "dovetail/parallel/any_executor.hpp"
#include "dovetail/parallel/run_results.hpp"
#include "dovetail/pipeline/background.hpp"

#include <optional>

namespace dovetail {

namespace detail {

/// All that it is a function of is in the identity of the run. Model and sizes are looked at here too, for
/// an identity that forgets them.
content_key background_key(int dimension, const any_geometry& model, const erased_sizing& size);

} // namespace detail

/// The background mesh that an earlier run of the same identity has kept; "kept" in its summary says so. All
/// ranks have what the one finds that leads.
template <int D>
std::optional<background_result<D>> find_background(const any_geometry& model, const erased_sizing& size,
                                                    const any_executor& run) {
  const stopwatch clock;
  const auto store = lasting_store_of(run, "background");
  if (!store)
    return std::nullopt;
  auto found = once(
      run, [&] { return store->find_value<background_result<D>>(detail::background_key(D, model, size)); });
  if (!found)
    return std::nullopt;
  found->size = allowed_size<D>(enlarged(size, found->plan), found->bounds);
  found->summary.seconds = clock.seconds(); // of this run
  auto counts = found->summary.template as<background_counts>();
  counts.kept = 1;
  found->summary.set(counts);
  return found;
}

/// Keeps a background mesh, if a later run can find it.
template <int D>
void keep_background(const any_geometry& model, const erased_sizing& size,
                     const background_result<D>& background, const any_executor& run) {
  if (const auto store = lasting_store_of(run, "background"); store && leads(run))
    store->keep_value(detail::background_key(D, model, size), background);
}

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/pipeline/kept_background.ipp"
#endif
