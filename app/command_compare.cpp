#include "commands.hpp"
#include "compare_page.hpp"
#include "compare_pictures.hpp"
#include "compare_runs.hpp"
#include "compare_table.hpp"
#include "failure.hpp"
#include "model_source.hpp"
#include "output.hpp"
#include "resolved_walls.hpp"
#include "run_identity.hpp"
#include "run_setup.hpp"
#include "said_version.hpp"
#include "sizes_for_elements.hpp"
#include "stop_request.hpp"
#include "suppression.hpp"
#include "terminal_progress.hpp"

#include "dovetail/core/number_text.hpp"
#include "dovetail/core/output_file.hpp"
#include "png.hpp"

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <optional>
#include <string>
#include <vector>

namespace dovetail::app {
namespace {

/// Makes the pictures of a comparison while its results are there: of each decomposition the first that went
/// well, and of the worst elements one for each mesher and improver.
class picture_album {
public:
  template <int D>
  void add(const comparison_row& row, const generated<D>& result) {
    const combination& by = row.policies;
    const std::string decomposition = by.partitioner + ", simplifier " + by.simplifier;
    if (is_new(pictures_.decompositions, decomposition)) {
      pictures_.decompositions.push_back({decomposition, encode_png(picture_of_decomposition(result))});
      pictures_.interfaces.push_back({decomposition, encode_png(picture_of_interfaces(result))});
    }
    const std::string meshing = by.mesher + " + " + by.improver;
    if (is_new(pictures_.worst_elements, meshing))
      pictures_.worst_elements.push_back({meshing, encode_png(picture_of_worst_elements(result))});
  }
  const comparison_pictures& pictures() const { return pictures_; }

private:
  static bool is_new(const std::vector<captioned_picture>& pictures, const std::string& caption) {
    return std::none_of(pictures.begin(), pictures.end(),
                        [&](const captioned_picture& known) { return known.caption == caption; });
  }

  comparison_pictures pictures_;
};

/// One run of `dovetail compare`.
template <int D>
class compare_run {
public:
  /// Everything that can be wrong about the options themselves is found before any file is read.
  explicit compare_run(const compare_options& options)
      : options_(options), combinations_(combinations_of(options)) {
    for (const auto& each : combinations_)
      policies_.push_back(make_policies_of<D>(options_of_run(options, each)));
    parameters_ = make_generate_options(options_of_run(options, combinations_.front()));
    parameters_.undivided_elements = 0;
  }

  int run() {
    if (!options_.quiet)
      lines_.emplace(stderr);
    const output_folder folder(options_.out);
    for (const char* name : {"compare.csv", "compare.html"})
      check_can_create(folder.path() / name);
    model_source source = load();
    compared_.origin = origin_of(source);
    run_all(source);
    lines_.reset();
    write(folder.path());
    if (!options_.quiet)
      std::fputs(terminal_text(compared_).c_str(), stdout);
    return exit_code();
  }

private:
  model_source load() {
    show("geometry");
    suppression details(options_.model, D);
    model_source source = load_model(options_.model, D, policies_.front().executor);
    resolve_walls(source, options_.model, policies_.front(), parameters_);
    scale_to_elements(source, options_.model, policies_.front(), parameters_);
    details.apply(source);
    return source;
  }

  /// What somebody needs who wants to make the same again, or has two files of which one is newer.
  std::vector<known_fact> origin_of(const model_source& source) const {
    char date[32];
    const std::time_t now = std::time(nullptr);
    std::strftime(date, sizeof date, "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&now));
    std::vector<known_fact> facts{{"command", "Command", options_.command_line},
                                  {"version", "Version", said_version()},
                                  {"date", "Begun at", date},
                                  {"sizes", "Sizes", text_of_sizes()},
                                  {"sizes_checksum", "Checksum of the sizes in the model's box",
                                   values_of_field(source.size, source.geometry.bounds())}};
    if (!source.file.empty())
      facts.push_back({"input_checksum", "Checksum of " + source.name, source.file});
    return facts;
  }
  std::string text_of_sizes() const {
    const model_options& model = options_.model;
    const std::string given = !model.sizing.empty()         ? model.sizing
                              : model.has_automatic_sizes() ? "automatic"
                              : model.size                  ? number_text(*model.size)
                                                            : "the model's own";
    return options_.model.elements
               ? given + ", scaled for " + number_text(*options_.model.elements) + " elements"
               : given;
  }

  void run_all(const model_source& source) {
    compared_.model = source.name;
    compared_.workers = policies_.front().executor.workers();
    compared_.dimension = D;
    compared_.angle_threshold = wanted_angles_of<D>(policies_.front().simplifier).dihedral_deg;
    background_store<D> backgrounds;
    for (std::size_t k = 0; k < combinations_.size(); ++k) {
      const combination& each = combinations_[k];
      const std::string label =
          std::to_string(k + 1) + "/" + std::to_string(combinations_.size()) + " " + full_name_of(each);
      parameters_.on_progress = progress_of(label);
      compared_.rows.push_back(run_combination<D>(
          source, each, policies_[k], parameters_, backgrounds,
          [this](const comparison_row& row, const generated<D>& result) { album_.add(row, result); }));
    }
  }

  /// One line per combination on the terminal.
  progress progress_of(const std::string& label) {
    return {.update = [this, label](std::string_view, std::size_t done,
                                    std::size_t total) { show(label, done, total); },
            .stop_requested = stop_was_requested};
  }
  void show(const std::string& label, std::size_t done = 0, std::size_t total = 0) {
    if (lines_)
      lines_->update(label, done, total);
  }

  void write(const std::filesystem::path& folder) const {
    output_batch files;
    files.open(folder / "compare.csv").text(csv_text(compared_));
    files.open(folder / "compare.html").text(page_html(compared_, album_.pictures()));
    files.commit();
  }

  /// A failed combination is a result; only when all failed has the command.
  int exit_code() const {
    if (std::any_of(compared_.rows.begin(), compared_.rows.end(),
                    [](const comparison_row& row) { return !row.failed(); }))
      return exit_ok;
    complain("all " + std::to_string(compared_.rows.size()) + " combinations failed, the first with " +
             compared_.rows.front().error);
    return exit_failure;
  }

  const compare_options& options_;
  std::vector<combination> combinations_;
  std::vector<policies_of<D>> policies_; ///< per combination
  generate_options parameters_;
  std::optional<terminal_progress> lines_;
  comparison compared_;
  picture_album album_;
};

} // namespace

int run_compare(const compare_options& options) {
  try {
    return options.dimension == 3 ? compare_run<3>(options).run() : compare_run<2>(options).run();
  } catch (const cancelled&) {
    complain("stopped; nothing was written");
    return exit_stopped;
  }
}

} // namespace dovetail::app
