/// @file
/// The record of a finished run beside its mesh, so that --resume knows that nothing is left to do.
#pragma once

#include "file_checksums.hpp"
#include "options.hpp"

#include "dovetail/parallel/spool.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dovetail::app {

/// `finished_run.txt` in the folder of a mesh: what the run was started with, and its files.
class finished_run {
public:
  finished_run(const std::filesystem::path& folder, const run_identity& identity,
               const mesh_options& options);

  /// Whether this very run has come to its end, and its files are there in their size.
  bool is_there() const;
  /// Written when all files are; again with the checksums, when they are known.
  /// \param joined the length within which faces of the model were joined, if they were
  void record(const std::vector<written_file>& files, const std::optional<double>& joined) const;
  /// Whatever run was finished here, its files will be replaced.
  void forget() const;

private:
  std::filesystem::path folder_;
  std::string started_with_;
  std::string input_; ///< the model's file, from the folder; empty for a built-in one
};

/// The files that the run in a folder has written, by its record; none where there is no record.
std::vector<written_file> files_of_run_in(const std::filesystem::path& folder);

/// The model that the run in a folder made its mesh of.
struct recorded_model {
  std::filesystem::path file; ///< empty for a built-in model
  std::string name;           ///< of the built-in model, or the file's
  std::string unit = "mm";
  std::optional<double> joined; ///< length within which faces were joined
  bool is_as_it_was = true;     ///< the file is there, with the content that it had
};

/// By the record of the finished run beside a mesh file; nothing where there is none, or an older one that
/// does not say where the file is.
std::optional<recorded_model> model_of_run_beside(const std::filesystem::path& mesh);

} // namespace dovetail::app
