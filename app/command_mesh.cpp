#include "commands.hpp"
#include "failure.hpp"
#include "finished_run.hpp"
#include "model_source.hpp"
#include "output.hpp"
#include "output_formats.hpp"
#include "policies.hpp"
#include "rank_partitioner.hpp"
#include "resolved_walls.hpp"
#include "run_figures.hpp"
#include "run_identity.hpp"
#include "run_setup.hpp"
#include "sizes_for_elements.hpp"
#include "stage_figures.hpp"
#include "stop_request.hpp"
#include "suppression.hpp"
#include "terminal_progress.hpp"
#include "touching_faces.hpp"

#include "dovetail/core/bytes.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/distributed/by_elements.hpp"
#include "dovetail/distributed/made_aside.hpp"
#include "dovetail/distributed/processes.hpp"
#include "dovetail/files/finishing_pass.hpp"
#include "dovetail/files/write_trace.hpp"
#include "dovetail/parallel/available_processors.hpp"
#include "dovetail/parallel/checkpointed.hpp"
#include "dovetail/parallel/spool_exchange.hpp"
#include "dovetail/parallel/traced.hpp"
#include "dovetail/pipeline/intersection_counts.hpp"
#include "dovetail/pipeline/model_measure.hpp"
#include "dovetail/solver/second_order.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>

namespace dovetail::app {
namespace {

/// The spool of a run, in the folder of its mesh. Unless there is something in it to resume from, it is
/// removed in the end. A run that failed by itself would meet the same error again: only finished pieces are
/// worth keeping then, since they may have taken long.
class run_spool {
public:
  /// Where it is not `own`, another rank has started it and removes it.
  run_spool(const std::filesystem::path& folder, std::filesystem::path place, const run_identity& identity,
            bool resume, bool own)
      : folder_(folder), place_(std::move(place)),
        spool_(resume ? spool::resume(place_, identity) : spool::start(place_, identity)), own_(own) {}
  run_spool(const run_spool&) = delete;
  run_spool& operator=(const run_spool&) = delete;
  ~run_spool() {
    if (!own_)
      return;
    const kept_work kept = work_kept_in(folder_, place_);
    if (finished_ || !(interrupted_ ? kept.anything : kept.pieces))
      spool_.clear();
  }

  const spool& get() const { return spool_; }
  /// The mesh is written: the pieces are not needed any more.
  void finish() { finished_ = true; }
  /// The run was asked to stop: another one may go on from whatever there is.
  void interrupt() { interrupted_ = true; }

private:
  std::filesystem::path folder_;
  std::filesystem::path place_;
  spool spool_;
  bool own_;
  bool finished_ = false;
  bool interrupted_ = false;
};

std::string name_of(const host& entity, const geometry_topology& topology) {
  const auto id = static_cast<std::size_t>(entity.id);
  const bool is_curve = entity.dimension == 1;
  const std::string& name = is_curve ? topology.curves[id].name : topology.faces[id].name;
  return (is_curve ? "curve " : "face ") + std::to_string(entity.id) +
         (name.empty() ? "" : " (" + name + ")");
}

interface_figures figures_of(const interface_angles& angles, const geometry_topology& topology) {
  interface_figures figures;
  if (angles.interface_faces > 0) {
    figures.min_face_angle_deg = angles.face_angle.measured();
    figures.min_dihedral_deg = angles.min_dihedral().measured();
  }
  const auto count = [&](violation_cause cause) { return static_cast<std::int64_t>(angles.count(cause)); };
  figures.faces = static_cast<std::int64_t>(angles.interface_faces);
  figures.forced = count(violation_cause::forced);
  figures.refused = count(violation_cause::refused);
  figures.remeshing = count(violation_cause::remeshing);
  constexpr std::array<const char*, 3> causes{"forced", "refused", "remeshing"};
  for (const angle_violation& v : angles.violations) {
    figures.below.push_back(
        {v.angle_deg, v.is_dihedral(), causes[static_cast<std::size_t>(v.cause)], v.place, {}});
    for (const host& entity : v.cad)
      figures.below.back().cad.push_back(name_of(entity, topology));
  }
  return figures;
}

void append_files(const report& from, std::vector<std::string>& to) {
  to.insert(to.end(), from.files.begin(), from.files.end());
  for (const auto& part : from.children)
    append_files(part, to);
}

template <int D>
void add_pipeline_figures(const generated<D>& result, const geometry_topology& topology,
                          run_figures& figures) {
  const report& summary = result.summary;
  figures.background_elements = static_cast<std::int64_t>(result.background.elements().elements.size());
  figures.subdomains = static_cast<int>(result.mesh.counts.size());
  figures.of_subdomains = static_cast<std::int64_t>(result.subdomains);
  figures.quality = result.quality;
  figures.interfaces = figures_of(result.fine_angles, topology);
  figures.coarse_interfaces = figures_of(result.coarse_angles, topology);
  for (const report* stage : {&summary.find("skeleton"), &summary.find("meshing")})
    for (const report& part : stage->children)
      if (part.name == "deviation")
        figures.deviation = part;
  figures.failed_subdomains = static_cast<std::int64_t>(result.failures.size());
  const auto intersection = summary.find("intersection").as<intersection_counts>();
  figures.merges = intersection.merges + intersection.merged_after_failure;
  figures.largest_merged = intersection.largest_merged;
  const stage_seconds before = figures.seconds;
  figures.seconds = seconds_of_stages(summary);
  figures.seconds.geometry = before.geometry;
  figures.seconds.scaling = before.scaling;
  figures.peak_rss_bytes =
      std::max(figures.peak_rss_bytes, summary.find("meshing").as<meshing_counts>().peak_rss_bytes);
}

template <int D>
void add_mesh_figures(const distributed_simplicial_mesh<D>& mesh, run_figures& figures) {
  figures.vertices = static_cast<std::int64_t>(mesh.skeleton.points.size());
  for (const auto& piece : mesh.counts)
    figures.vertices += piece.inner_points;
  const piece_figures pieces = figures_of_pieces(mesh.counts);
  figures.elements = pieces.elements;
  figures.imbalance = pieces.imbalance;
  figures.boundary_triangles = 0;
  for (std::size_t s = 0; s < mesh.skeleton.sides.size(); ++s) // without a CAD face: towards a piece not made
    if (mesh.skeleton.subdomains[s][1] == no_id && (D == 2 || mesh.skeleton.side_hosts[s] != no_id))
      ++figures.boundary_triangles;
}

/// One run of `dovetail mesh`.
template <int D>
class mesh_run {
public:
  /// Everything that can be wrong about the options themselves is found before any file is read.
  explicit mesh_run(const mesh_options& options)
      : options_(options), policies_(make_policies_of<D>(options)),
        parameters_(make_generate_options(options)), touching_(options_.model, D),
        suppression_(touching_.options(), D), formats_(make_formats<D>(options)) {
    if (!options_.trace.empty()) {
      trace_.emplace(policies_.executor);
      policies_.executor = any_executor(*trace_, policies_.executor.name());
    }
  }

  int run() {
    if (leads_ && !options_.quiet)
      lines_.emplace(stderr);
    parameters_.on_progress = callbacks();
    parameters_.on_progress("geometry", 0, 0);
    model_source source = touching_.prepared([&] { return prepare(); });
    const run_identity identity = identity_of_run(options_, source);
    for (const auto& [what, value] : identity)
      require_same(what + " " + value);
    std::optional<output_folder> made;
    std::optional<run_spool> store;
    const std::filesystem::path folder = options_.out;
    const finished_run finished(folder, identity, options_);
    const auto begin = once(policies_.executor, [&] {
      made.emplace(options_.out);
      return begin_in(folder, identity, finished, store);
    });
    if (!leads_)
      join(folder, identity, begin, store);
    if (!options_.resume)
      remove_spools_of_waiting(options_);
    if (begin == beginning::is_finished) {
      lines_.reset();
      if (leads_ && !options_.quiet)
        std::printf("The mesh is in %s: this run is finished, nothing is left to do%s\n",
                    options_.out.c_str(), options_.report.empty() ? "" : ", and no report is written");
      return exit_ok;
    }
    const spool disk = has_own_spool() ? store->get().of_one_rank() : store->get();
    policies_.executor =
        any_executor(parallel::checkpointed(policies_.executor, disk), policies_.executor.name());
    if (leads_)
      parameters_.failure_folder = folder / "failed";
    try {
      if (has_own_spool())
        exchange_all_blobs(disk, *options_.network); // those of an earlier run
      make(source, folder, finished);
    } catch (const cancelled&) {
      store->interrupt();
      throw;
    } catch (const communication_error&) {
      store->interrupt();
      throw;
    }
    store->finish();
    remove_spools_of_waiting(options_);
    return exit_ok;
  }

private:
  /// The model and its sizes, as they are meshed.
  model_source prepare() {
    const model_options& wanted = touching_.options();
    const stopwatch clock;
    parameters_.undivided_elements = make_generate_options(options_).undivided_elements; // not of another try
    model_source source = load_model(wanted, D, executor_for_model());
    figures_.seconds.geometry += clock.seconds();
    if (wanted.elements || source.thin_walls) {
      const stopwatch planning;
      resolve_walls(source, wanted, policies_, parameters_);
      scale_to_elements(source, wanted, policies_, parameters_);
      figures_.seconds.scaling += planning.seconds();
    }
    suppression_.apply(source);
    return source;
  }

  enum class beginning : std::uint8_t { is_finished, goes_on };

  /// Throws `usage_error` when this rank starts from something else than the one that leads.
  void require_same(const std::string& mine) const {
    if (const std::string theirs = once(policies_.executor, [&] { return mine; }); mine != theirs)
      throw usage_error("this rank starts from '" + mine + "', and rank 0 from '" + theirs + "'");
  }

  beginning begin_in(const std::filesystem::path& folder, const run_identity& identity,
                     const finished_run& finished, std::optional<run_spool>& store) const {
    const auto place = spool_folder(options_);
    const bool started = spool::is_started(place);
    if (options_.resume && finished.is_there()) {
      if (started) // killed when all was done but this
        run_spool(folder, place, identity, true, true).finish();
      return beginning::is_finished;
    }
    const bool resumes = options_.resume && started;
    if (!resumes)
      io::unfinished_folder::remove(folder);
    store.emplace(folder, place, identity, resumes, true);
    return beginning::goes_on;
  }

  /// Whether the ranks do not see each other's spools.
  bool has_own_spool() const { return options_.network && !options_.spool.empty(); }
  /// On a rank that does not lead.
  void join(const std::filesystem::path& folder, const run_identity& identity, beginning begin,
            std::optional<run_spool>& store) const {
    const auto place = spool_folder(options_);
    const bool own = has_own_spool();
    const bool resumes = !own || (options_.resume && spool::is_started(place));
    if (begin == beginning::goes_on)
      store.emplace(folder, place, identity, resumes, own);
    else if (own && resumes)
      run_spool(folder, place, identity, true, true).finish();
  }

  void make(model_source& source, const std::filesystem::path& folder, const finished_run& finished) {
    std::unique_ptr<made_aside<std::optional<double>>> volume;
    generated<D> result = touching_.meshed(
        source, [&] { return prepare(); },
        [&] {
          volume = volume_aside(source);
          return suppression_.retried(source, [&] { return generate(source, folder); });
        });
    if constexpr (D == 3)
      if (leads_ && source.volume && result.failures.empty() && parameters_.only.empty())
        compare_volume(result.mesh.skeleton, volume ? volume->wait().value_or(std::nullopt) : source.volume(),
                       result.summary);
    describe(source, result);
    if (!result.failures.empty()) {
      finish();
      throw mesher_error(text_of_failures(result.failures));
    }
    if (options_.redistribute == by_elements)
      redistribute_by_elements(result.mesh, source.size);
    if (options_.order == 2)
      add_middles(result.mesh, source);
    write(result.mesh, folder, finished);
    finish();
    if (leads_ && !formats_.empty())
      finished.record(figures_.files, touching_.options().join);
  }

  /// Each rank that computes reads the model by itself, with its own workers.
  any_executor executor_for_model() const {
    if (!options_.network)
      return policies_.executor;
    const int workers = workers_of_rank(options_);
    if (workers == 1 || options_.executor == "serial")
      return parallel::serial{};
    return parallel::processes{.worker_count = workers};
  }

  /// The volume of the model as drawn, which takes as long as a stage. There are stages that leave a
  /// processor free.
  std::unique_ptr<made_aside<std::optional<double>>> volume_aside(const model_source& source) const {
    if (D == 2 || !leads_ || !source.volume || !parameters_.only.empty() || policies_.executor.workers() < 2)
      return {};
    return std::make_unique<made_aside<std::optional<double>>>(source.volume);
  }

  progress callbacks() {
    progress shown = lines_ ? lines_->callbacks() : progress{.stop_requested = stop_was_requested};
    return trace_ ? trace_->watch(std::move(shown)) : shown;
  }

  generated<D> generate(const model_source& source, const std::filesystem::path& folder) {
    if (!options_.force && parameters_.only.empty())
      parameters_.largest_prediction = elements_with_room_everywhere(folder);
    try {
      if constexpr (D == 3)
        if (options_.decomposition == by_bisection || options_.decomposition == by_fine_partition)
          return generate_baseline(source);
      const auto background = make_background_mesh<D>(source.geometry, source.size, policies_, parameters_);
      require_subdomains_for_ranks(background.plan.subdomains, "planned");
      return generate_mesh_from<D>(background, source.geometry, policies_, parameters_);
    } catch (const too_many_elements& problem) {
      throw io_error(folder.string() + ": the sizes predict about " + count_text(problem.predicted) +
                     " elements, and " +
                     (options_.spool.empty() ? "the disk has" : "its disk, or that of --spool, has") +
                     " room for about " + count_text(parameters_.largest_prediction) +
                     "; give larger sizes, or --force to try");
    }
  }

  /// The least of all ranks, whose spools may be on disks of their own.
  double elements_with_room_everywhere(const std::filesystem::path& folder) const {
    const std::filesystem::path own_spool = options_.spool.empty() ? "" : spool_folder(options_);
    any_communicator network = policies_.executor.network();
    const auto of_ranks = network.all_gather(elements_with_room(formats_, folder, own_spool));
    return *std::min_element(of_ranks.begin(), of_ranks.end());
  }

  /// How many subdomains there are is known when they are made.
  generated<3> generate_baseline(const model_source& source) {
    const auto generate_it =
        options_.decomposition == by_bisection ? generate_by_bisection : generate_by_fine_partition;
    generated<3> made = generate_it(source.geometry, source.size, policies_, parameters_);
    require_subdomains_for_ranks(made.plan.subdomains, "made");
    return made;
  }

  void require_subdomains_for_ranks(int subdomains, const char* how) const {
    if (options_.ranks && subdomains < *options_.ranks && options_.redistribute != by_elements)
      throw partition_error("--ranks: " + std::to_string(*options_.ranks) + " are more than the " +
                            std::to_string(subdomains) + " subdomains " + how +
                            "; give --subdomains, or --redistribute " + by_elements);
  }

  void describe(const model_source& source, const generated<D>& result) {
    figures_.dimension = D;
    figures_.model = source.name;
    figures_.decomposition =
        options_.decomposition.empty() ? decomposition_names().front() : options_.decomposition;
    figures_.mesher = policies_.mesher.name();
    figures_.partitioner = policies_.partitioner.name();
    figures_.simplifier = policies_.simplifier.name();
    figures_.improver = policies_.improver.name();
    figures_.executor = policies_.executor.name();
    figures_.background_mesher = policies_.background_mesher.name();
    figures_.surface_mesher = policies_.surface_mesher.name();
    figures_.workers = policies_.executor.workers();
    figures_.only.assign(result.only.begin(), result.only.end());
    add_pipeline_figures(result, source.geometry.topology(), figures_);
    add_mesh_figures(result.mesh, figures_);
    if constexpr (D == 3) // the only one whose memory was measured
      note_sizes(result.mesh);
    figures_.suppressed = source.suppressed;
    figures_.details.name = "mesh";
    figures_.details.children = {source.summary, result.summary};
    figures_.repeatable = stops_by_clock(result.summary) == 0;
    collect_warnings(figures_.details, figures_.warnings);
    warn_of_binding();
  }

  /// Of the rank that writes the report; a batch system starts the others alike.
  void warn_of_binding() {
    const int processors = parallel::available_processors();
    if (options_.network && options_.workers > processors)
      figures_.warnings.push_back("the " + std::to_string(options_.workers) + " workers of a rank have " +
                                  std::to_string(processors) +
                                  " processors: mpirun binds ranks unless it is given --bind-to none");
  }

  void note_sizes(const distributed_simplicial_mesh<D>& mesh) {
    sizes_ = {static_cast<double>(figures_.background_elements),
              static_cast<double>(mesh.skeleton.sides.size()), 0};
    for (const piece_counts& piece : mesh.counts)
      sizes_.largest_piece = std::max(sizes_.largest_piece, static_cast<double>(piece.elements));
  }

  void add_middles(distributed_simplicial_mesh<D>& mesh, const model_source& source) {
    const report found = io::add_mid_nodes(mesh, source.geometry, policies_.executor,
                                           {.on_progress = parameters_.on_progress});
    collect_warnings(found, figures_.warnings);
    figures_.details.children.push_back(found);
  }

  /// Makes the pieces of the ranks, of which the files are written then.
  void redistribute_by_elements(distributed_simplicial_mesh<D>& mesh,
                                [[maybe_unused]] const any_sizing& size) {
    const stopwatch clock;
    parameters_.on_progress("redistributing elements", 0, 0);
    const auto given = redistribution_by::elements{
        .partitioner =
            make_rank_partitioner(options_.rank_partitioner, policies_.partitioner, options_.partition_desk),
        .simplify_by = policies_.simplifier,
        .run_tasks = policies_.executor,
        .on_progress = parameters_.on_progress}(mesh, *options_.ranks);
    mesh = *given.mesh;
    figures_.seconds.redistribution = clock.seconds();
    collect_warnings(given.summary, figures_.warnings);
    std::vector<local_id> ranks = given.rank_of_piece;
    if constexpr (D == 3)
      if (const auto strategy = make_improving_strategy(improvement_of_ranks(options_, D))) {
        auto improved = strategy(mesh, policies_.improver, size, policies_.executor,
                                 {.on_progress = parameters_.on_progress});
        add_passes(improved.summary, figures_);
        mesh = std::move(improved.mesh);
        ranks.clear();
        for (const local_id p : improved.piece_before)
          ranks.push_back(given.rank_of_piece[p]);
        figures_.details.children.push_back(std::move(improved.summary));
        add_mesh_figures(mesh, figures_);
      }
    const auto known = [ranks, given](const distributed_simplicial_mesh<D>&, int) {
      return redistribution<D>{ranks, given.summary, {}};
    };
    formats_ = make_formats<D>(options_, {known, by_elements});
    if (formats_.empty()) // else the report of their files has it
      figures_.details.children.push_back(given.summary);
  }

  void write(const distributed_simplicial_mesh<D>& mesh, const std::filesystem::path& folder,
             const finished_run& record) {
    const stopwatch output;
    std::vector<io::any_piecewise_writer<D>> writers;
    for (const auto& format : formats_)
      writers.push_back(format.writer);
    if (!writers.empty())
      once(policies_.executor, [&] { record.forget(); }); // before any rank replaces a file
    const auto finished = io::finish_mesh<D>(mesh, writers, folder, policies_.executor,
                                             {.release = true, .on_progress = parameters_.on_progress});
    figures_.mesh_hash = finished.hash;
    figures_.quality = finished.quality;
    figures_.at_interfaces = finished.at_interfaces;
    figures_.poor = finished.poor;
    warn_of_narrow_places();
    warn_of_many_bad();
    figures_.peak_rss_bytes = std::max(figures_.peak_rss_bytes,
                                       finished.summary.template as<io::finishing_counts>().peak_rss_bytes);
    figures_.details.children.push_back(finished.summary);
    std::vector<std::string> names;
    for (const report& part : figures_.details.children)
      append_files(part, names);
    read_back_files(folder, names, record);
    figures_.seconds.output += output.seconds();
    if (!formats_.empty())
      figures_.out = options_.out;
  }

  /// Walls in D = 3, faces in D = 2.
  void warn_of_narrow_places() {
    const auto& poor = figures_.poor;
    const auto bad = poor.bad_by(poor_cause::thin_wall);
    if (bad == 0)
      return;
    const std::string where =
        std::isfinite(poor.thinnest_wall)
            ? (D == 3 ? "; the thinnest is " : "; the narrowest is ") + number_text(poor.thinnest_wall, 3) +
                  (D == 3 ? " thick at " : " wide at ") + place_text(poor.thinnest_place)
            : "";
    const char* elements =
        D == 3 ? (bad == 1 ? " tetrahedron" : " tetrahedra") : (bad == 1 ? " triangle" : " triangles");
    figures_.warnings.push_back(
        std::to_string(bad) + elements + " under " + std::to_string(limits_of(D).bad) +
        (bad == 1 ? " degrees is in " : " degrees are in ") + (D == 3 ? "walls thinner" : "faces narrower") +
        " than the size" + where + ": smaller sizes there put more elements across, except where " +
        (D == 3 ? "a wall ends in an edge" : "a face ends in a point"));
  }

  /// Where they are many, whatever the cause; walls and narrow faces are told of anyway.
  void warn_of_many_bad() {
    constexpr double many = 0.01;
    const auto& bad = figures_.poor.bad;
    const auto all = std::accumulate(bad.begin(), bad.end(), std::int64_t{0});
    const auto cause = static_cast<poor_cause>(std::max_element(bad.begin(), bad.end()) - bad.begin());
    if (all == 0 || static_cast<double>(all) < many * static_cast<double>(figures_.elements) ||
        cause == poor_cause::thin_wall)
      return;
    figures_.warnings.push_back(std::to_string(all) + " of " + std::to_string(figures_.elements) +
                                (D == 3 ? " tetrahedra" : " triangles") + " are under " +
                                std::to_string(limits_of(D).bad) + " degrees; the cause of most is '" +
                                std::string(name_of_cause(cause, D)) + "'");
  }

  /// The mesh is complete before: who stops this or kills it loses the checksums only.
  void read_back_files(const std::filesystem::path& folder, const std::vector<std::string>& names,
                       const finished_run& record) {
    if (names.empty())
      return;
    std::vector<written_file> files;
    std::error_code missing; // which is found when it is read
    for (const auto& name : names)
      files.push_back({name, std::filesystem::file_size(folder / name, missing), {}});
    if (leads_)
      record.record(files, touching_.options().join);
    try {
      figures_.files = read_back(folder, names, policies_.executor, parameters_.on_progress);
    } catch (const cancelled&) {
      throw;
    } catch (...) { // what cannot be read is not finished
      if (leads_)
        record.forget();
      throw;
    }
  }

  /// Of the largest of the computing processes.
  std::uint64_t peak_of_ranks() const {
    std::uint64_t peak = peak_rss_bytes();
    if (!options_.network)
      return peak;
    auto network = *options_.network;
    const auto of_ranks = network.all_gather(peak);
    return *std::max_element(of_ranks.begin(), of_ranks.end());
  }

  void write_trace() const {
    execution_trace trace = trace_->trace();
    trace.elements = static_cast<double>(figures_.elements);
    trace.sizes = sizes_;
    trace.subject = figures_.model + (D == 2 ? ", --dimension 2" : "");
    io::write_trace(trace, options_.trace);
  }

  void finish() {
    parameters_.on_progress = {}; // of the lines
    lines_.reset();
    figures_.seconds.total = clock_.seconds();
    figures_.details.seconds = figures_.seconds.total;
    figures_.peak_rss_bytes = std::max(figures_.peak_rss_bytes, peak_of_ranks());
    if (leads_ && !options_.report.empty())
      write_report(figures_, options_.report);
    if (leads_ && trace_)
      write_trace();
    if (leads_ && !options_.quiet)
      std::fputs(summary_text(figures_).c_str(), stdout);
  }

  const stopwatch clock_;
  const mesh_options& options_;
  policies_of<D> policies_;
  std::optional<parallel::traced> trace_;
  const bool leads_ = leads(policies_.executor);
  generate_options parameters_;
  touching_faces touching_;
  suppression suppression_;
  std::vector<output_format<D>> formats_;
  std::optional<terminal_progress> lines_;
  run_figures figures_;
  mesh_sizes sizes_; ///< while the mesh was made
};

} // namespace

int run_mesh(const mesh_options& options) {
  try {
    return options.dimension == 3 ? mesh_run<3>(options).run() : mesh_run<2>(options).run();
  } catch (const cancelled&) {
  } catch (const communication_error&) { // a rank that was asked to stop too may have gone first
    if (!stop_was_requested())
      throw;
  }
  return say_stopped(options);
}

int say_stopped(const mesh_options& options) {
  complain(stopped_line(work_kept_in(options.out, spool_folder(options)).anything));
  return exit_stopped;
}

} // namespace dovetail::app
