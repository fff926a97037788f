#include "run_setup.hpp"

#include "failure.hpp"
#include "named_policies.hpp"
#include "output_formats.hpp"
#include "policies.hpp"
#include "rank_partitioner.hpp"

#include "dovetail/core/number_text.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/parallel/available_processors.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace dovetail::app {

namespace {

/// What has no part in a decomposition without a background mesh may not be asked for.
void check_decomposition(const mesh_options& options, int dimension) {
  const std::string name = chosen_name(decomposition_names(), options.decomposition, "--decomposition");
  if (name == decomposition_names().front())
    return;
  const std::string given = "--decomposition " + name;
  if (!options.only.empty())
    throw command_line_error(given + " cannot make pieces by themselves: leave --only out");
  if (dimension == 2)
    throw command_line_error(given + " divides solids; with --dimension 2 there are none");
  const bool parts_later = options.redistribute == by_elements;
  if (options.ranks && !options.subdomains && !parts_later)
    throw command_line_error(given + " with --ranks: give --subdomains, or --redistribute " + by_elements);
  for (const auto& [option, is_given] :
       {std::pair("--paper", options.paper), std::pair("--weights", !options.weights.empty()),
        std::pair("--super-element-bound", !options.super_element_bound.empty()),
        std::pair("--segment-matching", !options.segment_matching.empty()),
        std::pair("--local-repartition", !options.local_repartition.empty()),
        std::pair("--coarsening", options.coarsening.has_value()),
        std::pair("--background-mesher", !options.background_mesher.empty()),
        std::pair("--background-improver", !options.background_improver.empty()),
        std::pair("--simplifier", !options.simplifier.empty() && !parts_later),
        std::pair("--dihedral-angle", options.dihedral_angle.has_value() && !parts_later),
        std::pair("--partitioner",
                  !options.partitioner.empty() && !parts_later && name != by_fine_partition)})
    if (is_given)
      throw command_line_error(given + " has no background mesh: " + option +
                               " does nothing there, leave it out");
}

/// Whether nothing is said that only a decomposition is for: then a small mesh may be one piece. Other
/// meshers than the default one take longer, or are there to be compared.
bool leaves_decomposition_open(const mesh_options& options) {
  return options.dimension == 3 && !options.subdomains && !options.ranks && options.files == 0 &&
         !options.coarsening && !options.dihedral_angle && options.partitioner.empty() &&
         options.simplifier.empty() && options.background_mesher.empty() &&
         options.background_improver.empty() && options.decomposition.empty() && options.weights.empty() &&
         options.super_element_bound.empty() && options.segment_matching.empty() &&
         options.local_repartition.empty() && !options.paper &&
         (options.mesher.empty() || options.mesher == "native");
}

/// The number of a subdomain, all of the text; nothing where it is none.
std::optional<local_id> subdomain_number(std::string_view text) {
  local_id number = no_id;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || number < 0)
    return std::nullopt;
  return number;
}

/// The subdomains that `--only` lists, growing.
std::vector<local_id> subdomains_in(const std::vector<std::string>& list) {
  constexpr std::size_t most = 10'000'000;
  std::vector<local_id> numbers;
  for (const std::string_view item : list) {
    const auto dash = item.find('-');
    const auto first = subdomain_number(item.substr(0, dash));
    const auto last = dash == item.npos ? first : subdomain_number(item.substr(dash + 1));
    if (!first || !last || *last < *first)
      throw command_line_error("--only: '" + std::string(item) +
                               "' is neither the number of a subdomain nor a range like 12-15");
    if (numbers.size() + static_cast<std::size_t>(*last - *first) >= most)
      throw command_line_error("--only: these are more than " + std::to_string(most) + " subdomains");
    for (local_id k = 0; k <= *last - *first; ++k) // the last number may be the largest that there is
      numbers.push_back(*first + k);
  }
  sort_unique(numbers);
  return numbers;
}

void check_alone(const mesh_options& options) {
  if (!options.alone)
    return;
  if (options.only.empty())
    throw command_line_error("--alone: give the subdomains with --only");
  if (options.dimension == 2)
    throw command_line_error("--alone is for tetrahedra; with --dimension 2 give --only without it");
  if (options.local_repartition == "on")
    throw command_line_error(
        "--alone: which interfaces --local-repartition moves is decided by the whole mesh; "
        "leave it out");
}

/// Ranks that each have to be there for themselves.
bool needs_each_rank(const mesh_options& options) {
  return options.executor == "serial" ||
         (!options.rank_partitioner.empty() && options.rank_partitioner != rank_partitioner_names().front());
}

void check_rank_group(const mesh_options& options) {
  if (!options.rank_group)
    return;
  if (*options.rank_group < 0)
    throw command_line_error("--rank-group: " + std::to_string(*options.rank_group) + " is negative");
  if (*options.rank_group != 1 && needs_each_rank(options))
    throw command_line_error(
        "--rank-group: with --executor serial, or a library for --rank-partitioner, each rank computes by "
        "itself; leave it out");
}

} // namespace

int largest_rank_group(const mesh_options& options) {
  return options.rank_group ? std::max(0, *options.rank_group) : needs_each_rank(options) ? 1 : 0;
}

int workers_of_rank(const mesh_options& options) {
  const int of_each = std::max(1, options.workers);
  const int ranks = std::max(1, static_cast<int>(options.group.size()));
  return std::min(of_each * ranks, std::max(of_each, parallel::available_processors()));
}

template <int D>
policies_of<D> make_policies_of(const mesh_options& options) {
  check_decomposition(options, D);
  auto background_mesher = make_background_mesher(options.background_mesher);
  if (D == 2 && background_mesher)
    throw command_line_error(
        "--background-mesher: with --dimension 2 there is no volume to mesh; use native");
  if (D == 2 && !options.segment_matching.empty())
    throw command_line_error("--segment-matching: with --dimension 2 there are no faces to match it to");
  if (D == 2 && !options.background_improver.empty())
    throw command_line_error("--background-improver: with --dimension 2 there is no volume to improve");
  auto mesher = make_mesher<D>(options.mesher);
  if (options.executor == "threads")
    mesher = mesher.for_threads();
  check_rank_group(options);
  const bool on_ranks = options.network && options.workers >= 0;
  auto executor = make_executor(options.executor, on_ranks ? workers_of_rank(options) : options.workers,
                                mesher.name(), mesher.actual_traits(), options.network);
  auto surface_mesher = make_surface_mesher(options.surface_mesher);
  if (D == 2 && !options.surface_mesher.empty())
    throw command_line_error("--surface-mesher: with --dimension 2 the mesher of triangles is --mesher");
  return {std::move(mesher),
          make_partitioner(options.partitioner),
          make_improver<D>(options.improver),
          std::move(executor),
          std::move(background_mesher),
          make_simplifier(options.simplifier, options.dihedral_angle, D),
          std::move(surface_mesher),
          make_background_improver(options.background_improver)};
}

template policies_of<2> make_policies_of<2>(const mesh_options&);
template policies_of<3> make_policies_of<3>(const mesh_options&);

void choose_as_paper(mesh_options& options) {
  if (!options.paper)
    return;
  const auto choose = [](std::string& choice, const char* name) {
    if (choice.empty())
      choice = name;
  };
  choose(options.partitioner, "metis");
  choose(options.simplifier, "paper");
  choose(options.weights, "equal");
  choose(options.super_element_bound, "off");
  choose(options.local_repartition, "off");
  if (options.dimension == 2)
    return;
  choose(options.segment_matching, "off");
  choose(options.background_improver, "none");
}

void choose_for_alone(mesh_options& options) {
  if (options.alone && options.local_repartition.empty())
    options.local_repartition = "off";
}

generate_options make_generate_options(const mesh_options& options) {
  constexpr double most_by_default = 2e6; // elements, where nothing says how large they are
  generate_options result;
  if (options.model.has_automatic_sizes() && !options.model.size && !options.model.elements)
    result.enlarged_above = most_by_default;
  if (const auto& elements = options.model.elements; elements && !(*elements > 0 && std::isfinite(*elements)))
    throw command_line_error("--elements: " + number_text(*elements) + " is not a number of elements");
  if (options.subdomains) {
    if (*options.subdomains < 1)
      throw command_line_error("--subdomains: " + std::to_string(*options.subdomains) +
                               " is not a number of pieces");
    result.subdomains = *options.subdomains;
  }
  result.only = subdomains_in(options.only);
  check_alone(options);
  result.alone = options.alone;
  if (!result.only.empty() && options.ranks)
    throw command_line_error("--only: --ranks divides whole meshes; leave one of them out");
  if (!result.only.empty() && options.order == 2)
    throw command_line_error(
        "--only: where middles of edges are depends on the other pieces; leave --order 2 out");
  if (!result.only.empty() && !options.trace.empty())
    throw command_line_error(
        "--only: the trace of some pieces tells nothing about whole meshes; leave --trace out");
  // Up to here one process meshes six CAD models sooner than it decomposes them.
  constexpr double sooner_undivided = 650'000;
  if (leaves_decomposition_open(options))
    result.undivided_elements = sooner_undivided;
  if (options.ranks && options.redistribute != by_elements)
    result.least_subdomains = *options.ranks; // none of them is left without a piece
  if (options.coarsening) {
    if (!(*options.coarsening >= 1) || !std::isfinite(*options.coarsening))
      throw command_line_error("--coarsening: " + number_text(*options.coarsening) + " is not 1 or more");
    result.coarse_scale = *options.coarsening;
  }
  if (options.super_element_bound == "off")
    result.super_elements.fraction = std::numeric_limits<double>::infinity();
  if (options.paper)
    result.partitioned_at_once = std::numeric_limits<local_id>::max();
  result.predicted_weights = options.weights != "equal";
  result.match_segments = options.segment_matching != "off";
  result.repartition_locally = options.local_repartition != "off";
  return result;
}

} // namespace dovetail::app
