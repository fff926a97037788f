#include "compare_runs.hpp"

#include "failure.hpp"
#include "file_checksums.hpp"
#include "policies.hpp"
#include "stage_figures.hpp"

#include "dovetail/files/finishing_pass.hpp"
#include "dovetail/sizing/compose.hpp"

#include <algorithm>
#include <cmath>
#include <new>
#include <utility>

namespace dovetail::app {
namespace {

/// The names once each, in their order; `otherwise` when there are none.
std::vector<std::string> distinct_or(const std::vector<std::string>& names,
                                     const std::vector<std::string>& otherwise) {
  std::vector<std::string> distinct;
  for (const auto& name : names)
    if (std::find(distinct.begin(), distinct.end(), name) == distinct.end())
      distinct.push_back(name);
  return distinct.empty() ? otherwise : distinct;
}

/// The default one when there are none.
std::vector<std::string> distinct_or_default(const std::vector<std::string>& names,
                                             const std::vector<std::string>& known) {
  return distinct_or(names, {known.front()});
}

template <class Error>
bool is(const error& problem) {
  return dynamic_cast<const Error*>(&problem) != nullptr;
}

/// The library's name of an error's type.
std::string kind_of(const error& problem) {
  const std::pair<bool, const char*> kinds[] = {
      {is<input_error>(problem), "input_error"},
      {is<geometry_error>(problem), "geometry_error"},
      {is<sizing_error>(problem), "sizing_error"},
      {is<intersection_error>(problem), "intersection_error"},
      {is<partition_error>(problem), "partition_error"},
      {is<mesher_error>(problem), "mesher_error"},
      {is<mesh_error>(problem), "mesh_error"},
      {is<io_error>(problem), "io_error"},
      {is<usage_error>(problem), "usage_error"},
  };
  for (const auto& [matches, name] : kinds)
    if (matches)
      return name;
  return "error";
}

interface_row row_of(const interface_angles& angles) {
  interface_row row;
  row.faces = static_cast<std::int64_t>(angles.interface_faces);
  row.under_threshold = static_cast<std::int64_t>(angles.violations.size());
  if (row.faces > 0) {
    row.min_face_angle = angles.face_angle.measured().value_or(row.min_face_angle);
    row.min_dihedral = angles.min_dihedral().measured().value_or(row.min_dihedral);
  }
  return row;
}

template <int D>
void add_figures(const generated<D>& result, comparison_row& row) {
  row.background_elements = static_cast<std::int64_t>(result.background.elements().elements.size());
  row.subdomains = static_cast<int>(result.mesh.counts.size());
  const piece_figures pieces = figures_of_pieces(result.mesh.counts);
  row.elements = pieces.elements;
  row.imbalance = pieces.imbalance;
  row.seconds = seconds_of_stages(result.summary);
  row.quality = result.quality;
  row.coarse = row_of(result.coarse_angles);
  row.fine = row_of(result.fine_angles);
}

} // namespace

std::vector<combination> combinations_of(const compare_options& options) {
  std::vector<combination> all;
  const auto known_meshers = options.dimension == 3 ? mesher_names<3>() : mesher_names<2>();
  for (const auto& partitioner : distinct_or_default(options.partitioners, partitioner_names()))
    for (const auto& mesher : distinct_or_default(options.meshers, known_meshers))
      for (const auto& improver : distinct_or_default(options.improvers, improver_names()))
        for (const auto& simplifier : distinct_or(options.simplifiers, {"paper", "none"}))
          all.push_back({partitioner, mesher, improver, simplifier});
  return all;
}

mesh_options options_of_run(const compare_options& options, const combination& policies) {
  mesh_options run;
  run.model = options.model;
  run.dimension = options.dimension;
  run.subdomains = options.subdomains;
  run.coarsening = options.coarsening;
  run.workers = options.workers;
  run.executor = options.executor;
  run.partitioner = policies.partitioner;
  run.mesher = policies.mesher;
  run.improver = policies.improver;
  run.simplifier = policies.simplifier;
  return run;
}

template <int D>
typename background_store<D>::entry background_store<D>::get(const model_source& source,
                                                             const policies_of<D>& policies,
                                                             const generate_options& options) {
  const std::string& mesher = policies.mesher.name();
  const bool reused = made_.contains(mesher);
  if (!reused) {
    try {
      made_[mesher] = make_background_mesh<D>(source.geometry, source.size, policies, options);
    } catch (const cancelled&) {
      throw;
    } catch (const error&) {
      made_[mesher] = std::current_exception();
    }
  }
  if (const auto* failure = std::get_if<std::exception_ptr>(&made_[mesher]))
    std::rethrow_exception(*failure);
  return {std::get<background_result<D>>(made_[mesher]), reused};
}

template <int D>
comparison_row run_combination(const model_source& source, const combination& policies,
                               const policies_of<D>& chosen, const generate_options& options,
                               background_store<D>& backgrounds,
                               const std::type_identity_t<result_observer<D>>& observe) {
  comparison_row row;
  row.policies = policies;
  try {
    const auto [background, reused] = backgrounds.get(source, chosen, options);
    row.background_reused = reused;
    const auto result = generate_mesh_from<D>(background, source.geometry, chosen, options);
    if (!result.failures.empty()) {
      const auto& first = result.failures.front();
      throw mesher_error(std::to_string(result.failures.size()) +
                         " subdomains could not be meshed; subdomain " + std::to_string(first.subdomain) +
                         ": " + joined_reasons(first.reasons));
    }
    add_figures(result, row);
    if (result.mesh.load)
      row.mesh_hash = hexadecimal(
          io::finish_mesh<D>(result.mesh, {}, {}, chosen.executor, {.on_progress = options.on_progress})
              .hash);
    observe(row, result);
  } catch (const cancelled&) {
    throw;
  } catch (const error& problem) {
    row.error = kind_of(problem) + ": " + problem.what();
  } catch (const std::bad_alloc&) {
    row.error = "out of memory";
  }
  return row;
}

template class background_store<2>;
template class background_store<3>;
template comparison_row run_combination<2>(const model_source&, const combination&, const policies_of<2>&,
                                           const generate_options&, background_store<2>&,
                                           const result_observer<2>&);
template comparison_row run_combination<3>(const model_source&, const combination&, const policies_of<3>&,
                                           const generate_options&, background_store<3>&,
                                           const result_observer<3>&);

} // namespace dovetail::app
