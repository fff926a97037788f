/// @file
/// What all improvers that call a library have in common: they get one material at a time, and whatever they
/// return is checked before it replaces anything.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/predicates.hpp"
#include "dovetail/improver/concepts.hpp"
#include "dovetail/mesh/quality.hpp"

#include <cstddef>
#include <exception>
#include <map>
#include <string>
#include <vector>

namespace dovetail::improvement {

/// The elements of one tag: a mesh whose first points are those that may not move, with its boundary.
struct library_piece {
  simplicial_mesh<3> mesh;              ///< without tags
  std::size_t fixed_points = 0;         ///< points [0, fixed_points) may not move
  std::size_t needed_points = 0;        ///< with fewer, a number before one that may not change had no point
  std::vector<simplex<2>> boundary;     ///< sides with one element, oriented outwards
  std::vector<local_id> point_in_whole; ///< per fixed point: its number in the whole mesh
};

namespace detail {

/// Why the library's result may not replace the piece; empty when it may. `frozen_sides` are the piece's.
std::string fault_of(const library_piece& piece, simplicial_mesh<3>& made,
                     const std::vector<simplex<2>>& frozen_sides);

/// Cuts the best shaped elements of a mesh at their centroids until it has `count` points.
/// O((points + elements) log(elements)).
void add_centroids(simplicial_mesh<3>& mesh, std::size_t count);

/// Mean length of the edges of the elements of a mesh; 0 when it has none.
double mean_edge_length(const simplicial_mesh<3>& mesh);

/// Cuts a mesh into pieces by tag and puts improved pieces together again.
class piece_cutter {
public:
  piece_cutter(const simplicial_mesh<3>& mesh, const frozen_entities<3>& frozen);

  /// The elements of each tag.
  const std::map<local_id, std::vector<local_id>>& elements_of() const { return elements_of_; }

  library_piece cut(const std::vector<local_id>& elements);
  /// Frozen sides of the piece that was cut last, sorted. (Three points of a piece can be a side of another
  /// one only on their interface, which is a side of both.)
  const std::vector<simplex<2>>& frozen_sides() const { return frozen_sides_; }

  void add(local_id tag, const library_piece& piece, const simplicial_mesh<3>& made);
  simplicial_mesh<3> result();

private:
  local_id tag(std::size_t e) const { return mesh_.tags.empty() ? 0 : mesh_.tags[e]; }
  void fix(const simplex<2>& side) {
    for (const local_id v : side)
      is_fixed_[v] = true;
  }

  const simplicial_mesh<3>& mesh_;
  const frozen_entities<3>& frozen_;
  std::vector<bool> is_fixed_;
  std::size_t last_fixed_ = 0; ///< points of a higher number are free
  std::vector<local_id> new_id_;
  std::map<local_id, std::vector<local_id>> elements_of_;
  std::vector<simplex<2>> frozen_sides_;
  std::vector<vec3> free_points_;
  std::vector<simplex<3>> elements_;
  std::vector<local_id> tags_;
};

void report_quality(report& to, const std::string& when, const quality_statistics& quality);

} // namespace detail

/// Lets a library improve each piece of a mesh: `improve_piece(const library_piece&)` returns the piece's new
/// points and elements in any order of points, or throws. Where it has fewer points than must be numbered,
/// some elements are cut at their centroids. A piece is left as it was, with a warning in the report, when
/// that fails, moves something fixed, is no valid mesh or has a worse worst element. Throws `mesh_error` when
/// the input is not a mesh or a frozen side is not in it.
template <class ImprovePiece>
report improve_by_library(const std::string& name, simplicial_mesh<3>& mesh, const frozen_entities<3>& frozen,
                          const ImprovePiece& improve_piece) {
  const stopwatch total;
  report result;
  result.name = "improver";
  detail::piece_cutter cutter(mesh, frozen);
  detail::report_quality(result, "before", measure_quality(mesh));
  double seconds = 0;
  std::size_t kept = 0;
  for (const auto& [tag, elements] : cutter.elements_of()) {
    const library_piece piece = cutter.cut(elements);
    simplicial_mesh<3> made;
    std::string fault;
    const stopwatch clock;
    try {
      made = improve_piece(piece);
      seconds += clock.seconds();
      fault = detail::fault_of(piece, made, cutter.frozen_sides());
    } catch (const usage_error&) {
      throw;
    } catch (const time_limit_error& stop) {
      fault = stop.what();
      result.add("stops_by_clock", 1);
    } catch (const std::exception& failure) {
      fault = failure.what();
    }
    if (!fault.empty()) {
      result.warnings.push_back("the result of " + name + " for elements of tag " + std::to_string(tag) +
                                " was not used: " + fault);
      ++kept;
    }
    cutter.add(tag, piece, fault.empty() ? made : piece.mesh);
  }
  if (kept < cutter.elements_of().size())
    mesh = cutter.result();
  result.set("pieces", static_cast<double>(cutter.elements_of().size()));
  result.set("pieces left as they were", static_cast<double>(kept));
  result.set("library seconds", seconds);
  detail::report_quality(result, "after", measure_quality(mesh));
  result.seconds = total.seconds();
  return result;
}

} // namespace dovetail::improvement

#ifndef DOVETAIL_COMPILED
#include "dovetail/adapters/library_pieces.ipp"
#endif
