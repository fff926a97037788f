#include "commands.hpp"
#include "failure.hpp"
#include "mesh_files.hpp"
#include "model_source.hpp"
#include "policies.hpp"
#include "run_figures.hpp"
#include "stage_figures.hpp"
#include "stop_request.hpp"
#include "surface_file.hpp"
#include "terminal_progress.hpp"

#include "dovetail/core/number_text.hpp"
#include "dovetail/improver/any_improver.hpp"
#include "dovetail/mesher/any_mesher.hpp"
#include "dovetail/models/discrete/text_scanner.hpp"
#include "dovetail/pipeline/fill.hpp"

#include <algorithm>
#include <cstdio>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::app {
namespace {

/// "x,y,z"
vec3 point_of_text(const std::string& text, const char* option) {
  std::string words = text;
  std::replace(words.begin(), words.end(), ',', ' ');
  try {
    discrete::text_scanner scanner(words, option);
    if (scanner.next_line()) {
      const vec3 point = scanner.point();
      if (scanner.at_line_end())
        return point;
    }
  } catch (const input_error&) {
  }
  throw command_line_error(std::string(option) + ": '" + text + "' is not a point; give x,y,z");
}

dovetail::fill_options how_to_fill(const filling_options& options) {
  dovetail::fill_options how;
  if (options.growth) {
    how.growth = *options.growth;
    if (!(how.growth >= 1e-3 && how.growth <= 1000))
      throw command_line_error("--growth: " + number_text(how.growth) +
                               " is not a growth; give a number from 0.001 to 1000");
  }
  for (const std::string& text : options.voids)
    how.marks.push_back({point_of_text(text, "--void"), no_id});
  return how;
}

/// A material gets the name of the triangles that have it behind them, where these have one and no other
/// material has it.
void name_materials(const surface_file& given, const filled_surface& made, io::loaded_mesh& whole) {
  struct group_behind {
    local_id tag;
    bool is_one;
  };
  std::map<local_id, group_behind> groups; // of triangles, by material
  for (std::size_t t = 0; t < made.materials_beside.size(); ++t)
    if (const local_id material = made.materials_beside[t][0]; material != no_id) {
      const local_id tag = given.surface.tags[t];
      group_behind& group = groups.try_emplace(material, group_behind{tag, true}).first->second;
      group.is_one = group.is_one && group.tag == tag;
    }
  const std::map<local_id, std::string> names(given.names.begin(), given.names.end());
  std::map<std::string, int> uses;
  for (const auto& [material, group] : groups)
    if (const auto named = names.find(group.tag); group.is_one && named != names.end()) {
      whole.material_names.emplace_back(material, named->second);
      ++uses[named->second];
    }
  std::erase_if(whole.material_names, [&](const auto& named) { return uses[named.second] > 1; });
}

io::loaded_mesh surface_with_inside(surface_file given, filled_surface made) {
  io::loaded_mesh whole;
  name_materials(given, made, whole);
  whole.mesh = std::move(made.mesh);
  whole.triangles = std::move(given.surface.elements);
  whole.triangle_tags = std::move(given.surface.tags);
  whole.triangle_names = std::move(given.names);
  return whole;
}

void print_filled(const filling_options& options, const filled_surface& made) {
  const auto row = [](const char* label, double value, const char* format = "%.0f") {
    char text[40];
    std::snprintf(text, sizeof text, format, value);
    std::printf("  %-40s %14s\n", label, text);
  };
  double volume = 0;
  for (const filled_region& region : made.regions)
    volume += region.volume;
  std::printf("Filled %s\n", options.input.c_str());
  const auto counts = made.summary.as<fill_counts>();
  row("No. of triangles, each one kept", static_cast<double>(counts.triangles));
  row("No. of regions", static_cast<double>(counts.regions));
  row("No. of voids", static_cast<double>(counts.voids));
  row("Volume", volume, "%.6g");
  row("No. of tetrahedra", static_cast<double>(made.quality.elements));
  row("No. of vertices", static_cast<double>(counts.points));
  row("Minimum dihedral angle (degrees)", made.quality.min_dihedral_deg, "%.3f");
  row("Maximum dihedral angle (degrees)", made.quality.max_dihedral_deg, "%.3f");
  row("Bad (under 12) per million", made.quality.per_million_under(limits_of(3).bad), "%.1f");
  row("Low (under 24) per million", made.quality.per_million_under(limits_of(3).low), "%.1f");
  row("Seconds", made.summary.seconds, "%.2f");
}

/// Where a hundredth of the elements or more are bad.
void warn_of_many_bad(const quality_statistics& quality, std::vector<std::string>& warnings) {
  constexpr double many = 1e4; // per million
  const double bad = quality.per_million_under(limits_of(3).bad);
  if (bad >= many)
    warnings.push_back(number_text(bad / 1e4, 2) + " % of the tetrahedra are under " +
                       std::to_string(limits_of(3).bad) +
                       " degrees, as where the surface has needles, or triangles larger than it is thick");
}

filled_surface fill_file(const surface_file& given, const filling_options& options, const given_sizes& sizes,
                         dovetail::fill_options how, const any_mesher<3>& mesh_it,
                         const any_improver<3>& improve) {
  std::optional<terminal_progress> lines;
  if (!options.quiet)
    lines.emplace(stderr);
  if (lines)
    how.on_progress = lines->callbacks();
  else
    how.on_progress.stop_requested = stop_was_requested;
  box3 box;
  for (const vec3 p : given.surface.points)
    box.include(p);
  const any_sizing size = sizes.field(box);
  return size ? fill(given.surface, size, how, mesh_it, improve) : fill(given.surface, how, mesh_it, improve);
}

} // namespace

int run_fill(const filling_options& options) {
  const given_sizes sizes(options.sizing, options.size);
  check_can_write(options.out);
  dovetail::fill_options how = how_to_fill(options);
  const auto mesh_it = make_mesher<3>(options.mesher);
  const auto improve = make_improver<3>(options.improver);
  how.run_regions = make_executor("", options.workers, mesh_it.name(), mesh_it.actual_traits());
  surface_file given = read_surface_file(options.input);
  std::vector<std::string> warnings = given.warnings;
  filled_surface made = [&] {
    try {
      return fill_file(given, options, sizes, how, mesh_it, improve);
    } catch (const geometry_error& problem) {
      throw geometry_error(options.input + ": " + problem.what());
    } catch (const mesher_error& problem) {
      throw mesher_error(options.input + ": " + problem.what());
    }
  }();
  const filled_surface figures{.mesh = {},
                               .materials_beside = {},
                               .regions = made.regions,
                               .quality = made.quality,
                               .summary = made.summary};
  collect_warnings(made.summary, warnings);
  warn_of_many_bad(made.quality, warnings);
  const io::loaded_mesh whole = surface_with_inside(std::move(given), std::move(made));
  write_mesh_file(whole, options.out);
  if (!options.report.empty())
    write_quality_report(figures.quality, 3, static_cast<std::int64_t>(whole.mesh.points.size()),
                         figures.summary, options.report);
  if (!options.quiet)
    print_filled(options, figures);
  for (const auto& warning : warnings)
    std::fprintf(stderr, "warning: %s\n", warning.c_str());
  return exit_ok;
}

} // namespace dovetail::app
