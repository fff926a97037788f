/// @file
/// How the help of a command looks, whatever the version of CLI11: newer ones wrap lines, write headings in
/// capitals and set short options apart, and manual pages, completions and documents are made from the help.
#pragma once

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::app {

class help_format : public CLI::Formatter {
public:
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override {
    std::string footer = app->get_footer();
    if (!footer.empty())
      footer += '\n';
    return app->get_description() + '\n' + make_usage(app, std::move(name)) + make_positionals(app) +
           make_groups(app, mode) + make_subcommands(app, mode) + '\n' + footer;
  }

  std::string make_usage(const CLI::App* app, std::string name) const override {
    std::string usage = "Usage: " + name + " [OPTIONS]";
    for (const CLI::Option* option : app->get_options(&is_positional))
      usage += ' ' + make_option_usage(option);
    if (!commands_of(app).empty())
      usage += " SUBCOMMAND";
    return usage + '\n';
  }

  std::string make_group(std::string group, bool are_positional,
                         std::vector<const CLI::Option*> options) const override {
    std::transform(group.begin() + 1, group.end(), group.begin() + 1,
                   [](char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); });
    std::string text = '\n' + group + ":\n";
    for (const CLI::Option* option : options)
      text += make_option(option, are_positional);
    return text;
  }

  std::string make_subcommands(const CLI::App* app, CLI::AppFormatMode) const override {
    const auto commands = commands_of(app);
    std::string text = commands.empty() ? "" : "\nSubcommands:\n";
    for (const CLI::App* command : commands)
      text += line(command->get_name(), command->get_description());
    return text;
  }

  std::string make_option(const CLI::Option* option, bool is_positional) const override {
    return line(make_option_name(option, is_positional) + make_option_opts(option), make_option_desc(option));
  }

  std::string make_option_opts(const CLI::Option* option) const override {
    std::string text;
    if (option->get_type_size() != 0) {
      text += ' ' + option->get_type_name();
      if (!option->get_default_str().empty())
        text += '=' + option->get_default_str();
      if (option->get_expected_max() == CLI::detail::expected_max_vector_size)
        text += " ...";
      else if (option->get_expected_min() > 1)
        text += " x " + std::to_string(option->get_expected());
      if (option->get_required())
        text += " REQUIRED";
    }
    return text + names_of(" Needs:", option->get_needs()) + names_of(" Excludes:", option->get_excludes());
  }

private:
  static bool is_positional(const CLI::Option* option) { return option->get_positional(); }

  static std::vector<const CLI::App*> commands_of(const CLI::App* app) {
    return app->get_subcommands([](const CLI::App* command) { return !command->get_name().empty(); });
  }

  template <class Options>
  static std::string names_of(const char* title, const Options& options) {
    std::string text = options.empty() ? "" : title;
    for (const CLI::Option* option : options)
      text += ' ' + option->get_name();
    return text;
  }

  /// What it is on the left, what it does on the right, or below where the left is too long.
  std::string line(const std::string& left, const std::string& right) const {
    const std::size_t width = get_column_width();
    std::string text = "  " + left;
    if (!right.empty()) {
      if (text.size() >= width)
        text += '\n' + std::string(width, ' ');
      else
        text.resize(width, ' ');
    }
    return text + right + '\n';
  }
};

} // namespace dovetail::app
