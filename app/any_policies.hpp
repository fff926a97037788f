/// @file
/// Policies chosen at run time: thin models of the library's role concepts that forward to a held policy.
/// With them the pipeline is instantiated once in the driver, not once per combination of names on the
/// command line.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/improver/concepts.hpp"
#include "dovetail/improver/surface_host.hpp"
#include "dovetail/mesher/concepts.hpp"
#include "dovetail/mesher/fallbacks.hpp"
#include "dovetail/mesher/preferences.hpp"
#include "dovetail/parallel/concepts.hpp"
#include "dovetail/parallel/run_task.hpp"
#include "dovetail/partition/concepts.hpp"

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::app {

/// Holds any graph partitioner.
class any_partitioner {
public:
  template <graph_partitioner P>
  any_partitioner(std::string name, P policy) : name_(std::move(name)), call_(std::move(policy)) {}

  const std::string& name() const { return name_; }
  std::vector<local_id> operator()(const csr_graph& graph, int parts) const { return call_(graph, parts); }

private:
  std::string name_;
  std::function<std::vector<local_id>(const csr_graph&, int)> call_;
};
static_assert(graph_partitioner<any_partitioner>);

/// Holds any volume mesher that keeps its boundary.
class any_mesher {
public:
  /// What every mesher the driver offers promises; `actual_traits` are the held one's.
  static constexpr mesher_traits traits{.keeps_boundary = true, .may_crash = true};
  /// Meshers are calibrated to the same mean edge length, so one figure serves all of them for predictions.
  static constexpr double elements_per_inverse_cubed_size = 11.6;

  template <boundary_keeping_mesher<3> M>
  any_mesher(std::string name, M policy)
      : name_(std::move(name)), actual_traits_(M::traits),
        elements_per_subdomain_(dovetail::elements_per_subdomain(policy)), call_(policy) {
    const std::vector<M> ladder = ladder_of(policy);
    for (std::size_t rung = 1; rung < ladder.size(); ++rung)
      fallbacks_.push_back(any_mesher(name_, ladder[rung], no_fallbacks{}));
  }

  /// The same with another mesher as the last rung of the ladder, for pieces that this one cannot mesh.
  any_mesher with_fallback(any_mesher other) const {
    any_mesher extended = *this;
    extended.fallbacks_.push_back(std::move(other));
    return extended;
  }

  const std::string& name() const { return name_; }
  const mesher_traits& actual_traits() const { return actual_traits_; }
  double elements_per_subdomain() const { return elements_per_subdomain_; }
  std::vector<any_mesher> fallbacks() const { return fallbacks_; }
  mesher_result<3> operator()(const mesher_input<3>& input, const any_sizing& size) const {
    return call_(input, size);
  }

private:
  struct no_fallbacks {};

  template <boundary_keeping_mesher<3> M>
  any_mesher(std::string name, M policy, no_fallbacks)
      : name_(std::move(name)), actual_traits_(M::traits),
        elements_per_subdomain_(dovetail::elements_per_subdomain(policy)), call_(std::move(policy)) {}

  std::string name_;
  mesher_traits actual_traits_;
  double elements_per_subdomain_;
  std::function<mesher_result<3>(const mesher_input<3>&, const any_sizing&)> call_;
  std::vector<any_mesher> fallbacks_;
};
static_assert(boundary_keeping_mesher<any_mesher, 3> && has_fallbacks<any_mesher>);

/// Holds any mesher of triangles that keeps its boundary; `actual_traits` are the held one's.
class any_surface_mesher {
public:
  /// Threads are given to it only if `actual_traits` allow them.
  static constexpr mesher_traits traits{.keeps_boundary = true, .thread_safe = true};

  template <boundary_keeping_mesher<2> M>
  any_surface_mesher(std::string name, M policy)
      : name_(std::move(name)), actual_traits_(M::traits), call_(std::move(policy)) {}

  const std::string& name() const { return name_; }
  const mesher_traits& actual_traits() const { return actual_traits_; }
  mesher_result<2> operator()(const mesher_input<2>& input, const any_sizing& size) const {
    return call_(input, size);
  }

private:
  std::string name_;
  mesher_traits actual_traits_;
  std::function<mesher_result<2>(const mesher_input<2>&, const any_sizing&)> call_;
};
static_assert(boundary_keeping_mesher<any_surface_mesher, 2>);

/// Holds any improver of tetrahedra; those that improve triangles too do so here.
class any_improver {
public:
  template <improver<3> I>
  any_improver(std::string name, I policy) : name_(std::move(name)), call_(policy) {
    if constexpr (improver<I, 2>)
      call_on_triangles_ = [policy](simplicial_mesh<2>& mesh, const frozen_entities<2>& frozen,
                                    const any_sizing& size, const surface_host& host) {
        if constexpr (requires { policy(mesh, frozen, size, host); })
          return policy(mesh, frozen, size, host);
        frozen_entities<2> in_place = frozen;
        if (host) // it cannot know the surface: flips alone keep points there
          in_place.points = static_cast<local_id>(mesh.points.size());
        return policy(mesh, in_place, size);
      };
  }

  const std::string& name() const { return name_; }
  bool takes_triangles() const { return static_cast<bool>(call_on_triangles_); }
  /// Throws `usage_error` when the held policy does not take triangles.
  report operator()(simplicial_mesh<2>& mesh, const frozen_entities<2>& frozen, const any_sizing& size,
                    const surface_host& host = {}) const {
    if (!takes_triangles())
      throw usage_error("the improver " + name_ + " does not take meshes of triangles; use fine");
    return call_on_triangles_(mesh, frozen, size, host);
  }
  report operator()(simplicial_mesh<3>& mesh, const frozen_entities<3>& frozen,
                    const any_sizing& size) const {
    return call_(mesh, frozen, size);
  }

private:
  std::string name_;
  std::function<report(simplicial_mesh<3>&, const frozen_entities<3>&, const any_sizing&)> call_;
  std::function<report(simplicial_mesh<2>&, const frozen_entities<2>&, const any_sizing&,
                       const surface_host&)>
      call_on_triangles_;
};
static_assert(improver<any_improver, 3> && improver<any_improver, 2>);

/// Holds any executor.
class any_executor {
public:
  template <executor E>
  any_executor(std::string name, E policy)
      : name_(std::move(name)), workers_(policy.workers()), in_threads_(runs_in_threads(policy)),
        run_([held = std::make_shared<const E>(std::move(policy))](
                 std::size_t count, const task_function& task, const run_options& options) {
          return held->run(count, task, options);
        }) {}

  const std::string& name() const { return name_; }
  int workers() const { return workers_; }
  bool shares_process() const { return in_threads_; }
  std::vector<task_outcome> run(std::size_t count, const task_function& task,
                                const run_options& options) const {
    return run_(count, task, options);
  }

private:
  std::string name_;
  int workers_;
  bool in_threads_;
  std::function<std::vector<task_outcome>(std::size_t, const task_function&, const run_options&)> run_;
};
static_assert(executor<any_executor>);

} // namespace dovetail::app
