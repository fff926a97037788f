/// @file
/// An experiment as plain data: which runs, and which of their figures are shown beside the paper's.
#pragma once

#include <string>
#include <vector>

namespace dovetail::app {

/// Numbers of a document that are added up, each named by its JSON pointer.
using summed = std::vector<std::string>;

/// A figure of a document: a sum less another one, over the product of others, times a factor. Without
/// numbers in the sum there is no such figure.
struct figure {
  summed sum = {};
  std::vector<summed> over = {};
  summed less = {};
  double times = 1;
};

/// A run of `dovetail mesh`. For the paper's column that is named it has that column's elements and those of
/// the background mesh, both over the scale, and its workers; one of ours, without a table, has `elements`
/// over the scale.
struct experiment_run {
  std::string label; ///< in the head of the table
  std::string model; ///< built-in, with its own ambient size and grid sources, scaled
  std::string table; ///< of the paper
  std::string column;
  std::vector<std::string> options = {}; ///< more of `dovetail mesh`
  double elements = 0;                   ///< of a run that is not for a column of the paper
  double elements_per_subdomain = 0;     ///< likewise; 0: as many subdomains as the driver chooses
  bool has_background = true;            ///< a coarse mesh is decomposed, of the column's elements
  /// Other runs that are shown in the same column. In the documents of this one, the paper's as the report,
  /// theirs have the names of their labels.
  std::vector<experiment_run> beside = {};
};

constexpr int as_count = -1; ///< in place of digits: "12.3 k"

struct experiment_row {
  std::string label;
  std::string unit = {};
  int digits = 0;    ///< after the point, or `as_count`
  figure paper = {}; ///< of a column of the paper
  figure ours = {};  ///< of a run's report
  /// The figure of the first run over this one's is shown instead.
  bool over_first = false;
  /// Labels of the runs that have such a step; of the others nothing is shown. Empty: all have it.
  std::vector<std::string> only_of = {};
  /// Measured is the mean over the run and those beside it, which differ in their seeds.
  bool is_mean = false;
};

/// Rows over another row, one point for each run.
struct experiment_plot {
  std::string title;
  std::string horizontal; ///< label of a row
  std::vector<std::string> vertical;
  std::vector<std::string> runs; ///< labels
  bool logarithmic = false;      ///< also upwards
};

struct experiment {
  std::string name; ///< as the command line has it
  std::string title;
  std::vector<experiment_run> runs;
  std::vector<experiment_row> rows;
  std::vector<std::string> notes = {}; ///< what has to be known to compare; one paragraph each
  std::vector<experiment_plot> plots = {};
  bool run_per_line = false; ///< the table has a line for each run, not a column
};

/// All that there are.
const std::vector<experiment>& all_experiments();

} // namespace dovetail::app
