/// @file
/// Decompositions that were given up, since too many of their subdomains would have had to be merged: a run
/// that goes on does not begin with one, for its pieces are no more.
#pragma once

#include "dovetail/core/report.hpp"
#include "dovetail/parallel/any_executor.hpp"
#include "dovetail/parallel/run_results.hpp"
#include "dovetail/pipeline/background.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dovetail {

/// Adds to an account what a stage of a decomposition that is given up has taken.
inline void add_time(report& account, const std::string& stage, double seconds) {
  report& part = account.children.emplace_back();
  part.name = stage;
  part.seconds = seconds;
}

/// Takes from an account what stages of decompositions before have taken: it is time of the same stages.
inline void give_time_to_stages(report& account, std::vector<report>& stages) {
  for (const report& before : account.children)
    for (report& stage : stages)
      if (stage.name == before.name)
        stage.seconds += before.seconds;
  account.children.clear();
}

/// Keeps the accounts of decompositions of a background mesh where a later run finds them.
template <int D>
class given_up_decompositions {
public:
  explicit given_up_decompositions(const any_executor& run_tasks)
      : run_tasks_(run_tasks), kept_(lasting_store_of(run_tasks, "given_up")) {}

  /// The account of the one into as many subdomains as are planned, if it was given up.
  std::optional<report> find(const background_result<D>& background) const {
    if (!kept_)
      return {};
    return once(run_tasks_, [&] { return kept_->find_value<report>(key_of(background)); });
  }
  /// Stores the account of a decomposition that is given up.
  void keep(const background_result<D>& background, const report& account) {
    if (kept_ && leads(run_tasks_))
      kept_->keep_value(key_of(background), account);
  }

private:
  /// The rest is in the identity of the run.
  static content_key key_of(const background_result<D>& background) {
    key_maker make;
    make(std::int64_t{D})(std::int64_t{background.plan.subdomains});
    return make(static_cast<std::int64_t>(background.mesh.elements().elements.size())).key();
  }

  const any_executor& run_tasks_;
  std::shared_ptr<entity_store> kept_;
};

} // namespace dovetail
