/// @file
/// Checksums of files: of what a run read, and of what it wrote.
#pragma once

#include "dovetail/parallel/any_executor.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace dovetail::app {

/// A file that a run wrote.
struct written_file {
  std::string name; ///< in the run's folder
  std::uint64_t bytes = 0;
  std::string checksum; ///< of its content, in hexadecimal digits; empty when it is not known
};

std::string hexadecimal(std::uint64_t value);
std::string checksum_of_text(std::string_view text);

/// The checksum of what is in a file; throws `io_error` naming it when it cannot be read.
std::string checksum_of_file(const std::filesystem::path& file);

/// Reads the files back, several at a time, however long that takes.
std::vector<written_file> read_back(const std::filesystem::path& folder,
                                    const std::vector<std::string>& names, const any_executor& run_tasks,
                                    const progress& on_progress = {});

/// The files that the report or the record of a run lists.
struct report_files {
  std::filesystem::path folder;
  std::vector<written_file> files;
};

/// Throws `input_error` for a file that is no report of `mesh`.
report_files files_of_report(const std::filesystem::path& report);

/// Which files are not as they were written, in one line; empty when all are.
std::string faults_of(const report_files& given);

} // namespace dovetail::app
