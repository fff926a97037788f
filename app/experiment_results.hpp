/// @file
/// What the runs of an experiment gave, and its forms for people and programs.
#pragma once

#include "experiment.hpp"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace dovetail::app {

/// A run that was made, now or before.
struct run_result {
  const experiment_run* run = nullptr;
  nlohmann::ordered_json measured = {}; ///< its report; null where it failed
  /// The report with the workers of the paper's column and the times that a simulation finds for them; null
  /// where so many have made the run.
  nlohmann::ordered_json simulated = {};
  nlohmann::ordered_json record = {};  ///< what it was asked for, its command line and sizes
  std::vector<run_result> beside = {}; ///< of the runs in the same column, whose reports are in these too
  std::string name = {};               ///< where it is kept, and in messages
};

struct experiment_result {
  const experiment* what = nullptr;
  nlohmann::ordered_json origin = {}; ///< command, version, date, scale, seeds
  std::vector<run_result> runs = {};  ///< as the experiment lists them
  double seconds = 0;                 ///< that making them took, without those that were there
};

/// What of all that experiments have made failed. A run that several of them show counts once.
struct failure_summary {
  std::string text = {}; ///< "2 of 14 runs failed: NAME: MESSAGE; ..."; empty where none did
  /// A run of our own default method is among them, which is one without options of its own, or there is no
  /// other.
  bool is_error = false;
};
failure_summary failures_of(const std::vector<experiment_result>& results);

/// Puts the reports of a run beside this one into its own, and keeps it.
void add_beside(run_result& result, run_result other);

/// A figure of a document, as its numbers are there; NaN where one of them is missing.
double value_of(const figure& wanted, const nlohmann::ordered_json& document);

/// The numbers of a row: of each run the paper's, the measured and the simulated one; NaN where there is
/// none.
struct row_values {
  std::vector<double> paper, measured, simulated;
  std::vector<double> margin = {}; ///< of a row of means: half the length of their 95 % intervals
};
row_values values_of(const experiment_row& row, const experiment_result& result);

/// Heading, table, notes, and the command lines of the runs.
std::string markdown_text(const experiment_result& result);
/// A line for each number: experiment, row, unit, run, source ("paper", "measured", "simulated", "margin"),
/// value, which is empty where the run's method has no such step; and one for each run that failed, with
/// "failure" as the row and its message as the value.
std::string csv_text(const experiment_result& result);
/// All of it, with what the plots are of.
std::string json_text(const experiment_result& result);

} // namespace dovetail::app
