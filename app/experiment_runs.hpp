/// @file
/// Makes the runs of experiments, each once.
#pragma once

#include "build_identity.hpp"
#include "experiment_column.hpp"
#include "experiment_options.hpp"
#include "experiment_results.hpp"

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::app {

/// Calls the driver: its words after the program's name, and the file for its error stream. Returns the exit
/// code.
using driver_call = std::function<int(const std::vector<std::string>&, const std::string&)>;

class run_maker {
public:
  /// Finds what is wrong with the options. Workers are processes of `dovetail mesh` as the driver makes them.
  run_maker(const experiment_options& options, driver_call driver);

  /// The run in its folder in `<out>/runs`, unless the same one is there, and those beside it. One that fails
  /// is a result, and is not tried again by this maker; throws `cancelled` when it was stopped.
  run_result make(const experiment_run& run);
  int workers() const { return workers_; }

private:
  struct place_of_run; ///< what it is called, and where it is kept

  place_of_run place_of(const experiment_run& run, const wanted_run& wanted) const;
  void carry_out(const place_of_run& place, const wanted_run& wanted, run_result& result);
  std::vector<std::string> words_for_sizes(const experiment_run& run, double elements,
                                           const std::filesystem::path& file, nlohmann::ordered_json& record);

  const experiment_options& options_;
  driver_call driver_;
  int workers_;
  std::string input_checksum_;
  run_identity build_;
  std::map<std::string, nlohmann::ordered_json> failed_; ///< by name: the records of runs
  /// By model and number of elements: the factor of its sizes, and its own size or 0.
  std::map<std::pair<std::string, double>, std::pair<double, double>> sizes_;
};

} // namespace dovetail::app
