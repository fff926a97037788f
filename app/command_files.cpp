#include "command_files.hpp"

#include "any_mesh_file.hpp"
#include "failure.hpp"
#include "file_place.hpp"
#include "output.hpp"
#include "view_groups.hpp"

#include "dovetail/core/output_file.hpp"
#include "dovetail/files/json_tree.hpp"
#include "dovetail/files/sizing_json.hpp"

#include <algorithm>
#include <exception>
#include <optional>
#include <string_view>
#include <utility>

namespace dovetail::app {
namespace {

constexpr std::string_view part_ending = ".part";

/// A pipe can be read once, and not here.
bool can_be_looked_into(const std::filesystem::path& file) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(file, ignored) || std::filesystem::is_directory(file, ignored);
}

void append_backgrounds(const sizing::json_value& value, const std::filesystem::path& folder,
                        command_inputs& inputs) {
  if (const auto* background = value.find("background"))
    if (const auto* file = background->find("file")) {
      const auto read = inputs_of_mesh("a mesh that --sizing names,", folder / file->text);
      inputs.insert(inputs.end(), read.begin(), read.end());
    }
  for (const auto& item : value.items)
    append_backgrounds(item, folder, inputs);
}

/// With what it is told apart from others by.
struct known_file {
  named_file given;
  std::optional<file_place> place;

  explicit known_file(named_file file) : given(std::move(file)), place(place_of(given.file)) {}
  std::string text() const { return given.option + " " + given.file.string(); }
};

[[noreturn]] void refuse(const known_file& output, const std::string& why) {
  throw command_line_error(output.text() + ": " + why + "; give another name");
}

bool is_same(const known_file& a, const known_file& b) {
  return a.place && a.place == b.place;
}

void require_other_than(const known_file& output, const known_file& other, bool is_input) {
  if (is_same(output, other))
    refuse(output, is_input ? "would overwrite " + other.text()
                            : other.text() + " is the same file, or folder, and only one could be kept");
  const auto temporary = temporary_name(output.given.file);
  if (!temporary)
    return;
  const known_file unfinished({output.given.option, *temporary});
  if (is_same(unfinished, other))
    refuse(output, "it is called " + unfinished.given.file.string() + " until it is complete, and that is " +
                       other.text());
}

/// The files that a command writes in a folder of its own.
class folder_files {
public:
  folder_files(named_file folder, std::vector<std::string> names)
      : folder_(std::move(folder)), names_(std::move(names)) {
    for (const auto& entry : entries_of(folder_.given.file))
      if (is_written(entry.filename().string()))
        there_.emplace_back(named_file{folder_.given.option, entry});
  }

  const known_file& folder() const { return folder_; }

  void require_none_is(const known_file& file, bool is_input) const {
    const auto name = name_below(file.given.file, folder_.given.file);
    const bool linked = std::any_of(there_.begin(), there_.end(),
                                    [&](const known_file& each) { return is_same(each, file); });
    if (!linked && (!name || !is_written(*name)))
      return;
    if (is_input)
      refuse(folder_, "would overwrite " + file.text());
    refuse(file, folder_.text() + " is for files of this name too, and only one could be kept");
  }

private:
  bool is_written(const std::string& name) const {
    return std::any_of(names_.begin(), names_.end(), [&](const std::string& pattern) {
      return matches(pattern.c_str(), name.c_str()) ||
             (name.ends_with(part_ending) &&
              matches(pattern.c_str(), name.substr(0, name.size() - part_ending.size()).c_str()));
    });
  }

  known_file folder_;
  std::vector<std::string> names_;
  std::vector<known_file> there_; ///< which may be links to what is elsewhere
};

std::vector<known_file> known(const std::vector<named_file>& files) {
  std::vector<known_file> found;
  for (const auto& each : files)
    if (!each.file.empty())
      found.emplace_back(each);
  return found;
}

} // namespace

command_inputs inputs_of_mesh(const std::string& option, const std::filesystem::path& file) {
  command_inputs inputs{{option, file}};
  if (!can_be_looked_into(file))
    return inputs;
  try {
    for (const auto& each : files_of_any_mesh(file))
      if (each != file)
        inputs.push_back({"a file of " + option, each});
  } catch (const std::exception&) {
  }
  return inputs;
}

command_inputs inputs_of_view(const std::string& option, const std::filesystem::path& file) {
  command_inputs inputs = inputs_of_mesh(option, file);
  for (const named_file& each : command_inputs(inputs))
    if (const auto surface = surface_beside(each.file); !surface.empty())
      inputs.push_back({"a file of " + option, surface});
  return inputs;
}

command_inputs inputs_of_sizing(const std::filesystem::path& file) {
  command_inputs inputs{{"--sizing", file}};
  if (!can_be_looked_into(file))
    return inputs;
  try {
    const std::string text = sizing::read_sizing_text(file);
    append_backgrounds(sizing::parse_json(text, file.string()), file.parent_path(), inputs);
  } catch (const std::exception&) {
  }
  return inputs;
}

command_inputs inputs_of_model(const model_options& options) {
  command_inputs inputs = inputs_of_sizing(options.sizing);
  inputs.push_back({"INPUT", options.input});
  return inputs;
}

void require_distinct(const command_inputs& inputs, const command_outputs& outputs) {
  const auto read = known(inputs), written = known(outputs.files);
  std::vector<folder_files> folders;
  if (!outputs.folder.empty())
    folders.emplace_back(named_file{"--out", outputs.folder}, outputs.names_in_folder);
  if (outputs.has_own_spool)
    folders.emplace_back(named_file{"--spool", outputs.spool},
                         std::vector<std::string>{"manifest.txt", "*.blob"});
  for (std::size_t k = 0; k < written.size(); ++k) {
    for (const known_file& input : read)
      require_other_than(written[k], input, true);
    for (std::size_t j = 0; j < written.size(); ++j)
      if (j != k)
        require_other_than(written[k], written[j], false);
  }
  for (const folder_files& each : folders) {
    for (const known_file& input : read)
      each.require_none_is(input, true);
    for (const known_file& output : written) {
      require_other_than(output, each.folder(), false);
      each.require_none_is(output, false);
    }
  }
  if (folders.size() == 2) {
    require_other_than(folders[1].folder(), folders[0].folder(), false);
    folders[0].require_none_is(folders[1].folder(), false);
  }
}

} // namespace dovetail::app
