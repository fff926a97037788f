#include "output.hpp"

#include "failure.hpp"
#include "file_place.hpp"
#include "mpirun_rank.hpp"

#include "dovetail/core/error.hpp"
#include "dovetail/core/output_file.hpp"
#include "dovetail/parallel/spool.hpp"

#include <algorithm>
#include <system_error>
#include <utility>

#include <unistd.h>

namespace dovetail::app {
namespace {

/// The folder and those around it that do not exist, innermost first.
std::vector<std::filesystem::path> absent_folders(const std::filesystem::path& path) {
  std::vector<std::filesystem::path> absent;
  std::error_code ignored; // no path, or no working directory any more
  for (auto folder = std::filesystem::absolute(path, ignored).lexically_normal(); !folder.empty();
       folder = folder.parent_path()) {
    if (std::filesystem::exists(folder, ignored) || folder == folder.root_path())
      break;
    absent.push_back(folder);
  }
  return absent;
}

void remove_empty(const std::vector<std::filesystem::path>& folders) {
  std::error_code failure;
  for (const auto& folder : folders)
    if (!std::filesystem::is_empty(folder, failure) || failure || !std::filesystem::remove(folder, failure))
      return;
}

/// The folders for unfinished files: one per format.
std::vector<std::filesystem::path> unfinished_folders(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> folders;
  std::error_code ignored;
  for (const auto& entry : entries_of(folder / "unfinished"))
    if (std::filesystem::is_directory(std::filesystem::symlink_status(entry, ignored)))
      folders.push_back(entry);
  return folders;
}

bool is_part(const std::filesystem::path& file) {
  return file.extension() == ".part";
}

void remove_part_of(const std::filesystem::path& file) {
  std::error_code failure;
  if (const auto part = temporary_name(file))
    std::filesystem::remove(*part, failure);
}

/// Names that are written directly in the folder of a command. Whatever else is there is not ours.
constexpr const char* written_names[] = {"mesh.msh",    "mesh_partitioned.msh", "finished_run.txt",
                                         "compare.csv", "compare.html",         "written_by_dovetail"};

void remove_parts_of_failed(const std::filesystem::path& folder) {
  std::error_code ignored;
  bool ours = false;
  for (const auto& file : entries_of(folder / "failed"))
    if (const auto name = file.filename().string();
        name.starts_with("failed_subdomain_") && name.ends_with(".off.part"))
      ours = std::filesystem::remove(file, ignored) || ours;
  if (ours)
    remove_empty_folder(folder / "failed");
}

/// Complete files stay, since the pieces in them may have been given up.
void remove_unfinished_parts(const std::filesystem::path& folder) {
  std::error_code ignored;
  for (const auto& of_format : unfinished_folders(folder)) {
    for (const auto& file : entries_of(of_format))
      if (is_part(file))
        std::filesystem::remove(file, ignored);
    remove_empty_folder(of_format);
  }
  remove_empty_folder(folder / "unfinished");
}

std::filesystem::path spool_of_rank(const mesh_options& options, int rank) {
  return std::filesystem::path(options.spool) / ("rank_" + std::to_string(rank));
}

void remove_spool_parts(const std::filesystem::path& spooled, bool kept) {
  std::error_code ignored;
  bool ours =
      spool::is_started(spooled) && !kept && std::filesystem::remove(spooled / "manifest.txt", ignored);
  ours = std::filesystem::remove(spooled / "manifest.txt.part", ignored) || ours;
  for (const auto& file : entries_of(spooled))
    if (file.filename().string().ends_with(".blob.part"))
      std::filesystem::remove(file, ignored);
  if (ours)
    remove_empty_folder(spooled);
}

} // namespace

std::filesystem::path spool_folder(const mesh_options& options) {
  const std::filesystem::path folder = options.out;
  return options.spool.empty() ? folder / "spool" : spool_of_rank(options, rank_of_mpirun().rank);
}

void remove_spools_of_waiting(const mesh_options& options) {
  if (options.spool.empty())
    return;
  for (const int rank : options.group) {
    const auto place = spool_of_rank(options, rank);
    if (rank == rank_of_mpirun().rank || !spool::is_started(place))
      continue;
    std::error_code ignored;
    for (const auto& file : entries_of(place))
      if (file.extension() == ".blob")
        std::filesystem::remove(file, ignored);
    remove_spool_parts(place, false);
  }
}

kept_work work_kept_in(const std::filesystem::path& folder, const std::filesystem::path& spooled) {
  kept_work kept;
  if (!spool::is_started(spooled))
    return kept;
  for (const auto& file : entries_of(spooled))
    if (file.extension() == ".blob") {
      kept.anything = true;
      kept.pieces = kept.pieces || file.filename().string().starts_with("piece_");
    }
  for (const auto& of_format : unfinished_folders(folder)) {
    const auto files = entries_of(of_format);
    kept.pieces = kept.pieces || !std::all_of(files.begin(), files.end(), is_part);
  }
  kept.anything = kept.anything || kept.pieces;
  return kept;
}

output_folder::output_folder(std::filesystem::path path) : path_(std::move(path)) {
  if (path_.empty())
    throw command_line_error("--out: the name of a folder is missing");
  made_ = absent_folders(path_);
  try {
    make_folder(path_);
    check_can_create(path_ / "written_by_dovetail");
  } catch (...) {
    remove_if_empty();
    throw;
  }
}

void output_folder::remove_if_empty() {
  remove_empty(made_);
}

unfinished_output::unfinished_output(command_outputs outputs) : outputs_(std::move(outputs)) {
  std::erase_if(outputs_.files, [](const named_file& each) { return each.file.empty(); });
  absent_ = absent_folders(outputs_.folder);
}

bool unfinished_output::remove() const {
  for (const auto& each : outputs_.files)
    remove_part_of(each.file);
  const auto& folder = outputs_.folder;
  if (folder.empty())
    return false;
  for (const char* name : written_names)
    remove_part_of(folder / name);
  bool kept = false;
  if (!outputs_.spool.empty()) {
    remove_parts_of_failed(folder);
    remove_unfinished_parts(folder);
    kept = work_kept_in(folder, outputs_.spool).anything;
    remove_spool_parts(outputs_.spool, kept);
  }
  remove_empty(absent_);
  return kept;
}

void unfinished_output::remove_of_rank() const {
  if (outputs_.has_own_spool)
    remove_spool_parts(outputs_.spool, work_kept_in(outputs_.folder, outputs_.spool).anything);
}

void check_can_create(const std::filesystem::path& file) {
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored))
    throw io_error(file.string() + ": cannot write the file, there is a folder of this name");
  if (std::filesystem::is_fifo(file, ignored))
    return;                      // opened twice, its reader would see the end of the file after the first
  const output_file probe(file); // removes itself, since it is never committed
}

} // namespace dovetail::app
