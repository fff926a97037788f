#include "commands.hpp"
#include "failure.hpp"
#include "finished_run.hpp"
#include "model_source.hpp"
#include "output.hpp"
#include "run_figures.hpp"
#include "run_identity.hpp"
#include "run_setup.hpp"
#include "stage_figures.hpp"
#include "stop_request.hpp"
#include "terminal_progress.hpp"

#include "dovetail/io/finishing_pass.hpp"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <utility>

namespace dovetail::app {
namespace {

/// The spool of a run. Unless a run leaves finished pieces to resume from, it is removed in the end.
class run_spool {
public:
  run_spool(const std::filesystem::path& folder, const run_identity& identity, bool resume)
      : spool_(resume ? spool::resume(folder, identity) : spool::start(folder, identity)) {}
  run_spool(const run_spool&) = delete;
  run_spool& operator=(const run_spool&) = delete;
  ~run_spool() {
    if (finished_ || !has_pieces())
      spool_.clear();
  }

  const spool& get() const { return spool_; }
  /// The mesh is written: the pieces are not needed any more.
  void finish() { finished_ = true; }

private:
  bool has_pieces() const {
    std::error_code failure;
    for (const auto& entry : std::filesystem::directory_iterator(spool_.folder(), failure))
      if (entry.path().filename().string().starts_with("piece_"))
        return true;
    return false;
  }

  spool spool_;
  bool finished_ = false;
};

interface_figures figures_of(const interface_angles& angles) {
  interface_figures figures;
  if (angles.interface_faces > 0) {
    figures.min_face_angle_deg = angles.face_angle.angle_deg;
    figures.min_wedge_deg = angles.min_wedge_deg();
  }
  const auto count = [&](violation_cause cause) { return static_cast<std::int64_t>(angles.count(cause)); };
  figures.faces = static_cast<std::int64_t>(angles.interface_faces);
  figures.forced = count(violation_cause::forced);
  figures.refused = count(violation_cause::refused);
  figures.remeshing = count(violation_cause::remeshing);
  return figures;
}

void collect_warnings(const report& from, std::vector<std::string>& to) {
  to.insert(to.end(), from.warnings.begin(), from.warnings.end());
  for (const auto& part : from.children)
    collect_warnings(part, to);
}

void append_files(const report& from, std::vector<std::string>& to) {
  to.insert(to.end(), from.files.begin(), from.files.end());
  for (const auto& part : from.children)
    append_files(part, to);
}

template <int D>
void add_pipeline_figures(const generated<D>& result, run_figures& figures) {
  const report& summary = result.summary;
  figures.background_elements = static_cast<std::int64_t>(result.background.elements().elements.size());
  figures.subdomains = static_cast<int>(result.mesh.counts.size());
  figures.quality = result.quality;
  figures.interfaces = figures_of(result.fine_angles);
  figures.coarse_interfaces = figures_of(result.coarse_angles);
  figures.failed_subdomains = static_cast<std::int64_t>(result.failures.size());
  const report& intersection = stage_report(summary, "intersection");
  figures.merges = static_cast<std::int64_t>(intersection.get("merges") +
                                             stage_report(summary, "meshing").get("merged_after_failure"));
  figures.largest_merged = static_cast<std::int64_t>(intersection.get("largest_merged", 1));
  const double geometry = figures.seconds.geometry;
  figures.seconds = seconds_of_stages(summary);
  figures.seconds.geometry = geometry;
  figures.peak_rss_bytes =
      std::max(figures.peak_rss_bytes,
               static_cast<std::uint64_t>(stage_report(summary, "meshing").get("peak_rss_bytes")));
}

template <int D>
void add_mesh_figures(const distributed_simplicial_mesh<D>& mesh, run_figures& figures) {
  figures.vertices = static_cast<std::int64_t>(mesh.skeleton.points.size());
  for (const auto& piece : mesh.counts)
    figures.vertices += piece.inner_points;
  const piece_figures pieces = figures_of_pieces(mesh.counts);
  figures.elements = pieces.elements;
  figures.imbalance = pieces.imbalance;
  figures.boundary_triangles = std::count_if(mesh.skeleton.subdomains.begin(), mesh.skeleton.subdomains.end(),
                                             [](const auto& sides) { return sides[1] == no_id; });
}

std::string text_of(const std::vector<piece_failure>& failures) {
  std::string text = std::to_string(failures.size()) + " subdomains could not be meshed:";
  for (const auto& failure : failures) {
    text += " subdomain " + std::to_string(failure.subdomain) + ": " + joined_reasons(failure.reasons);
    if (!failure.facets.empty())
      text += " (facets in " + failure.facets.string() + ")";
    text += ";";
  }
  return text + " give another size or --subdomains";
}

/// One run of `dovetail mesh`.
template <int D>
class mesh_run {
public:
  /// Everything that can be wrong about the options themselves is found before any file is read.
  explicit mesh_run(const mesh_options& options)
      : options_(options), policies_(make_policies_of<D>(options)),
        parameters_(make_generate_options(options)),
        formats_(make_formats<D>(options.formats, options.pieces)) {}

  int run() {
    if (!options_.report.empty())
      check_can_create(options_.report);
    if (!options_.quiet)
      lines_.emplace(stderr);
    show("geometry");
    const model_source source = load_model(options_.model, D);
    figures_.seconds.geometry = clock_.seconds();
    const output_folder folder(options_.out);
    const auto spooled = folder.path() / "spool";
    const run_identity identity = identity_of_run(options_, source);
    const finished_run finished(folder.path(), identity, options_);
    if (options_.resume && finished.is_there()) {
      if (spool::is_started(spooled)) // killed when all was done but this
        run_spool(spooled, identity, true).finish();
      lines_.reset();
      if (!options_.quiet)
        std::printf("The mesh is in %s: this run is finished, nothing is left to do\n", options_.out.c_str());
      return exit_ok;
    }
    const bool resumes = options_.resume && spool::is_started(spooled);
    if (!resumes)
      io::unfinished_folder::remove(folder.path());
    run_spool store(spooled, identity, resumes);
    finished.forget();
    parameters_.store = store.get();
    parameters_.failure_folder = folder.path() / "failed";

    const generated<D> result = generate(source, folder.path());
    describe(source, result);
    if (!result.failures.empty()) {
      finish();
      throw mesher_error(text_of(result.failures));
    }
    write(result.mesh, folder.path());
    finish();
    if (!formats_.empty())
      finished.record(figures_.files);
    store.finish();
    return exit_ok;
  }

private:
  void show(const char* stage) {
    if (lines_)
      lines_->update(stage, 0, 0);
  }

  generated<D> generate(const model_source& source, const std::filesystem::path& folder) {
    if (lines_)
      parameters_.on_progress = lines_->callbacks();
    else
      parameters_.on_progress.stop_requested = stop_was_requested;
    if (!options_.force)
      parameters_.largest_prediction = elements_with_room(formats_, folder);
    try {
      return generate_mesh_from<D>(
          make_background_mesh<D>(source.geometry, source.size, policies_, parameters_), source.geometry,
          policies_, parameters_);
    } catch (const too_many_elements& problem) {
      throw io_error(folder.string() + ": the sizes predict about " + count_text(problem.predicted) +
                     " elements, and the disk has room for about " +
                     count_text(parameters_.largest_prediction) + "; give larger sizes, or --force to try");
    }
  }

  void describe(const model_source& source, const generated<D>& result) {
    figures_.dimension = D;
    figures_.model = source.name;
    figures_.mesher = policies_.mesher.name();
    figures_.partitioner = policies_.partitioner.name();
    figures_.simplifier = policies_.simplifier.name();
    figures_.improver = policies_.improver.name();
    figures_.executor = policies_.executor.name();
    figures_.background_mesher = policies_.background_mesher.name();
    figures_.surface_mesher = policies_.surface_mesher.name();
    figures_.workers = policies_.executor.workers();
    add_pipeline_figures(result, figures_);
    add_mesh_figures(result.mesh, figures_);
    figures_.details.name = "mesh";
    figures_.details.children = {source.summary, result.summary};
    collect_warnings(figures_.details, figures_.warnings);
  }

  void write(const distributed_simplicial_mesh<D>& mesh, const std::filesystem::path& folder) {
    const stopwatch output;
    std::vector<io::any_piecewise_writer<D>> by_pieces;
    std::vector<const output_format<D>*> in_one_file;
    for (const auto& format : formats_)
      if (format.files)
        by_pieces.push_back(format.files);
      else
        in_one_file.push_back(&format);
    const auto finished =
        io::finish_mesh<D>(mesh, by_pieces, folder, policies_.executor,
                           {.release = in_one_file.empty(), .on_progress = parameters_.on_progress});
    figures_.mesh_hash = finished.hash;
    figures_.quality = finished.quality;
    figures_.peak_rss_bytes =
        std::max(figures_.peak_rss_bytes, static_cast<std::uint64_t>(finished.summary.get("peak_rss_bytes")));
    figures_.details.children.push_back(finished.summary);
    for (const auto* format : in_one_file) {
      show(("writing " + format->name).c_str());
      figures_.details.children.push_back(format->write(mesh, folder, format == in_one_file.back()));
    }
    std::vector<std::string> names;
    for (const report& part : figures_.details.children)
      append_files(part, names);
    figures_.files = read_back(folder, names, policies_.executor);
    figures_.seconds.output = output.seconds();
    if (!formats_.empty())
      figures_.out = options_.out;
  }

  void finish() {
    lines_.reset();
    figures_.seconds.total = clock_.seconds();
    figures_.details.seconds = figures_.seconds.total;
    figures_.peak_rss_bytes = std::max(figures_.peak_rss_bytes, peak_rss_bytes());
    if (!options_.report.empty())
      write_report(figures_, options_.report);
    if (!options_.quiet)
      std::fputs(summary_text(figures_).c_str(), stdout);
  }

  const stopwatch clock_;
  const mesh_options& options_;
  policies_of<D> policies_;
  generate_options parameters_;
  std::vector<output_format<D>> formats_;
  std::optional<terminal_progress> lines_;
  run_figures figures_;
};

} // namespace

int run_mesh(const mesh_options& options) {
  return options.dimension == 3 ? mesh_run<3>(options).run() : mesh_run<2>(options).run();
}

} // namespace dovetail::app
