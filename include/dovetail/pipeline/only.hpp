/// @file
/// Checks of `generate_options::only` and `alone`.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/pipeline/parameters.hpp"

#include <algorithm>
#include <functional>
#include <string>

namespace dovetail::detail {

/// Throws `usage_error` where pieces are to be made without the rest, and cannot.
template <int D>
void require_separable(const generate_options& options) {
  if (!options.alone)
    return;
  if (D == 2)
    throw usage_error("generate_options::alone is for tetrahedra");
  if (options.only.empty())
    throw usage_error("generate_options::alone needs subdomains in generate_options::only");
  if (options.repartition_locally)
    throw usage_error("generate_options::alone needs generate_options::repartition_locally = false: "
                      "which interfaces move is decided by the whole decomposition");
}

/// Throws `usage_error` where the subdomains do not grow, each once, from 0.
inline void require_growing_only(const generate_options& options) {
  const auto& only = options.only;
  if (std::adjacent_find(only.begin(), only.end(), std::greater_equal<>()) != only.end() ||
      (!only.empty() && only.front() < 0))
    throw usage_error("generate_options::only lists subdomains from 0 on that grow, each once");
}

/// Throws `usage_error` where only some pieces are asked for.
inline void refuse_only(const generate_options& options, const std::string& who) {
  if (!options.only.empty())
    throw usage_error(who + " makes whole meshes: generate_options::only must be empty");
}

} // namespace dovetail::detail
