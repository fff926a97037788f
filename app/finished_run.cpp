#include "finished_run.hpp"

#include "output_formats.hpp"
#include "rank_partitioner.hpp"
#include "run_identity.hpp"

#include "dovetail/core/output_file.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>

namespace dovetail::app {
namespace {

constexpr const char* record_name = "finished_run.txt";
constexpr const char* unknown_checksum = "-"; ///< of a run that ended while it read its files back

/// Other numbers of ranks may give other parts.
std::string text_of_rank_partitioner(const mesh_options& options) {
  if (options.rank_partitioner.empty() || options.rank_partitioner == rank_partitioner_names().front())
    return "";
  return " parts by " + options.rank_partitioner + " on " +
         std::to_string(options.network ? options.network->size() : 1);
}

/// What is behind the line "files".
std::vector<written_file> listed_files(std::istream& record) {
  std::vector<written_file> files;
  written_file file;
  while (record >> file.bytes >> file.checksum && record.ignore() && std::getline(record, file.name)) {
    if (file.checksum == unknown_checksum)
      file.checksum.clear();
    files.push_back(file);
  }
  return files;
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
  const std::vector<written_file> files = listed_files(listed);
  return std::all_of(files.begin(), files.end(), [&](const written_file& each) {
    std::error_code missing;
    return std::filesystem::file_size(folder_ / each.name, missing) == each.bytes && !missing;
  });
}

void finished_run::record(const std::vector<written_file>& files, const std::optional<double>& joined) const {
  output_file file(folder_ / record_name);
  file.text(started_with_);
  for (const written_file& each : files)
    file.text(std::to_string(each.bytes) + " " + (each.checksum.empty() ? unknown_checksum : each.checksum) +
              " " + each.name + "\n");
  if (!input_.empty()) // behind the files: where it lies is no part of what the run is
    file.text("input " + input_ + "\n");
  if (joined)
    file.text("joined " + all_digits(*joined) + "\n");
  file.commit();
}

std::vector<written_file> files_of_run_in(const std::filesystem::path& folder) {
  std::ifstream record(folder / record_name, std::ios::binary);
  std::string line;
  while (std::getline(record, line))
    if (line == "files")
      return listed_files(record);
  return {};
}

std::optional<recorded_model> model_of_run_beside(const std::filesystem::path& mesh) {
  std::error_code failure;
  const auto whole_path = std::filesystem::absolute(mesh);
  const std::filesystem::path folder =
      std::filesystem::is_directory(mesh, failure) ? whole_path : whole_path.parent_path();
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
    else if (double length = 0; what == "joined" && std::istringstream(value) >> length) // or "default"
      model.joined = length;
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
