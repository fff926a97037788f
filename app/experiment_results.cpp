#include "experiment_results.hpp"

#include "csv.hpp"
#include "json_text.hpp"
#include "paper_figures.hpp"
#include "terminal_progress.hpp"

#include "dovetail/core/number_text.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace dovetail::app {
namespace {

using json = nlohmann::ordered_json;

constexpr double not_measured = std::numeric_limits<double>::quiet_NaN();

double sum_of(const summed& pointers, const json& document) {
  double sum = 0;
  for (const std::string& text : pointers) {
    const json::json_pointer pointer(text);
    if (!document.contains(pointer) || document.at(pointer).is_null())
      return not_measured;
    sum += document.at(pointer).get<double>();
  }
  return sum;
}

/// Whether all that did not fail were made by as many workers, so that none is a speedup over another.
bool have_same_workers(const std::vector<run_result>& runs) {
  std::set<std::int64_t> numbers;
  for (const run_result& run : runs)
    if (!run.measured.is_null())
      numbers.insert(run.measured.at("workers").get<std::int64_t>());
  return numbers.size() < 2;
}

std::vector<double> over_first(std::vector<double> values) {
  const double first = values.empty() ? not_measured : values.front();
  for (double& value : values)
    value = first / value;
  return values;
}

bool is_of(const experiment_row& row, const experiment_run& run) {
  return row.only_of.empty() ||
         std::find(row.only_of.begin(), row.only_of.end(), run.label) != row.only_of.end();
}

std::string cell(double value, const experiment_row& row) {
  if (!std::isfinite(value))
    return "-";
  if (row.digits == as_count)
    return count_text(value);
  char text[40];
  std::snprintf(text, sizeof text, "%.*f", row.digits, value);
  return text;
}

/// The mean of those that are numbers, and half the length of its 95 % interval by Student's distribution;
/// NaN where they are too few.
std::pair<double, double> mean_and_margin(std::vector<double> values) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  constexpr double quantiles[] = {12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262};
  const std::size_t count = values.size();
  if (count == 0)
    return {not_measured, not_measured};
  const auto n = static_cast<double>(count);
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  if (count == 1)
    return {mean, not_measured};
  double squares = 0;
  for (const double value : values)
    squares += (value - mean) * (value - mean);
  const double quantile = quantiles[std::min(count - 2, std::size(quantiles) - 1)];
  return {mean, quantile * std::sqrt(squares / (n - 1) / n)};
}

/// A column of the table: one run by one source.
struct result_column {
  std::size_t run;
  std::vector<double> row_values::*source;
  std::string heading;
};

std::vector<result_column> columns_of(const experiment_result& result) {
  std::vector<result_column> columns;
  for (std::size_t k = 0; k < result.runs.size(); ++k) {
    const run_result& run = result.runs[k];
    const bool failed = run.measured.is_null();
    if (run.run->table.empty()) {
      columns.push_back({k, &row_values::measured, run.run->label + (failed ? ": failed" : "")});
      continue;
    }
    columns.push_back({k, &row_values::paper, run.run->label + ": paper"});
    columns.push_back({k, &row_values::measured, failed ? "failed" : "measured"});
    if (!run.simulated.is_null())
      columns.push_back({k, &row_values::simulated, "simulated"});
  }
  return columns;
}

std::string label_of(const experiment_row& row) {
  return row.unit.empty() ? row.label : row.label + " (" + row.unit + ")";
}

std::vector<text_row> transposed(const std::vector<text_row>& lines) {
  std::vector<text_row> turned(lines.front().size());
  for (const text_row& line : lines)
    for (std::size_t k = 0; k < line.size(); ++k)
      turned[k].push_back(line[k]);
  return turned;
}

std::string markdown_table(const experiment_result& result) {
  const auto columns = columns_of(result);
  std::vector<text_row> lines{{""}};
  for (const result_column& column : columns)
    lines.front().push_back(column.heading);
  for (const experiment_row& row : result.what->rows) {
    const row_values values = values_of(row, result);
    text_row& line = lines.emplace_back(text_row{label_of(row)});
    for (const result_column& column : columns) {
      line.push_back(cell((values.*column.source)[column.run], row));
      if (column.source == &row_values::measured && row.is_mean && std::isfinite(values.margin[column.run]))
        line.back() += " ± " + cell(values.margin[column.run], row);
    }
  }
  if (result.what->run_per_line)
    lines = transposed(lines);
  std::string text;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    text += '|';
    for (const std::string& field : lines[k])
      text += (field.empty() ? "" : " " + field) + " |";
    text += '\n';
    if (k > 0)
      continue;
    text += "|---|";
    for (std::size_t column = 1; column < lines[k].size(); ++column)
      text += "--:|";
    text += '\n';
  }
  return text;
}

/// With those of the runs beside.
json column_of_paper(const experiment_run& run) {
  if (run.table.empty())
    return json();
  json column = paper_table(run.table).at("columns").at(run.column);
  for (const experiment_run& other : run.beside)
    column[other.label] = column_of_paper(other);
  return column;
}

void add_places(const std::vector<experiment_run>& runs, std::vector<std::string>& places) {
  for (const experiment_run& run : runs) {
    if (run.table.empty())
      continue;
    const auto place = paper_table(run.table).at("place").get<std::string>();
    if (std::find(places.begin(), places.end(), place) == places.end())
      places.push_back(place);
    add_places(run.beside, places);
  }
}

std::vector<std::string> places_in_paper(const experiment& what) {
  std::vector<std::string> places;
  add_places(what.runs, places);
  return places;
}

/// A line for each run, also for those beside.
void add_lines_of_runs(const std::vector<run_result>& runs, const std::string& column, std::string& text) {
  for (const run_result& run : runs) {
    const std::string label = column + run.run->label;
    text += "- " + label + ": `" + run.record.at("command").get<std::string>() + '`';
    if (run.record.contains("failure"))
      text += ", failed: " + run.record.at("failure").get<std::string>();
    else
      text += ", mesh " + run.measured.at("mesh_hash").get<std::string>();
    text += '\n';
    add_lines_of_runs(run.beside, label + ", ", text);
  }
}

json json_of_run(const run_result& run) {
  json entry{{"label", run.run->label}};
  entry.update(run.record);
  if (!run.measured.is_null())
    entry["mesh_hash"] = run.measured.at("mesh_hash");
  for (const run_result& other : run.beside)
    entry["beside"].push_back(json_of_run(other));
  return entry;
}

/// By name: whether it is of our own default method, and what it said if it failed.
using runs_by_name = std::map<std::string, std::pair<bool, std::string>>;

void add_runs(const std::vector<run_result>& runs, runs_by_name& all) {
  for (const run_result& run : runs) {
    all[run.name] = {run.run->options.empty(), run.record.value("failure", "")};
    add_runs(run.beside, all);
  }
}

/// A line for each run that failed, also for those beside, with its message in place of a number.
void add_failures(const std::vector<run_result>& runs, const std::string& name, const std::string& column,
                  std::string& text) {
  for (const run_result& run : runs) {
    const std::string label = column + run.run->label;
    if (run.record.contains("failure"))
      text += csv_line({name, "failure", "", label, "measured", run.record.at("failure").get<std::string>()});
    add_failures(run.beside, name, label + ", ", text);
  }
}

/// What JSON has no number for is null.
json json_of(const std::vector<double>& values) {
  json list = json::array();
  for (const double value : values)
    list.push_back(std::isfinite(value) ? json(value) : json());
  return list;
}

} // namespace

void add_beside(run_result& result, run_result other) {
  const std::string& label = other.run->label;
  for (json run_result::*report : {&run_result::measured, &run_result::simulated})
    if (!(result.*report).is_null() && !(other.*report).is_null())
      (result.*report)[label] = other.*report;
  result.beside.push_back(std::move(other));
}

failure_summary failures_of(const std::vector<experiment_result>& results) {
  runs_by_name all;
  for (const experiment_result& result : results)
    add_runs(result.runs, all);
  failure_summary summary;
  std::size_t failed = 0;
  for (const auto& [name, run] : all) {
    const auto& [ours, message] = run;
    if (message.empty())
      continue;
    ++failed;
    summary.is_error = summary.is_error || ours;
    summary.text += (failed == 1 ? ": " : "; ") + name + ": " + message;
  }
  if (failed == 0)
    return summary;
  summary.is_error = summary.is_error || failed == all.size();
  summary.text.insert(0, std::to_string(failed) + " of " + std::to_string(all.size()) + " runs failed");
  return summary;
}

double value_of(const figure& wanted, const json& document) {
  if (wanted.sum.empty() || document.is_null())
    return not_measured;
  double value = sum_of(wanted.sum, document) - sum_of(wanted.less, document);
  for (const summed& factor : wanted.over)
    value /= sum_of(factor, document);
  return wanted.times * value;
}

row_values values_of(const experiment_row& row, const experiment_result& result) {
  row_values values;
  for (const run_result& run : result.runs) {
    values.paper.push_back(value_of(row.paper, column_of_paper(*run.run)));
    const figure ours = is_of(row, *run.run) ? row.ours : figure();
    std::vector<double> of_seeds{value_of(ours, run.measured)};
    if (row.is_mean)
      for (const run_result& other : run.beside)
        of_seeds.push_back(value_of(ours, other.measured));
    const auto [mean, margin] = mean_and_margin(of_seeds);
    values.measured.push_back(row.is_mean ? mean : of_seeds.front());
    values.margin.push_back(margin);
    values.simulated.push_back(value_of(ours, run.simulated));
  }
  if (!row.over_first)
    return values;
  if (have_same_workers(result.runs))
    std::fill(values.measured.begin(), values.measured.end(), not_measured);
  return {over_first(std::move(values.paper)), over_first(std::move(values.measured)),
          over_first(std::move(values.simulated)), std::move(values.margin)};
}

std::string markdown_text(const experiment_result& result) {
  std::string text =
      "## " + result.what->title + "\n\n`" + result.origin.at("command").get<std::string>() + '`';
  const auto places = places_in_paper(*result.what);
  for (std::size_t k = 0; k < places.size(); ++k)
    text += (k == 0 ? ": the paper's " : "; ") + places[k];
  text += ". Elements are ";
  text += places.empty() ? "those of the experiment" : "the paper's";
  text += " over " + number_text(result.origin.at("scale").get<double>()) + ".\n\n" + markdown_table(result) +
          '\n';
  if (const std::string input = result.origin.value("input", ""); !input.empty())
    text += "- Every run is of `" + input + "`, whatever models title, labels and notes name.\n";
  for (const std::string& note : result.what->notes)
    text += "- " + note + '\n';
  text += "\nThe runs, one by one:\n\n";
  add_lines_of_runs(result.runs, "", text);
  return text;
}

std::string csv_text(const experiment_result& result) {
  struct source_of_values {
    const char* name;
    std::vector<double> row_values::*values;
    bool is_ours;
  };
  constexpr source_of_values sources[] = {{"paper", &row_values::paper, false},
                                          {"measured", &row_values::measured, true},
                                          {"simulated", &row_values::simulated, true},
                                          {"margin", &row_values::margin, false}};
  std::string text = csv_line({"experiment", "row", "unit", "run", "source", "value"});
  for (const experiment_row& row : result.what->rows) {
    const row_values values = values_of(row, result);
    for (std::size_t k = 0; k < result.runs.size(); ++k) {
      const experiment_run& run = *result.runs[k].run;
      for (const source_of_values& source : sources) {
        const double value = (values.*source.values)[k];
        if (std::isfinite(value) || (source.is_ours && !is_of(row, run)))
          text += csv_line({result.what->name, row.label, row.unit, run.label, source.name,
                            std::isfinite(value) ? number_text(value, 12) : ""});
      }
    }
  }
  add_failures(result.runs, result.what->name, "", text);
  return text;
}

std::string json_text(const experiment_result& result) {
  json document{{"experiment", result.what->name}, {"title", result.what->title}};
  document.update(result.origin);
  document["seconds"] = result.seconds;
  document["paper"] = paper_figures().at("paper");
  document["places"] = places_in_paper(*result.what);
  document["runs"] = json::array();
  for (const run_result& run : result.runs)
    document["runs"].push_back(json_of_run(run));
  document["rows"] = json::array();
  for (const experiment_row& row : result.what->rows) {
    const row_values values = values_of(row, result);
    document["rows"].push_back({{"label", row.label},
                                {"unit", row.unit},
                                {"paper", json_of(values.paper)},
                                {"measured", json_of(values.measured)},
                                {"margin", json_of(values.margin)},
                                {"simulated", json_of(values.simulated)}});
  }
  document["plots"] = json::array();
  for (const experiment_plot& plot : result.what->plots)
    document["plots"].push_back({{"title", plot.title},
                                 {"horizontal", plot.horizontal},
                                 {"vertical", plot.vertical},
                                 {"runs", plot.runs},
                                 {"logarithmic", plot.logarithmic}});
  return text_of_json(document, 2) + '\n';
}

} // namespace dovetail::app
