#include "file_checksums.hpp"

#include "json_text.hpp"

#include "dovetail/core/error.hpp"
#include "dovetail/core/hash.hpp"
#include "dovetail/parallel/map_tasks.hpp"

#include <nlohmann/json.hpp>

#include <array>
#include <cstdio>
#include <fstream>
#include <limits>
#include <span>
#include <system_error>

namespace dovetail::app {

std::string hexadecimal(std::uint64_t value) {
  std::array<char, 17> text{};
  std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(value));
  return text.data();
}

std::string checksum_of_text(std::string_view text) {
  content_hash hash;
  hash.text(text);
  return hexadecimal(hash.value());
}

std::string checksum_of_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  content_hash hash;
  std::vector<char> block(1 << 20);
  while (file.read(block.data(), static_cast<std::streamsize>(block.size())) || file.gcount() > 0)
    hash.bytes(std::as_bytes(std::span(block.data(), static_cast<std::size_t>(file.gcount()))));
  if (!file.eof())
    throw io_error("cannot read " + path.string());
  return hexadecimal(hash.value());
}

std::vector<written_file> read_back(const std::filesystem::path& folder,
                                    const std::vector<std::string>& names, const any_executor& run_tasks,
                                    const progress& on_progress) {
  auto results = map_tasks(run_tasks, names.size(),
                           [&](std::size_t k) {
                             return std::pair(std::uint64_t{std::filesystem::file_size(folder / names[k])},
                                              checksum_of_file(folder / names[k]));
                           },
                           {.limit_seconds = std::numeric_limits<double>::infinity(),
                            .on_progress = on_progress,
                            .stage = "reading back"});
  std::vector<written_file> files;
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (!results[k].value)
      throw io_error("cannot read " + (folder / names[k]).string() + " back: " + results[k].failure);
    auto& [bytes, checksum] = *results[k].value;
    files.push_back({names[k], bytes, std::move(checksum)});
  }
  return files;
}

report_files files_of_report(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file)
    throw input_error(path.string() + ": cannot read the report");
  try {
    const auto document = nlohmann::json::parse(file);
    const auto bytes = document.find("folder_bytes");
    const std::string folder = bytes == document.end() ? document.at("folder").get<std::string>()
                                                       : bytes_of_digits(bytes->get<std::string>());
    report_files found{path.parent_path() / folder, {}};
    for (const auto& listed : document.at("files"))
      found.files.push_back({listed.at("name").get<std::string>(), listed.at("bytes").get<std::uint64_t>(),
                             listed.at("checksum").get<std::string>()});
    if (found.files.empty())
      throw input_error(path.string() + ": the run of this report has written no files");
    return found;
  } catch (const input_error&) {
    throw;
  } catch (const std::exception&) { // of JSON, or of a number in it
    throw input_error(path.string() + ": not a report of 'dovetail mesh' that lists its files");
  }
}

std::string faults_of(const report_files& given) {
  std::string faults;
  for (const written_file& file : given.files) {
    const auto path = given.folder / file.name;
    std::error_code missing;
    const auto bytes = std::filesystem::file_size(path, missing);
    std::error_code ignored;
    const auto same_content = [&] {
      return file.checksum.empty() || checksum_of_file(path) == file.checksum;
    };
    const char* fault = std::filesystem::is_directory(path, ignored) ? " is a folder"
                        : missing                                    ? " is missing"
                        : bytes != file.bytes                        ? " has another size"
                        : !same_content()                            ? " has another content"
                                                                     : nullptr;
    if (fault != nullptr)
      faults += (faults.empty() ? "" : ", ") + path.string() + fault;
  }
  return faults;
}

} // namespace dovetail::app
