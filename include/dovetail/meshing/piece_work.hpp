/// @file
/// What a worker does for one subdomain: mesh, improve, check and measure.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/failure_reasons.hpp"
#include "dovetail/core/fields.hpp"
#include "dovetail/core/policy.hpp"
#include "dovetail/core/report.hpp"
#include "dovetail/improver/concepts.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"
#include "dovetail/mesh/quality_at_interfaces.hpp"
#include "dovetail/mesher/checks.hpp"
#include "dovetail/mesher/concepts.hpp"
#include "dovetail/mesher/surface_checks.hpp"
#include "dovetail/meshing/piece_improvement.hpp"
#include "dovetail/parallel/kept.hpp"
#include "dovetail/sizing/refined_sizing.hpp"

#include <cstdint>
#include <exception>
#include <new>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

/// What a mesher needs of one subdomain.
template <int D>
struct piece_input {
  mesher_input<D> boundary;                    ///< as a mesher takes it
  std::vector<local_id> skeleton_points;       ///< per boundary point: its index in the fine skeleton
  std::vector<std::uint8_t> on_interface = {}; ///< per boundary point; empty where nobody has looked
  /// What else the piece is a function of: the chords it must not have (D = 2).
  std::vector<std::int64_t> context = {};
};

using subdomain_input = piece_input<3>; ///< that of tetrahedra

/// What is counted of a piece besides what its mesher and improver count.
struct attempt_counts {
  std::size_t attempt = 0;                   ///< 0 unless it failed at first
  std::optional<double> stops_by_clock = {}; ///< of the attempts before, where there were any

  using fields = field_list<&attempt_counts::attempt, &attempt_counts::stops_by_clock>;
};

/// What is known of a finished piece without loading it.
struct piece_summary {
  piece_counts counts;   ///< how large it is
  piece_quality quality; ///< of its elements
  report summary;        ///< `attempt_counts`; children "mesher" and "improver"

  using fields = field_list<&piece_summary::counts, &piece_summary::quality, &piece_summary::summary>;
};

/// A piece as it is kept: without numbers that only the present skeleton gives it.
template <int D>
struct finished_piece {
  piece_summary summary;     ///< what is known of it
  simplicial_piece<D> piece; ///< its points and elements

  using fields = field_list<&finished_piece::summary, &finished_piece::piece>;
};

/// The box in which a piece looks for refined sizes: that of its closed boundary, or of its regions.
inline box3 place_of(const piece_input<3>& input) {
  return box_around(input.boundary.boundary.points);
}
box3 place_of(const piece_input<2>& input);

/// What finished pieces are called where a run keeps them.
inline constexpr const char* name_of_pieces = "piece";

/// The name of the piece of a boundary as the mesher gets it, and of what refines the sizes near it. The
/// numbers of its points in the skeleton are no part of it, since a merge elsewhere changes these.
template <int D>
kept<finished_piece<D>> kept_piece(const piece_input<D>& input, const std::vector<size_ball>& sizes) {
  const mesher_input<D>& boundary = input.boundary;
  std::vector<patch_boundary> outlines;
  std::vector<std::pair<local_id, bool>> faces; // with their turn
  if constexpr (D == 2)
    for (const surface_region& region : boundary.regions) {
      outlines.push_back(region.boundary);
      faces.emplace_back(region.face, region.reversed);
    }
  return kept<finished_piece<D>>::of(D, boundary.material, boundary.boundary.points,
                                     boundary.boundary.elements, input.on_interface, input.context, outlines,
                                     faces, sizes);
}

/// The reasons of failed attempts in one line, equal ones once: "attempts 1, 3: ...; attempt 2: ...".
/// Linear. Throws nothing.
/// \param reasons one per attempt
std::string joined_reasons(const std::vector<std::string>& reasons);

namespace detail {

inline std::string piece_name(local_id subdomain) {
  return "piece_" + std::to_string(subdomain);
}

/// Does a policy's work on a piece, so that what goes wrong in it names the policy. Errors that no other
/// policy can mend stay what they are.
template <class Work>
auto by_policy(const char* role, const std::string& name, const Work& work) {
  try {
    return work();
  } catch (const io_error&) {
    throw;
  } catch (const sizing_error&) {
    throw;
  } catch (const std::exception& e) {
    const bool has_memory = dynamic_cast<const std::bad_alloc*>(&e) == nullptr;
    const std::string what =
        role + (name.empty() ? name : " '" + name + "'") + ": " + (has_memory ? e.what() : out_of_memory);
    if (dynamic_cast<const time_limit_error*>(&e) != nullptr)
      throw time_limit_error(what);
    if (dynamic_cast<const usage_error*>(&e) != nullptr)
      throw usage_error(what);
    throw mesher_error(what);
  }
}

/// Before a mesher is blamed for it: throws `mesher_error` for a boundary that none can fill.
inline void require_boundary(const mesher_input<3>& input) {
  require_enclosing(input.boundary);
}
void require_boundary(const mesher_input<2>& input);

/// Meshes a piece and checks the result before anything else looks at it: an improver might hide what is
/// wrong, or be blamed for it.
template <int D, boundary_keeping_mesher<D> Mesher>
mesher_result<D> mesh_checked(const mesher_input<D>& input, const Mesher& mesh_it, const any_sizing& size) {
  auto made = mesh_it(input, size);
  check_mesher_result(input, made.mesh);
  if constexpr (D == 2)
    if (!made.corner_uv.empty() && made.corner_uv.size() != made.mesh.elements.size())
      throw mesher_error("parameters of " + std::to_string(made.corner_uv.size()) + " triangles for " +
                         std::to_string(made.mesh.elements.size()));
  made.summary.name = "mesher";
  return made;
}

/// Improves a mesh inside its frozen boundary and checks the result again.
template <int D, improver<D> Improver>
report improve_checked(mesher_result<D>& made, const mesher_input<D>& input, const Improver& improve,
                       const any_sizing& size) {
  const stopwatch clock;
  report summary = improve_piece(made, input, improve, size);
  summary.name = "improver";
  summary.seconds = clock.seconds();
  check_mesher_result(input, made.mesh);
  return summary;
}

/// From the boundary of a subdomain to its piece. `failed` are the reasons of the attempts before,
/// and `stopped_by_clock` whether a time limit was among them; the summary keeps both. The piece stays as
/// meshed when `improve` is null, for the last attempt, or holds nothing. Throws what the mesher, the
/// improver and the checks throw, as `mesher_error` that names the policy, or the boundary where that is at
/// fault.
template <int D, boundary_keeping_mesher<D> Mesher, improver<D> Improver>
finished_piece<D> make_piece(local_id subdomain, const piece_input<D>& input, const Mesher& mesh_it,
                             const Improver* improve, const any_sizing& size,
                             const std::vector<std::string>& failed, bool stopped_by_clock) {
  const stopwatch clock;
  require_boundary(input.boundary);
  auto made = by_policy("mesher", policy_name(mesh_it),
                        [&] { return mesh_checked<D>(input.boundary, mesh_it, size); });
  piece_summary summary;
  summary.summary.name = piece_name(subdomain);
  attempt_counts attempt{failed.size()};
  if (stopped_by_clock)
    attempt.stops_by_clock = 1;
  summary.summary.set(attempt);
  summary.summary.children.push_back(std::move(made.summary));
  if (improve != nullptr && is_given(*improve))
    summary.summary.children.push_back(by_policy("improver", policy_name(*improve), [&] {
      return improve_checked<D>(made, input.boundary, *improve, size);
    }));
  if (!failed.empty())
    summary.summary.warnings.push_back((improve != nullptr ? "meshed after " : "left unimproved after ") +
                                       joined_reasons(failed));
  summary.counts.material = input.boundary.material;
  summary.counts.elements = static_cast<global_id>(made.mesh.elements.size());
  summary.counts.inner_points =
      static_cast<global_id>(made.mesh.points.size() - input.boundary.boundary.points.size());
  summary.quality = measure_piece(made.mesh, input.on_interface);
  summary.summary.seconds = clock.seconds();
  return {std::move(summary), {no_id, input.boundary.material, std::move(made.mesh), {}}};
}

} // namespace detail
} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/meshing/piece_work.ipp"
#endif
