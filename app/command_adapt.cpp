#include "commands.hpp"
#include "failure.hpp"
#include "mesh_files.hpp"
#include "model_source.hpp"
#include "output.hpp"
#include "pipeline.hpp"
#include "quality_change.hpp"
#include "run_figures.hpp"
#include "run_setup.hpp"
#include "stage_figures.hpp"
#include "stop_request.hpp"
#include "terminal_progress.hpp"

#include "dovetail/io/read_mesh.hpp"
#include "dovetail/io/zlib.hpp"
#include "dovetail/mesh/quality.hpp"
#include "dovetail/pipeline/adapt.hpp"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::app {
namespace {

/// The mesh is held in memory: more elements than this are a mistake in the sizes.
constexpr double most_adapted_elements = 2e8;

/// The values that are the sizes; where there are none of that name, the error tells which names there are.
std::vector<double> sizes_of(const io::loaded_mesh& mesh, const adapt_options& options) {
  if (const auto* values = mesh.scalars(options.sizes))
    return *values;
  std::string there;
  for (const auto& array : mesh.point_scalars)
    there += (there.empty() ? "'" : ", '") + array.name + "'";
  throw sizing_error(options.input + ": there are no values '" + options.sizes +
                     "' at points in this mesh; " +
                     (there.empty() ? "there are no values at all" : "there are " + there));
}

template <int D>
adaptable_mesh<D> adaptable(io::loaded_mesh& loaded) {
  if constexpr (D == 3)
    return {std::move(loaded.mesh), std::move(loaded.triangles), std::move(loaded.triangle_tags)};
  else
    return {{std::move(loaded.mesh.points), std::move(loaded.triangles), std::move(loaded.triangle_tags)}};
}

/// The adapted mesh with the names of the old one. Sides without ids are not in it.
template <int D>
io::loaded_mesh named(adaptable_mesh<D> made, const io::loaded_mesh& old) {
  io::loaded_mesh whole;
  whole.material_names = old.material_names;
  whole.triangle_names = old.triangle_names;
  if constexpr (D == 3) {
    whole.mesh = std::move(made.mesh);
    whole.subdomains = std::move(made.subdomains);
    for (std::size_t s = 0; s < made.sides.size(); ++s)
      if (made.side_ids[s] != no_id) {
        whole.triangles.push_back(made.sides[s]);
        whole.triangle_tags.push_back(made.side_ids[s]);
      }
  } else {
    whole.mesh.points = std::move(made.mesh.points);
    whole.triangles = std::move(made.mesh.elements);
    whole.triangle_tags = std::move(made.mesh.tags);
  }
  return whole;
}

template <int D>
class adapt_run {
public:
  adapt_run(const adapt_options& options, const given_sizes& sizes)
      : options_(options), sizes_(sizes), policies_(make_policies_of<D>(options.run)),
        parameters_(make_generate_options(options.run)) {}

  int run(io::loaded_mesh loaded) {
    const stopwatch clock;
    std::vector<double> at_points;
    if (!options_.sizes.empty())
      at_points = sizes_of(loaded, options_);
    const auto old = adaptable<D>(loaded);
    std::optional<terminal_progress> lines;
    if (!options_.quiet)
      lines.emplace(stderr);
    if (lines)
      parameters_.on_progress = lines->callbacks();
    else
      parameters_.on_progress.stop_requested = stop_was_requested;
    parameters_.largest_prediction = most_adapted_elements;

    const auto made = adapted_mesh(old, std::move(at_points));
    if (!made.failures.empty())
      throw mesher_error(text_of_failures(made.failures));
    const quality_statistics before = measure_quality(old.mesh);
    const io::loaded_mesh whole = named<D>(whole_mesh(made), loaded);
    write_mesh_file(whole, options_.out);
    lines.reset();
    if (!options_.report.empty())
      write_quality_report(made.quality, D, static_cast<std::int64_t>(whole.mesh.points.size()), made.summary,
                           options_.report);
    if (!options_.quiet)
      print_change(D, before, made.quality, clock.seconds());
    std::vector<std::string> warnings;
    collect_warnings(made.summary, warnings);
    for (const auto& warning : warnings)
      std::fprintf(stderr, "warning: %s\n", warning.c_str());
    return exit_ok;
  }

private:
  adapted<D> adapted_mesh(const adaptable_mesh<D>& old, std::vector<double> at_points) const {
    const auto given = composed(policies_, parameters_);
    if (options_.sizes.empty()) {
      auto boundary = model_of_boundary(old, options_.how.feature_angle_deg);
      const any_sizing size = sizes_.field(boundary.model.bounds(), &boundary.model);
      return mesh_again<D>(std::move(boundary), erased_sizing(size), given);
    }
    try {
      return adapt<D>(old, at_points, given, options_.how);
    } catch (const sizing_error& problem) {
      throw sizing_error(options_.input + ": the values '" + options_.sizes + "': " + problem.what());
    }
  }

  const adapt_options& options_;
  const given_sizes& sizes_;
  policies_of<D> policies_;
  generate_options parameters_;
};

} // namespace

int run_adapt(const adapt_options& options) {
  if (options.sizes.empty() && options.sizing.empty() && !options.size)
    throw command_line_error("give sizes: --sizes, --size or --sizing");
  const given_sizes sizes(options.sizing, options.size);
  check_can_write(options.out);
  if (!options.report.empty())
    check_can_create(options.report);
  io::loaded_mesh loaded = io::read_mesh(options.input, io::zlib_expand);
  warn_of_part(loaded, options.input);
  try {
    return is_of_triangles(loaded) ? adapt_run<2>(options, sizes).run(std::move(loaded))
                                   : adapt_run<3>(options, sizes).run(std::move(loaded));
  } catch (const mesh_error& problem) {
    throw mesh_error(options.input + ": " + problem.what());
  }
}

} // namespace dovetail::app
