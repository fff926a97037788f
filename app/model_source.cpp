#include "model_source.hpp"

#include "failure.hpp"
#include "policies.hpp"

#include "dovetail/geometry/builtin_models.hpp"
#include "dovetail/geometry/discrete_model.hpp"
#include "dovetail/geometry/occt_model.hpp"
#include "dovetail/geometry/plane_domain.hpp"
#include "dovetail/geometry/plane_read.hpp"
#include "dovetail/io/read_mesh.hpp"
#include "dovetail/sizing/automatic.hpp"
#include "dovetail/sizing/json.hpp"
#include "dovetail/sizing/sources.hpp"
#include "dovetail/sizing/uniform.hpp"

#include <cmath>
#include <filesystem>
#include <utility>

namespace dovetail::app {
namespace {

constexpr double default_elements_across = 25; ///< of a model's diagonal

/// A size that is no use for a model is refused here, where the option's name is known.
double checked_size(double size, const box3& domain) {
  if (!(size > 0) || !std::isfinite(size))
    throw sizing_error("--size: " + std::to_string(size) + " is not a length; give a positive number");
  if (size > domain.diagonal())
    throw sizing_error("--size: " + std::to_string(size) + " is larger than the model, whose diagonal is " +
                       std::to_string(domain.diagonal()));
  return size;
}

/// The built-in model's own sizes; a size given scales all of them.
model_source builtin_source(const model_options& options) {
  const std::string name = options.model.empty() ? builtin_model_names().front() : options.model;
  auto built = builtin_model(name);
  any_geometry geometry(std::move(built.model));
  const box3 domain = geometry.bounds();
  any_sizing size;
  if (!options.sizing.empty()) {
    size = load_sizing(options.sizing, {}, domain, &geometry);
  } else {
    const double ambient = options.size ? checked_size(*options.size, domain) : built.size;
    for (auto& source : built.sources)
      for (auto& spacing : source.spacing)
        spacing *= ambient / built.size;
    size = keep_bounds(source_field(ambient, std::move(built.sources)));
  }
  return {name, std::move(geometry), std::move(size), std::move(built.report)};
}

model_source file_source(const model_options& options, int dimension) {
  const std::filesystem::path file = options.input;
  const auto with_sizing = [&](any_geometry geometry, report summary) {
    const box3 domain = geometry.bounds();
    any_sizing size = load_sizing(options.sizing, options.size, domain, &geometry);
    if (!size)
      size = keep_bounds(uniform_size(domain.diagonal() / default_elements_across));
    return model_source{file.filename().string(), std::move(geometry), std::move(size), std::move(summary)};
  };
  if (file.extension() == ".svg")
    return with_sizing(any_geometry(plane_domain(read_svg(file))), {});
  if (file.extension() == ".txt")
    return with_sizing(any_geometry(plane_domain(read_polygons(file))), {});
  if (!triangle_format_of(file).empty())
    return with_sizing(any_geometry(read_discrete_model(file)), {});
  const auto unit = options.unit == "mm" ? occt::length_unit::millimetre : occt::length_unit::file;
  const auto entities = dimension == 2 ? occt::wanted::faces : occt::wanted::solids;
  auto read = read_occt_model(file, {.unit = unit, .entities = entities});
  return with_sizing(any_geometry(std::move(read.model)), std::move(read.report));
}

background_field load_background(const std::filesystem::path& file, const std::string& array) {
  io::loaded_mesh loaded = io::read_mesh(file);
  const auto* sizes = loaded.scalars(array);
  if (!sizes)
    throw sizing_error(file.string() + ": there is no point array '" + array + "' in this mesh");
  return background_field(std::move(loaded.mesh), *sizes);
}

} // namespace

model_source load_model(const model_options& options, int dimension) {
  if (!options.input.empty() && !options.model.empty())
    throw command_line_error("give a file or --model, not both");
  return options.input.empty() ? builtin_source(options) : file_source(options, dimension);
}

any_sizing load_sizing(const std::string& file, const std::optional<double>& size, const box3& domain,
                       const any_geometry* model) {
  if (!file.empty()) {
    sizing::json_options options{.domain = domain, .load_background = load_background};
    if (model)
      options.size_from_model = [model](const automatic_options& o) { return automatic_size(*model, o); };
    return keep_bounds(sizing::read_sizing(file, options));
  }
  if (size)
    return keep_bounds(uniform_size(checked_size(*size, domain)));
  return {};
}

} // namespace dovetail::app
