/// @file
/// Meshes, improves and checks every subdomain through an executor. Failed ones are tried by the
/// mesher's fallbacks in rounds; those that still fail come back as data.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/policy.hpp"
#include "dovetail/mesher/fallbacks.hpp"
#include "dovetail/meshing/piece_work.hpp"
#include "dovetail/parallel/concepts.hpp"
#include "dovetail/parallel/kept.hpp"
#include "dovetail/sizing/refined_sizing.hpp"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace dovetail {

/// Makes the input of a subdomain; a pure function, called in the worker.
template <int D>
using piece_source = std::function<piece_input<D>(local_id)>;

using subdomain_source = piece_source<3>; ///< where the boundaries of subdomains of tetrahedra come from

/// A subdomain that no attempt could mesh.
struct piece_failure {
  local_id subdomain = no_id;       ///< its number
  std::vector<std::string> reasons; ///< one per attempt, naming the policy unless its worker died
  bool timed_out = false; ///< some attempt reached the wall-clock limit: the mesh may differ next time
  std::size_t crossing_facets = 0; ///< boundary triangles that cross others; known when a file was written
  std::filesystem::path facets;    ///< OFF file of the offending facets, when one was written

  using fields = field_list<&piece_failure::subdomain, &piece_failure::reasons, &piece_failure::timed_out,
                            &piece_failure::crossing_facets, &piece_failure::facets>;
};

/// How subdomains are meshed.
struct meshing_options {
  /// Predicted cost of each subdomain, in any unit; the largest are started first. Empty: in order of number.
  std::vector<double> predicted_cost = {};
  std::vector<local_id> wanted = {}; ///< the subdomains that are meshed, each once; empty: all
  /// The `skeleton_points` of a subdomain's input, called by `load` whenever it is. Empty: `load` asks the
  /// source, so that what that refers to must last as long as the result.
  std::function<std::vector<local_id>(local_id)> skeleton_points = {};
  /// Called with every subdomain of D = 3 that failed on all attempts and the boundary that none could fill,
  /// to keep a record of it, by the process that leads; may be empty.
  std::function<void(piece_failure&, const simplicial_mesh<2>&)> on_failure = {};
  progress on_progress = {}; ///< told how the subdomains come along
};

/// What is counted of meshing.
struct meshing_counts {
  global_id elements = 0;           ///< of all pieces
  global_id inner_points = 0;       ///< of all pieces
  std::size_t reused = 0;           ///< pieces that had been made before
  std::size_t retried = 0;          ///< subdomains whose first attempt failed
  std::size_t failed = 0;           ///< those that no attempt could mesh
  double stops_by_clock = 0;        ///< of pieces that a time limit has left to another attempt
  std::uint64_t peak_rss_bytes = 0; ///< of the largest worker
  double mesher_seconds = 0;        ///< summed over the pieces
  double improver_seconds = 0;      ///< likewise

  using fields = field_list<&meshing_counts::elements, &meshing_counts::inner_points, &meshing_counts::reused,
                            &meshing_counts::retried, &meshing_counts::failed,
                            &meshing_counts::stops_by_clock, &meshing_counts::peak_rss_bytes,
                            &meshing_counts::mesher_seconds, &meshing_counts::improver_seconds>;
};

/// What became of the subdomains.
template <int D>
struct meshed_pieces {
  /// Per subdomain; counts are 0 where it failed, or was not wanted. Of a report only "attempt",
  /// "stops_by_clock", and the seconds, warnings and deviations of its children: counters of mesher and
  /// improver stay with the piece.
  std::vector<piece_summary> pieces;
  std::vector<kept<finished_piece<D>>> finished; ///< per subdomain; none where it failed, or was not wanted
  std::vector<piece_failure> failures;           ///< by growing subdomain
  quality_statistics quality;                    ///< of all pieces together
  /// A finished piece; `io_error` when its file is damaged.
  std::function<simplicial_piece<D>(local_id)> load;
  std::function<void(local_id, const piece_note&)>
      release; ///< of `distributed_simplicial_mesh`, where all ranks see them
  /// The note that was left in place of a piece that was given up.
  std::function<std::optional<piece_note>(local_id)> released;
  report summary; ///< `meshing_counts`
};

using meshing_result = meshed_pieces<3>; ///< that of tetrahedra

/// Throws `usage_error` when no mesher was chosen, or a policy may not run in the executor's threads: what is
/// known before anything is meshed.
/// Constant time.
/// \param mesh_it a mesher of pieces
/// \param improve an improver, or nothing
/// \param run_tasks the executor that they would run in
template <class Mesher, class Improver, executor Executor>
void require_policies(const Mesher& mesh_it, const Improver& improve, const Executor& run_tasks) {
  const std::string why = " must not run in several threads of one process; use worker processes";
  if (!is_given(mesh_it))
    throw usage_error("no mesher was chosen: parameters<>{}.with_mesher(...)");
  if (!runs_in_threads(run_tasks))
    return;
  for (const Mesher& attempt : with_fallbacks(mesh_it))
    if (!policy_traits(attempt).thread_safe)
      throw usage_error(named_policy("mesher", policy_name(attempt)) + why);
  if (!policy_traits(improve).thread_safe)
    throw usage_error(named_policy("improver", policy_name(improve)) + why);
}

namespace detail {

/// The attempts at a piece: so many, each of which makes one from its input and the sizes in it. `so_far` is
/// what is known of the attempts before. Whoever calls it knows no policy, and is not compiled again for
/// each.
template <int D>
struct piece_attempts {
  std::size_t count = 0;
  std::function<finished_piece<D>(std::size_t attempt, const piece_failure& so_far,
                                  const piece_input<D>& input, const any_sizing& size)>
      make = {};
};

/// `mesh_subdomains` by these attempts.
template <int D, executor Executor>
meshed_pieces<D> mesh_in_rounds(std::size_t count, const piece_source<D>& source,
                                const piece_attempts<D>& attempts, const refined_sizing& size,
                                const Executor& run_tasks, const meshing_options& options);

} // namespace detail

/// Meshes subdomains 0 .. count-1. In the worker, right after meshing: the checks of `check_mesher_result`,
/// improvement, the same checks again, and quality. What `run_tasks` has kept (`remembering`) is not made
/// again, whatever its number was then: mesher, improver and plain sizes must be the same as then. A round
/// ends before the next begins, and what it tries depends on its number only, so the result does not
/// depend on the number of workers, nor on whether the run was interrupted and resumed.
///
/// Failed subdomains do not throw. Throws what `require_policies` throws, `usage_error` of a policy that may
/// not run where it is called (one with a child process, in a process with other threads), `io_error` when a
/// finished piece cannot be kept, `sizing_error` when the field gives an unusable size, and `cancelled`.
/// Memory: one piece per worker where pieces are kept on a disk, else the whole mesh.
///
/// An attempt is a task of `run_tasks` and ends at its limit (`clock_watch`).
/// Pieces are left as meshed when `improve` holds nothing. In D = 2 they are subsurfaces.
/// Complexity: that of the mesher and the improver, once per piece and attempt.
/// \param count how many subdomains there are
/// \param source gives the closed boundary of subdomain i, i < count
/// \param mesh_it keeps the boundary it is given
/// \param improve improves a piece inside its boundary; may hold nothing
/// \param size edge lengths wanted, in the units of the model
/// \param run_tasks carries out independent tasks; the result does not depend on it
/// \param options which ones, in which order, and progress
template <int D = 3, boundary_keeping_mesher<D> Mesher, improver<D> Improver, executor Executor>
meshed_pieces<D> mesh_subdomains(std::size_t count, const std::type_identity_t<piece_source<D>>& source,
                                 const Mesher& mesh_it, const Improver& improve, const refined_sizing& size,
                                 const Executor& run_tasks, const meshing_options& options = {}) {
  require_policies(mesh_it, improve, run_tasks);
  const std::vector<Mesher> meshers = with_fallbacks(mesh_it);
  // After the mesher's fallbacks the mesher as it is, without improvement: better a raw piece than none.
  const auto make = [&](std::size_t attempt, const piece_failure& so_far, const piece_input<D>& input,
                        const any_sizing& sizes) {
    const bool has_mesher = attempt < meshers.size();
    return detail::make_piece<D>(so_far.subdomain, input, meshers[has_mesher ? attempt : 0],
                                 has_mesher ? &improve : nullptr, sizes, so_far.reasons, so_far.timed_out);
  };
  const detail::piece_attempts<D> attempts{meshers.size() + (is_given(improve) ? 1 : 0), make};
  return detail::mesh_in_rounds<D>(count, source, attempts, size, run_tasks, options);
}

} // namespace dovetail

#include "dovetail/meshing/subdomain_rounds.hpp"
