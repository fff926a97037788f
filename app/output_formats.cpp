#include "output_formats.hpp"

#include "failure.hpp"
#include "named_policies.hpp"

#include "dovetail/io/msh_writer.hpp"
#include "dovetail/io/vtu_writer.hpp"

#include <algorithm>
#include <limits>
#include <system_error>

namespace dovetail::app {
namespace {

/// Of the spool: four 4-byte corners, and a 24-byte point for every fifth to sixth element.
constexpr double spool_bytes_per_element = 22;

/// All of them: a new format is one more line.
template <int D>
std::vector<output_format<D>> known_formats(int files) {
  constexpr double msh_bytes = D == 3 ? 48 : 45;
  std::vector<output_format<D>> known;
  known.push_back({"vtu", D == 3 ? 50.0 : 45.0, io::vtu_writer{.files = files}});
  known.push_back({"msh", msh_bytes, io::msh_writer{}});
  if constexpr (D == 3)
    known.push_back({"msh-partitioned", msh_bytes, io::partitioned_msh_writer{}});
  return known;
}

template <int D>
std::vector<std::string> names_of_formats() {
  std::vector<std::string> names;
  for (const auto& format : known_formats<D>(0))
    names.push_back(format.name);
  names.push_back("none");
  return names;
}

template <int D>
output_format<D> format_of(const std::string& name, int files) {
  for (auto& format : known_formats<D>(files))
    if (format.name == name)
      return format;
  throw command_line_error("--format: there is no '" + name + "' for --dimension " + std::to_string(D) +
                           "; there are: " + joined(names_of_formats<D>()));
}

} // namespace

std::vector<std::string> format_names(int dimension) {
  return dimension == 3 ? names_of_formats<3>() : names_of_formats<2>();
}

template <int D>
std::vector<output_format<D>> make_formats(const std::vector<std::string>& names, int files) {
  if (files < 0)
    throw command_line_error("--files: " + std::to_string(files) + " is negative");
  std::vector<output_format<D>> formats;
  for (const auto& name : names)
    if (name != "none")
      formats.push_back(format_of<D>(name, files));
  if (names.empty())
    formats.push_back(known_formats<D>(files).front());
  return formats;
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
