#include "output.hpp"

#include "failure.hpp"

#include "dovetail/core/error.hpp"
#include "dovetail/core/output_file.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/io/msh_surface_writer.hpp"
#include "dovetail/io/msh_writer.hpp"
#include "dovetail/io/vtu_writer.hpp"

#include <algorithm>
#include <limits>
#include <system_error>
#include <utility>

namespace dovetail::app {
namespace {

/// Of the spool: four 4-byte corners, and a 24-byte point for every fifth to sixth element.
constexpr double spool_bytes_per_element = 22;

template <int D, class Writer>
output_format<D> in_one_file(const std::string& name, double bytes_per_element, Writer writer) {
  return {name, bytes_per_element, {}, [writer](const auto& mesh, const auto& folder, bool release) {
            auto last = writer;
            last.release = release;
            return last(mesh, folder);
          }};
}

template <int D>
output_format<D> format_of(const std::string& name, int pieces);

template <>
output_format<2> format_of<2>(const std::string& name, int pieces) {
  if (name == "vtu")
    return {name, 45, io::vtu_writer{.pieces = pieces}};
  if (name == "msh")
    return in_one_file<2>(name, 45, io::msh_surface_writer{});
  throw command_line_error("--format: there is no '" + name + "' for triangles; there are: vtu, msh, none");
}

template <>
output_format<3> format_of<3>(const std::string& name, int pieces) {
  if (name == "vtu")
    return {name, 50, io::vtu_writer{.pieces = pieces}};
  if (name == "msh")
    return in_one_file<3>(name, 48, io::msh_writer{});
  if (name == "msh-partitioned")
    return in_one_file<3>(name, 48, io::msh_writer{.partitioned = true, .stem = "mesh_partitioned"});
  throw command_line_error("--format: there is no '" + name +
                           "'; there are: vtu, msh, msh-partitioned, none");
}

/// The folder and those around it that do not exist, innermost first.
std::vector<std::filesystem::path> absent_folders(const std::filesystem::path& path) {
  std::vector<std::filesystem::path> absent;
  for (auto folder = std::filesystem::absolute(path).lexically_normal(); !folder.empty();
       folder = folder.parent_path()) {
    std::error_code ignored;
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

} // namespace

template <int D>
std::vector<output_format<D>> make_formats(const std::vector<std::string>& names, int pieces) {
  if (pieces < 0)
    throw command_line_error("--pieces: " + std::to_string(pieces) + " is negative");
  std::vector<output_format<D>> formats;
  for (const auto& name : names)
    if (name != "none")
      formats.push_back(format_of<D>(name, pieces));
  if (names.empty())
    formats.push_back(format_of<D>("vtu", pieces));
  return formats;
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

unfinished_output::unfinished_output(std::vector<std::filesystem::path> outputs)
    : outputs_(std::move(outputs)) {
  std::erase(outputs_, std::filesystem::path());
  for (const auto& output : outputs_)
    append(absent_, absent_folders(output));
}

void unfinished_output::remove() const {
  std::error_code ignored;
  for (const auto& output : outputs_) {
    std::filesystem::remove(output.string() + ".part", ignored);
    if (!std::filesystem::is_directory(output, ignored))
      continue;
    std::vector<std::filesystem::path> parts;
    bool resumable = false;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(output, ignored)) {
      const auto& path = entry.path();
      if (path.extension() == ".part")
        parts.push_back(path);
      else if (path.filename().string().starts_with("piece_") || path.filename() == "unfinished")
        resumable = true;
    }
    for (const auto& part : parts)
      std::filesystem::remove(part, ignored);
    if (!resumable)
      std::filesystem::remove_all(output / "spool", ignored);
  }
  remove_empty(absent_);
}

void check_can_create(const std::filesystem::path& file) {
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored))
    throw io_error(file.string() + ": cannot write the file, there is a folder of this name");
  if (std::filesystem::is_fifo(file, ignored))
    return;                      // opened twice, its reader would see the end of the file after the first
  const output_file probe(file); // removes itself, since it is never committed
}

template <int D>
double bytes_per_element(const std::vector<output_format<D>>& formats) {
  double bytes = 0;
  for (const auto& format : formats)
    bytes += format.bytes_per_element;
  return std::max(bytes, spool_bytes_per_element); // the spool shrinks while the last format grows
}

template <int D>
double elements_with_room(const std::vector<output_format<D>>& formats, const std::filesystem::path& folder) {
  std::error_code failure;
  const auto space = std::filesystem::space(folder, failure);
  return failure ? std::numeric_limits<double>::infinity()
                 : static_cast<double>(space.available) / bytes_per_element(formats);
}

template std::vector<output_format<2>> make_formats<2>(const std::vector<std::string>&, int);
template std::vector<output_format<3>> make_formats<3>(const std::vector<std::string>&, int);
template double bytes_per_element<2>(const std::vector<output_format<2>>&);
template double bytes_per_element<3>(const std::vector<output_format<3>>&);
template double elements_with_room<2>(const std::vector<output_format<2>>&, const std::filesystem::path&);
template double elements_with_room<3>(const std::vector<output_format<3>>&, const std::filesystem::path&);

} // namespace dovetail::app
