#include "compare_options.hpp"

#include "decomposition_options.hpp"
#include "policies.hpp"

#include <CLI/CLI.hpp>

namespace dovetail::app {
namespace {

std::string listed(const std::vector<std::string>& known) {
  std::string text;
  for (const auto& name : known)
    text += (text.empty() ? "" : ", ") + name;
  return text;
}

std::string choice_of(const std::vector<std::string>& known) {
  return "(default: " + known.front() + "). There are: " + listed(known);
}

void add_names(CLI::App& command, const std::string& option, std::vector<std::string>& chosen,
               const std::string& what, const std::string& choice) {
  command.add_option(option, chosen, what + ", separated by commas " + choice)->delimiter(',');
}

} // namespace

void add_compare_options(CLI::App& command, compare_options& options) {
  add_decomposition_options(command, options);
  add_names(command, "--partitioners", options.partitioners, "Graph partitioners",
            choice_of(partitioner_names()));
  add_names(command, "--meshers", options.meshers, "Meshers",
            choice_of(mesher_names<3>()) + "; of --dimension 2 " + choice_of(mesher_names<2>()));
  add_names(command, "--improvers", options.improvers, "Mesh improvers", choice_of(improver_names()));
  add_names(command, "--simplifiers", options.simplifiers, "Rules of simplification",
            "(default: paper,none). There are: " + listed(simplifier_names()));
  command.add_option("--executor", options.executor, "Where pieces are meshed: " + listed(executor_names()));
  command.add_option("-o,--out", options.out, "Folder for compare.csv and compare.html")
      ->capture_default_str();
  command.add_flag("--quiet", options.quiet, "No progress and no table on the terminal");
}

} // namespace dovetail::app
