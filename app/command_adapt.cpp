#include "any_mesh_file.hpp"
#include "carried_fields.hpp"
#include "commands.hpp"
#include "failure.hpp"
#include "finished_run.hpp"
#include "mesh_files.hpp"
#include "model_source.hpp"
#include "named_policies.hpp"
#include "pipeline.hpp"
#include "quality_change.hpp"
#include "run_figures.hpp"
#include "run_setup.hpp"
#include "stage_figures.hpp"
#include "stop_request.hpp"
#include "terminal_progress.hpp"

#include "dovetail/mesh/quality.hpp"
#include "dovetail/solver/adapt.hpp"

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

/// What is meshed again.
struct chosen_model {
  std::string file_or_name; ///< empty: the boundary of the mesh
  std::string unit = "mm";
  std::optional<double> join; ///< as when the mesh was made
  bool was_asked_for = false;
  std::string said; ///< of it, for the summary
  std::vector<std::string> warnings = {};

  void take_boundary() {
    file_or_name.clear();
    said = "on the boundary of the mesh; --model FILE takes the model that it is a mesh of";
  }
};

chosen_model model_for(const adapt_options& options) {
  chosen_model chosen;
  chosen.take_boundary();
  if (options.model == "none") {
    chosen.said = "on the boundary of the mesh";
  } else if (!options.model.empty()) {
    chosen = {options.model, options.unit, {}, true, "on the model " + options.model};
  } else if (const auto recorded = model_of_run_beside(options.input)) {
    const std::string of_run = ", which the run that made " + options.input + " names";
    if (recorded->file.empty())
      chosen = {recorded->name, "mm", {}, false, "on the built-in model " + recorded->name + of_run};
    else if (recorded->is_as_it_was)
      chosen = {recorded->file.string(), recorded->unit, recorded->joined, false,
                "on the model " + recorded->file.string() + of_run};
    else
      chosen.warnings.push_back(recorded->file.string() + of_run +
                                ", is not there or has changed since, so that it is not used; give --model");
  }
  return chosen;
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
    const mesh_fields fields = options_.fields ? fields_of(loaded, options_.input) : mesh_fields{};
    const auto old = adaptable<D>(loaded);
    std::optional<terminal_progress> lines;
    if (!options_.quiet)
      lines.emplace(stderr);
    if (lines)
      parameters_.on_progress = lines->callbacks();
    else
      parameters_.on_progress.stop_requested = stop_was_requested;
    parameters_.largest_prediction = most_adapted_elements;

    chosen_model model = model_for(options_);
    const auto made = adapted_mesh(old, at_points, model);
    if (!made.failures.empty())
      throw mesher_error(text_of_failures(made.failures));
    const quality_statistics before = measure_quality(old.mesh);
    auto next = whole_mesh(made);
    mesh_fields carried = carried_over<D>(fields, old.mesh, next.mesh);
    io::loaded_mesh whole = named<D>(std::move(next), loaded);
    whole.point_fields = std::move(carried.at_points);
    whole.element_fields = std::move(carried.in_elements);
    write_mesh_file(whole, options_.out);
    lines.reset();
    if (!options_.report.empty())
      write_quality_report(made.quality, D, static_cast<std::int64_t>(whole.mesh.points.size()), made.summary,
                           options_.report);
    if (!options_.quiet) {
      std::printf("Meshed again %s\n", model.said.c_str());
      print_change(D, before, made.quality, clock.seconds());
      print_size(made.summary.find("adaptation"));
      if (options_.fields)
        std::printf("Carried over: %s\n", in_words(fields).c_str());
    }
    std::vector<std::string> warnings = model.warnings;
    collect_warnings(made.summary, warnings);
    for (const auto& warning : warnings)
      std::fprintf(stderr, "warning: %s\n", warning.c_str());
    return exit_ok;
  }

private:
  static void print_size(const report& change) {
    const char* what = D == 3 ? "volume" : "area";
    std::printf("%s before %.6g, after %.6g\n", D == 3 ? "Volume" : "Area",
                change.get(std::string(what) + "_before"), change.get(std::string(what) + "_after"));
  }

  adapted<D> mesh_boundary_again(boundary_model<D> boundary, const adaptable_mesh<D>& old,
                                 const std::vector<double>& at_points) const {
    const auto given = composed(policies_, parameters_);
    if (options_.sizes.empty()) {
      const any_sizing size = sizes_.field(boundary.model.bounds(), &boundary.model);
      return mesh_again<D>(std::move(boundary), erased_sizing(size), given);
    }
    try {
      const auto size = sizes_at_points(old.mesh, at_points, options_.how.growth);
      return mesh_again<D>(std::move(boundary), size, given);
    } catch (const sizing_error& problem) {
      throw sizing_error(options_.input + ": the values '" + options_.sizes + "': " + problem.what());
    }
  }

  /// A model that nobody asked for, and that does not fit the mesh, is left.
  adapted<D> adapted_mesh(const adaptable_mesh<D>& old, const std::vector<double>& at_points,
                          chosen_model& model) const {
    if (!model.file_or_name.empty()) {
      auto boundary = model_of_mesh<D>(load_geometry(model.file_or_name, model.unit, D, model.join), old);
      try {
        return mesh_boundary_again(std::move(boundary), old, at_points);
      } catch (const mesh_error& problem) {
        if (model.was_asked_for)
          throw mesh_error(std::string(problem.what()) + " (--model none, or a mesh made with --keep-all)");
        model.warnings.push_back(model.file_or_name + " is not used: " + problem.what() +
                                 " (a mesh made with --keep-all has all details of its model)");
        model.take_boundary();
      }
    }
    return mesh_boundary_again(model_of_boundary(old, options_.how.feature_angle_deg), old, at_points);
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
  if (options.fields && !is_vtu(options.out))
    throw command_line_error("--fields: values are written to files with the extension .vtu, not to " +
                             options.out);
  io::loaded_mesh loaded =
      read_any_mesh(find_any_mesh(options.input), io::element_order::first, options.fields);
  warn_of_part(loaded, options.input);
  if (options.fields && !loaded.passed_over.empty())
    std::fprintf(stderr, "warning: %s: not carried over: %s\n", options.input.c_str(),
                 joined(loaded.passed_over).c_str());
  try {
    return is_of_triangles(loaded) ? adapt_run<2>(options, sizes).run(std::move(loaded))
                                   : adapt_run<3>(options, sizes).run(std::move(loaded));
  } catch (const mesh_error& problem) {
    throw mesh_error(options.input + ": " + problem.what());
  }
}

} // namespace dovetail::app
