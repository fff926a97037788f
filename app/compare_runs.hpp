/// @file
/// Runs the pipeline for one combination of policies after the other.
#pragma once

#include "compare_options.hpp"
#include "compare_rows.hpp"
#include "model_source.hpp"
#include "pipeline.hpp"

#include <exception>
#include <functional>
#include <map>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

namespace dovetail::app {

/// All combinations that the options ask for, without repetition: partitioner varies slowest, simplifier
/// fastest.
std::vector<combination> combinations_of(const compare_options& options);

/// The options of `dovetail mesh` that run one of them.
mesh_options options_of_run(const compare_options& options, const combination& policies);

/// The background meshes of one model, made when they are first asked for: one for each mesher, since neither
/// partitioner nor improver nor simplification matters.
template <int D>
class background_store {
public:
  struct entry {
    const background_result<D>& background;
    bool reused; ///< it was there already
  };

  /// Throws what making it throws, every time it is asked for.
  entry get(const model_source& source, const policies_of<D>& policies, const generate_options& options);

private:
  std::map<std::string, std::variant<background_result<D>, std::exception_ptr>> made_;
};

/// What is given to whoever wants more of a result than its figures; the result ends with the call.
template <int D>
using result_observer = std::function<void(const comparison_row&, const generated<D>&)>;

/// Runs one combination. An error of the pipeline is a row with its text; `cancelled` is passed on.
template <int D>
comparison_row run_combination(const model_source& source, const combination& policies,
                               const policies_of<D>& chosen, const generate_options& options,
                               background_store<D>& backgrounds,
                               const std::type_identity_t<result_observer<D>>& observe);

} // namespace dovetail::app
