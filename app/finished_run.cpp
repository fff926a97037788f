#include "finished_run.hpp"

#include "output_formats.hpp"
#include "rank_partitioner.hpp"

#include "dovetail/core/output_file.hpp"

#include <cstdint>
#include <fstream>
#include <sstream>
#include <system_error>

namespace dovetail::app {
namespace {

constexpr const char* record_name = "finished_run.txt";

/// Other numbers of ranks may give other parts.
std::string text_of_rank_partitioner(const mesh_options& options) {
  if (options.rank_partitioner.empty() || options.rank_partitioner == rank_partitioner_names().front())
    return "";
  return " parts by " + options.rank_partitioner + " on " +
         std::to_string(options.network ? options.network->size() : 1);
}

} // namespace

finished_run::finished_run(const std::filesystem::path& folder, const run_identity& identity,
                           const mesh_options& options)
    : folder_(folder) {
  if (!options.model.input.empty())
    input_ = std::filesystem::absolute(options.model.input)
                 .lexically_normal()
                 .lexically_relative(std::filesystem::absolute(folder).lexically_normal())
                 .string();
  for (const auto& [what, value] : identity)
    started_with_ += what + " " + value + "\n";
  for (const auto& format : options.formats)
    started_with_ += "format " + format + "\n";
  if (options.ranks)
    started_with_ += "ranks " + std::to_string(*options.ranks) + " " + options.redistribute +
                     (options.ghosts ? " ghosts" : "") +
                     " improved again: " + improvement_of_ranks(options, options.dimension) +
                     text_of_rank_partitioner(options) + "\n";
  started_with_ += "pieces " + std::to_string(options.files) + "\nfiles\n";
}

bool finished_run::is_there() const {
  std::ifstream file(folder_ / record_name, std::ios::binary);
  std::ostringstream content;
  content << file.rdbuf();
  const std::string text = content.str();
  if (!file || !text.starts_with(started_with_))
    return false;
  std::istringstream listed(text.substr(started_with_.size()));
  std::uint64_t bytes = 0;
  std::string checksum, name;
  while (listed >> bytes >> checksum && listed.ignore() && std::getline(listed, name)) {
    std::error_code missing;
    if (std::filesystem::file_size(folder_ / name, missing) != bytes || missing)
      return false;
  }
  return true;
}

void finished_run::record(const std::vector<written_file>& files) const {
  output_file file(folder_ / record_name);
  file.text(started_with_);
  for (const written_file& each : files)
    file.text(std::to_string(each.bytes) + " " + (each.checksum.empty() ? "-" : each.checksum) + " " +
              each.name + "\n");
  if (!input_.empty()) // behind the files: where it lies is no part of what the run is
    file.text("input " + input_ + "\n");
  file.commit();
}

std::optional<recorded_model> model_of_run_beside(const std::filesystem::path& mesh) {
  const std::filesystem::path folder = std::filesystem::absolute(mesh).parent_path();
  std::ifstream record(folder / record_name, std::ios::binary);
  recorded_model model;
  std::string checksum, line;
  while (std::getline(record, line)) {
    const std::size_t space = line.find(' ');
    if (space == std::string::npos)
      continue;
    const std::string what = line.substr(0, space), value = line.substr(space + 1);
    if (what == "model")
      model.name = value;
    else if (what == "unit")
      model.unit = value;
    else if (what == "file")
      checksum = value;
    else if (what == "input")
      model.file = (folder / value).lexically_normal();
  }
  if (model.name.empty() || (!checksum.empty() && model.file.empty()))
    return {};
  if (!model.file.empty()) {
    std::error_code missing;
    model.is_as_it_was = std::filesystem::is_regular_file(model.file, missing) && !missing &&
                         checksum_of_file(model.file) == checksum;
  }
  return model;
}

void finished_run::forget() const {
  std::error_code ignored;
  std::filesystem::remove(folder_ / record_name, ignored);
}

} // namespace dovetail::app
