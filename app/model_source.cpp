#include "model_source.hpp"

#include "failure.hpp"
#include "file_checksums.hpp"
#include "named_policies.hpp"
#include "policies.hpp"
#include "supervision.hpp"

#include "dovetail/core/hash.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/experiments/builtin_models.hpp"
#include "dovetail/files/read_mesh.hpp"
#include "dovetail/files/sizing_json.hpp"
#include "dovetail/files/zlib.hpp"
#include "dovetail/models/discrete/read.hpp"
#include "dovetail/models/discrete_model.hpp"
#include "dovetail/models/occt_model.hpp"
#include "dovetail/models/plane/read.hpp"
#include "dovetail/models/plane_domain.hpp"
#include "dovetail/parallel/map_tasks.hpp"
#include "dovetail/parallel/task_model.hpp"
#include "dovetail/sizing/automatic.hpp"
#include "dovetail/sizing/sources.hpp"
#include "dovetail/sizing/uniform.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <new>
#include <optional>
#include <span>
#include <utility>

namespace dovetail::app {
namespace {

constexpr double default_elements_across = 25; ///< of a plane domain's diagonal
constexpr double most_elements_across = 1e9;   ///< beyond, coordinates have too few digits

std::string ending_of(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  for (char& c : ending)
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending;
}

bool is_drawing(const std::filesystem::path& file) {
  const std::string ending = ending_of(file);
  return ending == ".svg" || ending == ".txt";
}

/// A model with what reading and healing report, and what tells its volume.
struct read_geometry {
  any_geometry geometry;
  report summary;
  std::function<std::optional<double>()> volume;
  bool joined = false; ///< whether there were faces to join
};

/// A plane domain is no model for tetrahedra; what is wrong with its paths is said with the file's name.
any_geometry plane_geometry(const std::filesystem::path& file, int dimension) {
  if (dimension != 2)
    throw command_line_error(file.string() + ": a plane domain is meshed with triangles; give --dimension 2");
  const plane_drawing drawing = ending_of(file) == ".svg" ? read_svg(file) : read_polygons(file);
  try {
    return any_geometry(plane_domain(drawing));
  } catch (const geometry_error& problem) {
    throw geometry_error(file.string() + ": " + problem.what());
  }
}

/// Triangles may be meshed with triangles even where they enclose nothing.
read_geometry triangle_geometry(const std::filesystem::path& file, int dimension) {
  const discrete_model model = read_discrete_model(file, {.allow_sheets = dimension == 2});
  return {any_geometry(model), model.repairs(), [model] { return model.volume(); }};
}

read_geometry cad_geometry(const std::filesystem::path& file, const model_options& options, int dimension) {
  std::error_code unknown;
  const auto bytes = std::filesystem::file_size(file, unknown);
  const double megabytes = unknown ? 0 : 1e-6 * static_cast<double>(bytes);
  std::optional<spare_process> spare;
  if (std::filesystem::is_regular_file(file, unknown)) // a pipe can be read once
    spare.emplace();
  const risky_step reading(file.string() + (options.join
                                                ? ": reading with Open CASCADE, and joining faces that touch,"
                                                : ": reading and healing with Open CASCADE"),
                           options.joined_for_crossing
                               ? "its surfaces cross, separate them or let them share faces in the CAD system"
                               : "the file is damaged or beyond it; export it again, best as STEP",
                           60 + 40 * megabytes); // it needs about one second per megabyte
  const auto unit = options.unit == "mm" ? occt::length_unit::millimetre : occt::length_unit::file;
  const auto entities = dimension == 2 ? occt::wanted::faces : occt::wanted::solids;
  auto read = read_occt_model(file, {.unit = unit, .entities = entities, .join_within = options.join});
  if (options.join && !read.joined && !options.joined_for_crossing)
    read.report.warnings.push_back(
        "--join " + number_text(*options.join) +
        " changes nothing: no faces are so near to each other without sharing what they "
        "have in common, or they could not be joined");
  if (read.joined && options.joined_for_crossing)
    read.report.warnings.push_back((*options.join > 0 ? "surfaces cross, so faces nearer than " +
                                                            number_text(*options.join, 3) + " to each other"
                                                      : "surfaces cross where they touch, so faces that do") +
                                   " were made one there: see --join");
  return {any_geometry(read.model), std::move(read.report), [model = read.model] { return model.volume(); },
          read.joined};
}

read_geometry geometry_of_file(const std::filesystem::path& file, const model_options& options,
                               int dimension) {
  try {
    if (is_drawing(file))
      return {plane_geometry(file, dimension), {}, {}};
    if (!triangle_format_of(file).empty())
      return triangle_geometry(file, dimension);
    return cad_geometry(file, options, dimension);
  } catch (const std::bad_alloc&) {
    throw error(file.string() +
                ": out of memory while the model was read; allow more, if there is a limit to "
                "it (ulimit -v)");
  }
}

/// A loop over samples of a model, in ranges. A range that fails is done again here, which tells why.
struct divided_loop {
  const any_executor& run;

  template <class Work>
  auto operator()(const any_geometry& model, std::size_t count, const Work& work) const {
    constexpr std::size_t in_range = 2048;
    if (count <= in_range)
      return work(model, std::size_t{0}, count);
    const auto range_of = [&](std::size_t range, const any_geometry& own) {
      return work(own, in_range * range, std::min(count, in_range * (range + 1)));
    };
    auto results = map_tasks(run, (count + in_range - 1) / in_range,
                             [&](std::size_t range) {
                               const task_model own(model, run);
                               return range_of(range, own.get());
                             },
                             {.stage = "geometry"});
    decltype(range_of(0, model)) all;
    for (std::size_t range = 0; range < results.size(); ++range)
      append(all, results[range].value ? *std::move(results[range].value) : range_of(range, model));
    return all;
  }
};

/// The built-in model's own sizes; a size given scales all of them.
model_source builtin_source(const std::string& name, const given_sizes& sizes, const any_executor& run) {
  auto built = builtin_model(name);
  any_geometry geometry(built.model);
  const box3 domain = geometry.bounds();
  std::string meshes;
  any_sizing size;
  if (sizes.has_file() || sizes.is_automatic()) {
    size = sizes.field(domain, &geometry, &meshes, run);
  } else {
    const double ambient = sizes.length(domain).value_or(built.size);
    for (auto& source : built.sources)
      for (auto& spacing : source.spacing)
        spacing *= ambient / built.size;
    size = keep_bounds(source_field(ambient, std::move(built.sources)));
  }
  model_source source{name, std::move(geometry), std::move(size), std::move(built.report)};
  source.sizing_meshes = std::move(meshes);
  source.own_size = built.size;
  source.volume = [model = std::move(built.model)] { return model.volume(); };
  return source;
}

/// Of a pipe, which can be read once, nothing.
std::string checksum_if_file(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(path, ignored) ? checksum_of_file(path) : std::string();
}

model_source file_source(const model_options& options, const given_sizes& sizes, int dimension,
                         const any_executor& run) {
  const std::filesystem::path file = options.input;
  const std::string checksum = checksum_if_file(file);
  auto [geometry, summary, volume, joined] = geometry_of_file(file, options, dimension);
  if (checksum_if_file(file) != checksum)
    throw geometry_error(file.string() + ": the file was changed while it was read; run again");
  const box3 domain = geometry.bounds();
  if (!std::isfinite(domain.diagonal()))
    throw geometry_error(file.string() + ": the coordinates are too large to measure the model");
  std::string meshes;
  any_sizing size;
  std::optional<automatic_points> automatic;
  if (is_drawing(file) && sizes.is_automatic()) // there are no curved faces and no walls
    size = keep_bounds(uniform_size(domain.diagonal() / default_elements_across));
  else if (automatic = sizes.points(geometry, dimension == 3, run); automatic)
    size = keep_bounds(automatic->field(automatic->walls_within(0)));
  else
    size = sizes.field(domain, &geometry, &meshes, run);
  model_source source{file.filename().string(), std::move(geometry), std::move(size), std::move(summary)};
  if (automatic && automatic->has_thin_walls())
    source.thin_walls = std::move(automatic);
  source.file = checksum;
  source.volume = std::move(volume);
  source.sizing_meshes = std::move(meshes);
  return source;
}

/// `read` takes in what is read.
background_field load_background(const std::filesystem::path& file, const std::string& array,
                                 content_hash& read) {
  io::loaded_mesh loaded = io::read_mesh(file, io::zlib_expand);
  const auto* sizes = loaded.scalars(array);
  if (!sizes)
    throw sizing_error(file.string() + ": there is no point array '" + array + "' in this mesh");
  read.bytes(std::as_bytes(std::span(loaded.mesh.points)));
  read.bytes(std::as_bytes(std::span(loaded.mesh.elements)));
  read.bytes(std::as_bytes(std::span(*sizes)));
  return background_field(std::move(loaded.mesh), *sizes);
}

bool is_builtin(const std::string& name) {
  const auto names = builtin_model_names();
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool is_there(const std::string& file) {
  std::error_code missing;
  return std::filesystem::exists(file, missing);
}

} // namespace

given_sizes::given_sizes(std::string file, const std::optional<double>& size)
    : file_(std::move(file)), size_(size) {
  if (size_ && (!(*size_ > 0) || !std::isfinite(*size_)))
    throw command_line_error("--size: " + number_text(*size_) + " is not a length; give a positive number");
  if (file_.empty())
    return;
  text_ = sizing::read_sizing_text(file_);
  sizing::parse_sizing(text_, file_, {.only_check = true});
}

given_sizes::given_sizes(const model_options& options) : given_sizes(options.sizing, options.size) {
  const auto in_range = [](const char* option, const std::optional<double>& value, double least) {
    if (value && !(*value >= least && *value <= 1000))
      throw command_line_error(
          std::string(option) + ": " + number_text(*value) + " is not " +
          (least > 0 ? "a growth; give a positive number" : "a number of elements; give one from 0 to 1000"));
  };
  in_range("--curvature", options.curvature, 0);
  in_range("--proximity", options.proximity, 0);
  in_range("--growth", options.growth, 1e-3);
  if (!options.has_automatic_sizes())
    return;
  automatic_.emplace();
  automatic_->elements_per_circle = options.curvature.value_or(automatic_->elements_per_circle);
  automatic_->elements_across = options.proximity.value_or(automatic_->elements_across);
  automatic_->range.growth = options.growth.value_or(automatic_->range.growth);
}

std::optional<double> given_sizes::length(const box3& domain) const {
  if (!size_)
    return {};
  const std::string given = "--size: " + number_text(*size_);
  if (*size_ > domain.diagonal())
    throw sizing_error(given + " is larger than the model, whose diagonal is " +
                       number_text(domain.diagonal()));
  if (*size_ < domain.diagonal() / most_elements_across)
    throw sizing_error(given + " is less than a billionth of the model's diagonal, " +
                       number_text(domain.diagonal()));
  return size_;
}

any_sizing given_sizes::field(const box3& domain, const any_geometry* model, std::string* meshes,
                              const any_executor& run) const {
  const auto uniform = length(domain);
  if (automatic_ && model)
    return keep_bounds(points(*model, false, run)->field());
  if (!has_file())
    return uniform ? keep_bounds(uniform_size(*uniform)) : any_sizing{};
  content_hash read;
  const std::uint64_t nothing = read.value();
  sizing::json_options options{.domain = domain};
  options.load_background = [&](const auto& mesh, const auto& array) {
    return load_background(mesh, array, read);
  };
  if (model)
    options.size_from_model = [model, &run](const automatic_options& o) {
      return automatic_points(*model, o, divided_loop{run}).field();
    };
  any_sizing sizes =
      keep_bounds(sizing::parse_sizing(text_, file_, options, std::filesystem::path(file_).parent_path()));
  if (meshes && read.value() != nothing)
    *meshes = hexadecimal(read.value());
  return sizes;
}

std::optional<automatic_points> given_sizes::points(const any_geometry& model, bool in_thin_walls,
                                                    const any_executor& run) const {
  if (!automatic_)
    return {};
  const double diagonal = model.bounds().diagonal();
  automatic_options options = *automatic_;
  options.range.largest = length(model.bounds()).value_or(0);
  if (!size_) { // a default is for any file: details far smaller than the model are not followed
    options.range.smallest = diagonal / 250;
    options.least_in_walls = in_thin_walls ? diagonal / most_sizes_across : 0;
  }
  return automatic_points(model, options, divided_loop{run});
}

bool may_be_read_again(const std::string& file) {
  std::error_code unknown;
  return std::filesystem::is_regular_file(file, unknown) && !is_drawing(file) &&
         triangle_format_of(file).empty();
}

bool has_faces_to_join(const model_options& options, int dimension) {
  return geometry_of_file(options.input, options, dimension).joined;
}

any_geometry load_geometry(const std::string& file_or_name, const std::string& unit, int dimension,
                           const std::optional<double>& join) {
  if (!is_there(file_or_name)) {
    if (is_builtin(file_or_name))
      return any_geometry(builtin_model(file_or_name).model);
    throw input_error(file_or_name + ": there is no such file, and no built-in model of that name");
  }
  model_options options;
  options.input = file_or_name;
  options.unit = unit;
  options.join = join;
  return geometry_of_file(file_or_name, options, dimension).geometry;
}

model_source load_model(const model_options& options, int dimension, const any_executor& run) {
  if (!options.input.empty() && !options.model.empty())
    throw command_line_error("give a file or --model, not both");
  if (is_builtin(options.input) && !is_there(options.input))
    throw input_error(options.input + ": there is no such file; --model " + options.input +
                      " is the built-in model of that name");
  if (is_drawing(options.input) && (options.curvature || options.proximity || options.growth))
    throw command_line_error("--curvature, --proximity, --growth: " + options.input +
                             " is a plane domain, without curved faces and walls; give --size or --sizing");
  if (options.join && (!(*options.join >= 0) || !std::isfinite(*options.join)))
    throw command_line_error("--join: " + number_text(*options.join) +
                             " is not a length; give a positive number or 0");
  if (options.join && !options.input.empty() && is_there(options.input) && !may_be_read_again(options.input))
    throw command_line_error("--join: " + options.input + " is no CAD file; its faces are joined already");
  if (options.join && options.input.empty())
    throw command_line_error("--join: a built-in model has no faces to join");
  const given_sizes sizes(options);
  model_source source =
      options.input.empty()
          ? builtin_source(chosen_name(builtin_model_names(), options.model, "--model"), sizes, run)
          : file_source(options, sizes, dimension, run);
  if (sizes.has_file())
    source.sizing = checksum_of_text(sizes.text());
  return source;
}

} // namespace dovetail::app
