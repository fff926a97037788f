/// @file
/// The files that a command reads and writes, as the command line names them: none that it writes may be one
/// that it reads, or be written twice.
#pragma once

#include "options.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace dovetail::app {

struct command_outputs;

/// A file, and what of the command line asks for it.
struct named_file {
  std::string option;
  std::filesystem::path file; ///< empty: none
};
using command_inputs = std::vector<named_file>;

/// What is read for a model: its file, that of its sizes, and the meshes that this one names. What cannot be
/// read is left out, since the command says so.
command_inputs inputs_of_model(const model_options& options);
command_inputs inputs_of_sizing(const std::filesystem::path& file);
/// A mesh file, with its pieces where it has some.
command_inputs inputs_of_mesh(const std::string& option, const std::filesystem::path& file);
/// The same with the file of the surface, where `view` takes groups from one.
command_inputs inputs_of_view(const std::string& option, const std::filesystem::path& file);

/// Throws `command_line_error` for an output that is an input or another output, by whatever names; that
/// would be overwritten by what a command writes in its folder; or whose temporary name is one of these.
void require_distinct(const command_inputs& inputs, const command_outputs& outputs);

} // namespace dovetail::app
