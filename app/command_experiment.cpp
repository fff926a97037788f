#include "child_program.hpp"
#include "command_text.hpp"
#include "commands.hpp"
#include "experiment_plot_script.hpp" // experiment_plot.py as a string
#include "experiment_results.hpp"
#include "experiment_runs.hpp"
#include "failure.hpp"
#include "named_policies.hpp"
#include "output.hpp"

#include "dovetail/adapters/metis.hpp"
#include "dovetail/core/output_file.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/core/version.hpp"

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace dovetail::app {
namespace {

constexpr const char* every_experiment = "all";

std::vector<const experiment*> chosen_experiments(const std::vector<std::string>& names) {
  std::vector<const experiment*> chosen;
  for (const std::string& name : names)
    if (name != every_experiment && std::none_of(all_experiments().begin(), all_experiments().end(),
                                                 [&](const experiment& each) { return each.name == name; }))
      throw command_line_error("there is no experiment '" + name +
                               "'; there are: " + joined(experiment_names()));
  for (const experiment& each : all_experiments())
    if (std::any_of(names.begin(), names.end(),
                    [&](const std::string& name) { return name == each.name || name == every_experiment; }))
      chosen.push_back(&each);
  return chosen;
}

/// A command of this same program, which supervises itself.
int call_driver(const std::vector<std::string>& words, const std::string& errors) {
  std::vector<std::string> line{"/proc/self/exe"};
  line.insert(line.end(), words.begin(), words.end());
  return run_program(line, errors);
}

nlohmann::ordered_json origin_of(const experiment_options& options) {
  char date[32];
  const std::time_t now = std::time(nullptr);
  std::strftime(date, sizeof date, "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&now));
  return {{"command", options.command_line},
          {"dovetail", version},
          {"mesh_revision", mesh_revision},
          {"date", date},
          {"scale", options.scale},
          {"input", options.input},
          {"seeds", {{"metis", partition::metis{}.seed}}}};
}

/// Where a program's error message is.
std::string last_line_of(const std::filesystem::path& errors) {
  std::ifstream stream(errors);
  std::string last;
  for (std::string line; std::getline(stream, line);)
    last = line;
  return last.empty() ? "no word on why" : last;
}

/// The files of one experiment, and its Markdown.
std::string write_results(const experiment_result& result, const std::filesystem::path& folder) {
  const std::string& name = result.what->name;
  std::string text = markdown_text(result);
  output_batch files;
  files.open(folder / (name + ".md")).text(text);
  files.open(folder / (name + ".csv")).text(csv_text(result));
  files.open(folder / (name + ".json")).text(json_text(result));
  if (!result.what->plots.empty())
    files.open(folder / "experiment_plot.py").text(experiment_plot_script);
  files.commit();
  if (result.what->plots.empty())
    return text;
  const auto picture = folder / (name + ".png"), errors = folder / (name + ".png.errors");
  const std::vector<std::string> plot{"python3", folder / "experiment_plot.py", folder / (name + ".json"),
                                      picture};
  if (run_program(plot, errors) != exit_ok)
    std::fprintf(stderr, "%s is not made: %s; it is made by python3 with matplotlib: %s\n", picture.c_str(),
                 last_line_of(errors).c_str(), command_text(plot).c_str());
  std::filesystem::remove(errors);
  return text;
}

} // namespace

std::vector<std::string> experiment_names() {
  std::vector<std::string> names;
  for (const experiment& each : all_experiments())
    names.push_back(each.name);
  names.emplace_back(every_experiment);
  return names;
}

std::vector<std::string> names_of_experiment_files() {
  std::vector<std::string> files{"experiment_plot.py", "written_by_dovetail", "runs", "runs/*"};
  for (const experiment& each : all_experiments())
    for (const char* ending : {".md", ".csv", ".json", ".png", ".png.errors"})
      files.push_back(each.name + ending);
  return files;
}

int run_experiment(const experiment_options& options) {
  const auto chosen = chosen_experiments(options.names);
  run_maker maker(options, call_driver);
  const output_folder folder(options.out);
  std::vector<experiment_result> results;
  const stopwatch whole;
  const auto tell_seconds = [&](const std::string& what, double seconds) {
    if (!options.quiet)
      std::fprintf(stderr, "%s: %.1f s\n", what.c_str(), seconds);
  };
  try {
    for (const experiment* each : chosen) {
      const stopwatch clock;
      experiment_result& result = results.emplace_back(experiment_result{each, origin_of(options), {}});
      for (const experiment_run& run : each->runs)
        result.runs.push_back(maker.make(run));
      result.seconds = clock.seconds();
      std::fputs((write_results(result, folder.path()) + '\n').c_str(), stdout);
      tell_seconds(each->name, result.seconds);
    }
  } catch (const cancelled&) {
    complain(stopped_experiment_line(true));
    return exit_stopped;
  }
  if (chosen.size() > 1)
    tell_seconds("all " + std::to_string(chosen.size()) + " experiments", whole.seconds());
  const failure_summary failures = failures_of(results);
  if (!failures.text.empty())
    complain(failures.text);
  return failures.is_error ? exit_failure : exit_ok;
}

} // namespace dovetail::app
