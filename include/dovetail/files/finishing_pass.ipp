/// @file
/// What `finishing_pass.hpp` declares.
#pragma once

#include "dovetail/core/encoding.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/fields.hpp"
#include "dovetail/core/hash.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/files/finishing_pass.hpp"
#include "dovetail/mesh/distributed_validity.hpp"
#include "dovetail/mesh/mesh_hash.hpp"
#include "dovetail/mesh/poor_triangles.hpp"
#include "dovetail/parallel/map_tasks.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

namespace dovetail::io {

namespace detail {

/// What a task says of its pieces.
struct finished_pieces {
  mesh_hasher hash;
  quality_statistics quality;
  quality_at_interfaces at_interfaces;
  poor_elements poor;

  using fields = field_list<&finished_pieces::hash, &finished_pieces::quality,
                            &finished_pieces::at_interfaces, &finished_pieces::poor>;
};

/// What a task gives back; that the mesh is none is an error of its own, which the parent throws.
template <class T>
struct finishing_reply {
  T done = {};
  std::optional<std::string> no_mesh = {};

  using fields = field_list<&finishing_reply::done, &finishing_reply::no_mesh>;
};

/// What the files of pieces depend on beside the pieces: the numbers of all points and elements.
inline std::uint64_t hash_of_numbering(const mesh_hasher& skeleton, const global_numbering& numbers) {
  content_hash hash;
  hash.word(skeleton.value());
  for (std::size_t p = 0; p < numbers.first_point.size(); ++p) {
    hash.word(static_cast<std::uint64_t>(numbers.first_point[p]));
    hash.word(static_cast<std::uint64_t>(numbers.first_element[p]));
  }
  return hash.value();
}

template <int D>
class finishing_tasks {
public:
  finishing_tasks(const distributed_simplicial_mesh<D>& mesh, std::vector<piecewise_output<D>> outputs,
                  const unfinished_folder* unfinished, bool release)
      : mesh_(mesh), outputs_(std::move(outputs)), unfinished_(unfinished), numbers_(number_globally(mesh)),
        sides_(mesh), release_(release && mesh.release) {
    hash_skeleton(skeleton_hash_, mesh.skeleton);
    numbering_ = hash_of_numbering(skeleton_hash_, numbers_);
    bounds_.resize(mesh.counts.size() + 1);
    std::iota(bounds_.begin(), bounds_.end(), 0);
    for (const auto& output : outputs_) {
      for (const auto& other : output.others)
        others_.push_back(&other);
      for (const auto& count : output.counts)
        counts_.push_back(&count);
      most_loaded_ = std::max(most_loaded_, output.most_loaded);
      if (output.names.empty())
        continue;
      std::vector<local_id> common;
      std::set_intersection(bounds_.begin(), bounds_.end(), output.bounds.begin(), output.bounds.end(),
                            std::back_inserter(common));
      bounds_ = std::move(common);
    }
  }

  finished_mesh run(const any_executor& run_tasks, const finishing_options& options) {
    std::vector<finished_pieces> found(ranges());
    auto taken = once(run_tasks, [&] { return take_over_all(); });
    std::vector<std::size_t> left; // ranges, and behind them the other files
    for (std::size_t r = 0; r < ranges(); ++r)
      if (taken[r])
        found[r] = *taken[r];
      else
        left.push_back(r);
    finished_mesh result;
    finishing_counts counted{ranges() + others_.size() + counts_.size(), ranges() - left.size()};
    for (std::size_t k = 0; k < others_.size(); ++k)
      left.push_back(ranges() + k);

    run_options tasks;
    tasks.limit_seconds = options.limit_seconds * static_cast<double>(most_pieces());
    tasks.on_progress = options.on_progress;
    tasks.stage = "finishing";
    prepare(run_tasks, tasks);
    tasks.order = largest_first(left);
    const auto done = done_by(
        run_tasks, left, tasks,
        [this](std::size_t task) { return task < ranges() ? name_of(task) : others_[task - ranges()]->name; },
        [this](std::size_t task) {
          if (task < ranges())
            return finish_range(task);
          others_[task - ranges()]->run();
          return finished_pieces{};
        });
    for (std::size_t k = 0; k < left.size(); ++k)
      if (left[k] < ranges())
        found[left[k]] = done[k];
    counted.peak_rss_bytes = peak_rss_bytes_;
    result.summary.set(counted);

    mesh_hasher hash = skeleton_hash_;
    for (const auto& pieces : found) {
      hash.merge(pieces.hash);
      result.quality.merge(pieces.quality, 0);
      result.at_interfaces.merge(pieces.at_interfaces);
      result.poor.merge(pieces.poor);
    }
    result.hash = hash.value();
    return result;
  }

  /// All files are complete before the first gets its final name.
  void finish(const std::filesystem::path& folder, const any_executor& run_tasks, report& summary) const {
    append(summary.children, once(run_tasks, [&] {
             for (const auto& output : outputs_)
               output.complete();
             std::vector<report> said;
             for (const auto& output : outputs_)
               said.push_back(output.finish(folder));
             return said;
           }));
  }

private:
  using numbered_pieces = std::pair<std::uint64_t, finished_pieces>; ///< with the `hash_of_numbering`

  std::size_t ranges() const { return bounds_.size() - 1; }
  std::string name_of(std::size_t range) const {
    const auto [first, last] = std::pair(bounds_[range], bounds_[range + 1] - 1);
    return first == last ? "subdomain " + std::to_string(first)
                         : "subdomains " + std::to_string(first) + " to " + std::to_string(last);
  }
  local_id most_pieces() const {
    local_id most = std::max<local_id>(most_loaded_, 1);
    for (std::size_t r = 0; r < ranges(); ++r)
      most = std::max(most, bounds_[r + 1] - bounds_[r]);
    return most;
  }

  /// What outputs have to know before their files are begun, found by tasks of the outputs one after the
  /// other.
  void prepare(const any_executor& run_tasks, const run_options& options) {
    if (counts_.empty())
      return;
    std::vector<std::size_t> tasks(counts_.size());
    std::iota(tasks.begin(), tasks.end(), std::size_t{0});
    const auto counted = done_by(
        run_tasks, tasks, options, [this](std::size_t task) { return counts_[task]->name; },
        [this](std::size_t task) { return counts_[task]->run(); });
    once(run_tasks, [&] {
      auto next = counted.begin();
      for (const auto& output : outputs_) {
        const auto first = std::exchange(next, next + static_cast<std::ptrdiff_t>(output.counts.size()));
        if (first != next)
          output.prepare({first, next});
      }
    });
  }

  /// Files without pieces, then the ranges of most elements; ties by number.
  std::vector<std::size_t> largest_first(const std::vector<std::size_t>& tasks) const {
    std::vector<std::size_t> order(tasks.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto size = [&](std::size_t k) {
      if (tasks[k] >= ranges())
        return numbers_.elements();
      const auto at = [&](std::size_t bound) { return static_cast<std::size_t>(bounds_[bound]); };
      return numbers_.first_element[at(tasks[k] + 1)] - numbers_.first_element[at(tasks[k])];
    };
    stable_sort_all(order, [&](std::size_t a, std::size_t b) { return size(a) > size(b); });
    return order;
  }

  /// The files of an output that take the pieces of a range.
  std::pair<std::size_t, std::size_t> files_of(const piecewise_output<D>& output, std::size_t range) const {
    const auto at = [&](local_id bound) {
      return static_cast<std::size_t>(std::lower_bound(output.bounds.begin(), output.bounds.end(), bound) -
                                      output.bounds.begin());
    };
    return {at(bounds_[range]), at(bounds_[range + 1])};
  }

  std::string path_of(const piecewise_output<D>& output, std::size_t file) const {
    return (unfinished_->of_writer(static_cast<std::size_t>(&output - outputs_.data())) / output.names[file])
        .string();
  }

  /// Of each range the result, where it is taken over.
  std::vector<std::optional<finished_pieces>> take_over_all() const {
    std::vector<std::optional<finished_pieces>> taken;
    for (std::size_t r = 0; r < ranges(); ++r)
      taken.push_back(take_over(r));
    return taken;
  }
  /// The result of a range whose pieces an earlier run gave up; nothing when there is none.
  std::optional<finished_pieces> take_over(std::size_t range) const {
    if (!mesh_.released)
      return std::nullopt;
    const auto first = mesh_.released(bounds_[range]);
    std::vector<std::string> expected;
    for (const auto& output : outputs_)
      for (auto [f, end] = files_of(output, range); f < end; ++f)
        expected.push_back(path_of(output, f));
    const bool ours = release_ && first && !first->text.empty() &&
                      std::equal(first->files.begin(), first->files.end(), expected.begin(), expected.end(),
                                 [](const auto& file, const auto& path) { return file.path == path; });
    for (local_id p = bounds_[range]; p < bounds_[range + 1]; ++p) {
      const auto note = mesh_.released(p);
      if (note && !ours)
        throw usage_error("subdomain " + std::to_string(p) + " is already in " + note->files.front().path +
                          "; resume with the formats of the earlier run");
      if (!note && ours)
        mesh_.release(p, {first->files, {}});
    }
    if (!ours)
      return std::nullopt;
    const auto [numbering, found] = decoded<numbered_pieces>(first->text);
    if (numbering != numbering_)
      throw usage_error("subdomain " + std::to_string(bounds_[range]) + " is already in " +
                        first->files.front().path +
                        ", with the numbers of another decomposition; run again without resuming");
    return found;
  }

  /// Runs tasks, and gives what each returns; errors of theirs are thrown here.
  template <class Task>
  auto done_by(const any_executor& run_tasks, const std::vector<std::size_t>& tasks,
               const run_options& options, const std::function<std::string(std::size_t)>& name_of_task,
               const Task& run_task) {
    using value = decltype(run_task(0));
    auto results = map_tasks(
        run_tasks, tasks.size(),
        [&](std::size_t k) -> finishing_reply<value> {
          try {
            return {run_task(tasks[k])};
          } catch (const mesh_error& problem) {
            return {{}, problem.what()};
          }
        },
        options);
    std::vector<value> done;
    for (std::size_t k = 0; k < results.size(); ++k) {
      auto& result = results[k];
      if (!result.value)
        throw io_error(name_of_task(tasks[k]) + " could not be written: " + result.failure +
                       (result.crashed
                            ? "; run again from what is kept, with fewer workers where memory is short"
                            : ""));
      if (result.value->no_mesh)
        throw mesh_error(*result.value->no_mesh);
      done.push_back(std::move(result.value->done));
      peak_rss_bytes_ = std::max(peak_rss_bytes_, result.peak_rss_bytes);
    }
    return done;
  }

  /// Runs in the worker, as all below.
  finished_pieces finish_range(std::size_t range) const {
    finished_pieces done;
    piece_note note;
    std::vector<std::size_t> next; // file of each output
    std::vector<piece_file<D>> open(outputs_.size());
    for (const auto& output : outputs_)
      next.push_back(files_of(output, range).first);
    for (local_id p = bounds_[range]; p < bounds_[range + 1]; ++p) {
      const auto piece = load_checked(mesh_, p);
      const auto faults = check_piece<D>(piece, mesh_.skeleton, sides_[p]);
      if (!faults.valid())
        throw mesh_error("the mesh does not conform: " + faults.text());
      const auto at = static_cast<std::size_t>(p);
      const piece_quality quality = quality_of(p, piece);
      done.quality.merge(quality.all, numbers_.first_element[at]);
      done.at_interfaces.merge(*quality.at_interfaces);
      if (quality.all.min_dihedrals.below(D == 3 ? low_dihedral_deg : low_corner_deg) > 0)
        done.poor.merge(find_poor_elements(piece, mesh_.skeleton, sides_[p]));
      hash_piece(done.hash, piece, numbers_);
      for (std::size_t k = 0; k < outputs_.size(); ++k) {
        const auto& output = outputs_[k];
        if (output.names.empty())
          continue;
        if (p == output.bounds[next[k]])
          open[k] = output.open(next[k]);
        open[k].add(piece);
        if (p + 1 < output.bounds[next[k] + 1])
          continue;
        const auto bytes = open[k].close();
        note.files.push_back({path_of(output, next[k]++), bytes});
      }
    }
    if (release_)
      give_up(range, std::move(note), done);
    return done;
  }
  /// As it was measured, and what was not.
  piece_quality quality_of(local_id p, const simplicial_piece<D>& piece) const {
    const auto at = static_cast<std::size_t>(p);
    piece_quality quality =
        at < mesh_.quality.size() ? mesh_.quality[at] : piece_quality{measure_quality(piece.mesh)};
    if (!quality.at_interfaces)
      quality.at_interfaces = measure_at_interfaces(piece, mesh_.skeleton, sides_[p]);
    return quality;
  }
  void give_up(std::size_t range, piece_note note, const finished_pieces& done) const {
    note.text = encoded(numbered_pieces{numbering_, done});
    for (local_id p = bounds_[range]; p < bounds_[range + 1]; ++p) {
      mesh_.release(p, note);
      note.text.clear();
    }
  }

  const distributed_simplicial_mesh<D>& mesh_;
  const std::vector<piecewise_output<D>> outputs_;
  const unfinished_folder* unfinished_; ///< none where nothing is written
  const global_numbering numbers_;
  mesh_hasher skeleton_hash_;
  std::uint64_t numbering_ = 0;
  const sides_by_subdomain<D> sides_;
  const bool release_;
  std::vector<local_id> bounds_; ///< range r has the pieces bounds_[r] .. bounds_[r + 1] - 1
  std::vector<const output_task<void>*> others_;
  std::vector<const output_task<byte_buffer>*> counts_; ///< of all outputs
  local_id most_loaded_ = 0;                            ///< pieces by one of the others
  std::uint64_t peak_rss_bytes_ = 0;                    ///< of the workers so far
};

} // namespace detail

template <int D>
finished_mesh finish_mesh(const distributed_simplicial_mesh<D>& mesh,
                          const std::vector<any_piecewise_writer<D>>& writers,
                          const std::filesystem::path& folder, const any_executor& run_tasks,
                          const finishing_options& options) {
  const stopwatch clock;
  std::optional<unfinished_folder> unfinished;
  if (!writers.empty())
    unfinished.emplace(folder, leads(run_tasks));
  std::vector<piecewise_output<D>> outputs;
  for (const auto& writer : writers) {
    const auto of_writer = unfinished->of_writer(outputs.size());
    make_folder(of_writer);
    outputs.push_back(writer.begin(mesh, of_writer));
  }
  const bool resumable =
      options.release && mesh.release &&
      std::all_of(outputs.begin(), outputs.end(), [](const auto& output) { return output.most_loaded == 0; });
  if (unfinished)
    unfinished->keep(resumable);
  detail::finishing_tasks<D> tasks(mesh, std::move(outputs), unfinished ? &*unfinished : nullptr,
                                   resumable && unfinished);
  finished_mesh result = tasks.run(run_tasks, options);
  tasks.finish(folder, run_tasks, result.summary);
  if (unfinished)
    unfinished->keep(false);
  result.summary.name = "finishing";
  result.summary.seconds = clock.seconds();
  return result;
}

#ifdef DOVETAIL_COMPILED
template finished_mesh finish_mesh<2>(const distributed_simplicial_mesh<2>& mesh,
                                      const std::vector<any_piecewise_writer<2>>& writers,
                                      const std::filesystem::path& folder, const any_executor& run_tasks,
                                      const finishing_options& options);
template finished_mesh finish_mesh<3>(const distributed_simplicial_mesh<3>& mesh,
                                      const std::vector<any_piecewise_writer<3>>& writers,
                                      const std::filesystem::path& folder, const any_executor& run_tasks,
                                      const finishing_options& options);
#endif

} // namespace dovetail::io
