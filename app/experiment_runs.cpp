#include "experiment_runs.hpp"

#include "command_text.hpp"
#include "compare_runs.hpp"
#include "failure.hpp"
#include "file_checksums.hpp"
#include "json_text.hpp"
#include "model_source.hpp"
#include "paper_figures.hpp"
#include "run_setup.hpp"
#include "sizes_for_elements.hpp"
#include "stop_request.hpp"

#include "dovetail/core/number_text.hpp"
#include "dovetail/core/output_file.hpp"
#include "dovetail/core/version.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string_view>

namespace dovetail::app {
namespace {

using json = nlohmann::ordered_json;

/// Null where there is no such file, discarded where it is no JSON.
json read_json(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return stream ? json::parse(stream, nullptr, false) : json();
}

void write_text(const std::string& text, const std::filesystem::path& path) {
  output_file file(path);
  file.text(text);
  file.commit();
}

/// What the driver said at last, by its error stream; empty where it said nothing.
std::string message_in(const std::filesystem::path& file) {
  constexpr std::string_view speaker = "dovetail: ";
  std::ifstream stream(file);
  std::string message;
  for (std::string line; std::getline(stream, line);)
    if (line.starts_with(speaker))
      message = line.substr(speaker.size());
  return message;
}

/// Sizes by curvature and walls, times a factor: what `--sizing` reads.
std::string automatic_sizes(double factor) {
  return text_of_json(json{{"automatic", true}, {"scale", factor}}) + '\n';
}

/// Names in what is read are as JSON can hold them.
bool is_same_text(const json& a, const json& b) {
  return text_of_json(a) == text_of_json(b);
}

/// Of a run that is not for a column of the paper; 0: as many as the driver chooses.
int subdomains_of(const experiment_run& run, double elements) {
  if (run.elements_per_subdomain == 0)
    return 0;
  return std::max(1, static_cast<int>(std::round(elements / run.elements_per_subdomain)));
}

} // namespace

run_maker::run_maker(const experiment_options& options, driver_call driver)
    : options_(options), driver_(std::move(driver)), build_(identity_of_build()) {
  if (!(options.scale > 0) || !std::isfinite(options.scale))
    throw command_line_error("--scale: " + number_text(options.scale) + " is not a positive number");
  mesh_options any;
  any.workers = options.workers;
  workers_ = make_policies_of<3>(any).executor.workers();
  if (!options.input.empty())
    input_checksum_ = checksum_of_file(options.input);
}

/// Sizes for so many elements are looked for once.
std::vector<std::string> run_maker::words_for_sizes(const experiment_run& run, double elements,
                                                    const std::filesystem::path& file, json& record) {
  const bool automatic = !options_.input.empty();
  const auto key = std::make_pair(run.model, elements);
  if (!sizes_.contains(key)) {
    mesh_options options;
    options.workers = options_.workers;
    options.model.input = options_.input;
    options.model.model = options_.input.empty() ? run.model : "";
    if (automatic) {
      write_text(automatic_sizes(1), file);
      options.model.sizing = file;
    }
    const model_source source = load_model(options.model);
    generate_options parameters = make_generate_options(options);
    parameters.enlarged_above = 0;
    parameters.undivided_elements = 0;
    parameters.on_progress.stop_requested = stop_was_requested;
    const double factor =
        scale_for_elements<3>(source, elements, make_policies_of<3>(options), parameters).factor;
    sizes_[key] = {factor, source.own_size.value_or(0)};
  }
  const auto [factor, own_size] = sizes_.at(key);
  if (automatic) {
    record["automatic_sizes_times"] = factor;
    write_text(automatic_sizes(factor), file);
    return {"--sizing", file};
  }
  record["size"] = factor * own_size;
  return {"--size", number_text(factor * own_size)};
}

struct run_maker::place_of_run {
  std::string name;
  std::filesystem::path folder;
  std::vector<std::string> what; ///< words of the command line that name the model
  std::vector<std::string> how;  ///< the others, but for sizes and files
  json asked;                    ///< what makes it the same run

  std::string file(const char* file_name) const { return (folder / file_name).string(); }
};

run_maker::place_of_run run_maker::place_of(const experiment_run& run, const wanted_run& wanted) const {
  const bool own = !options_.input.empty();
  place_of_run place;
  place.name = (own ? std::filesystem::path(options_.input).stem().string() : run.model) + "_" +
               number_text(std::round(wanted.elements), 12) + "_" +
               number_text(std::round(wanted.background), 12) + "_" + std::to_string(wanted.workers);
  for (const std::string& option : run.options)
    place.name.append("_").append(option, std::min(option.size(), option.find_first_not_of('-')));
  place.folder = std::filesystem::path(options_.out) / "runs" / place.name;
  place.what =
      own ? std::vector<std::string>{options_.input} : std::vector<std::string>{"--model", run.model};
  if (wanted.subdomains > 0)
    place.how = {"--subdomains", std::to_string(wanted.subdomains)};
  place.how.insert(place.how.end(),
                   {"--workers", std::to_string(std::min<std::int64_t>(wanted.workers, workers_))});
  if (run.has_background && wanted.coarsening > 1)
    place.how.insert(place.how.end(), {"--coarsening", number_text(wanted.coarsening)});
  place.how.insert(place.how.end(), run.options.begin(), run.options.end());
  place.asked = {{"model", place.what.back()}, {"input", input_checksum_}, {"elements", wanted.elements},
                 {"options", place.how},       {"version", version},       {"build", build_}};
  return place;
}

void run_maker::carry_out(const place_of_run& place, const wanted_run& wanted, run_result& result) {
  for (const char* name : {"run.json", "report.json", "trace.json", "errors.txt", "sizes.json"}) {
    std::error_code ignored;
    std::filesystem::remove(place.file(name), ignored);
  }
  make_folder(place.folder); // in which somebody else may have put something
  result.record = {{"asked", place.asked}};
  result.measured = json();
  std::vector<std::string> words{"mesh"};
  const auto add = [&](const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
    std::vector<std::string> line{"dovetail"};
    line.insert(line.end(), words.begin(), words.end());
    result.record["command"] = command_text(line);
  };
  add(place.what);
  try {
    add(words_for_sizes(*result.run, wanted.elements, place.file("sizes.json"), result.record));
  } catch (const cancelled&) {
    throw;
  } catch (const error& problem) {
    result.record["failure"] = problem.what();
    return;
  }
  add(place.how);
  add({"--format", "none"});
  // Files are nothing to whoever makes the mesh again.
  words.insert(words.end(), {"--out", place.file("mesh"), "--report", place.file("report.json"), "--trace",
                             place.file("trace.json"), "--quiet"});
  const std::string errors = place.file("errors.txt");
  const int code = driver_(words, errors);
  if (code == exit_stopped || stop_was_requested())
    throw cancelled();
  if (code != exit_ok) {
    const std::string message = message_in(errors);
    result.record["failure"] = message.empty() ? "exit code " + std::to_string(code) : message;
    return;
  }
  result.measured = read_json(place.file("report.json"));
  write_text(text_of_json(result.record, 2) + '\n', place.file("run.json"));
}

run_result run_maker::make(const experiment_run& run) {
  const wanted_run wanted =
      run.table.empty() ? wanted_run{.elements = run.elements / options_.scale,
                                     .workers = workers_,
                                     .subdomains = subdomains_of(run, run.elements / options_.scale)}
                        : run_for(paper_table(run.table).at("columns").at(run.column), options_.scale);
  if (constexpr double fewest = 100; wanted.elements < fewest)
    throw command_line_error("--scale: " + number_text(options_.scale) + " leaves " +
                             number_text(wanted.elements) + " elements of a mesh; give a smaller one");
  const place_of_run place = place_of(run, wanted);
  run_result result{.run = &run, .measured = read_json(place.file("report.json")), .name = place.name};
  result.record = read_json(place.file("run.json"));
  const bool is_there = result.record.is_object() &&
                        is_same_text(result.record.value("asked", json()), place.asked) &&
                        result.measured.is_object() && std::filesystem::exists(place.file("trace.json"));
  const auto failed_before = failed_.find(place.name);
  const bool is_known = failed_before != failed_.end();
  if (is_known) {
    result.record = failed_before->second;
    result.measured = json();
  } else if (!is_there) {
    carry_out(place, wanted, result);
  }
  const bool failed = result.measured.is_null();
  if (failed)
    failed_[place.name] = result.record;
  if (!options_.quiet)
    std::fprintf(stderr, "%s: %s\n", place.name.c_str(),
                 failed ? ((is_known ? "failed before: " : "failed: ") +
                           result.record.at("failure").get<std::string>())
                              .c_str()
                 : is_there ? "is there from before, by the same build and command line"
                            : "made");
  if (!failed && wanted.workers > workers_)
    result.simulated = simulated_report(result.measured, place.file("trace.json"), wanted.workers);
  for (const experiment_run& other : run.beside)
    add_beside(result, make(other));
  return result;
}

} // namespace dovetail::app
