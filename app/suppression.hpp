/// @file
/// The model as it is meshed: without details that are far smaller than the sizes.
#pragma once

#include "model_source.hpp"
#include "options.hpp"
#include "touching_faces.hpp"

#include "dovetail/geometry/error_of_faces.hpp"
#include "dovetail/sizing/kept_details.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace dovetail::app {

/// Takes details of a model away, and gives them back where it cannot be meshed without them.
class suppression {
public:
  /// What the options say is a detail. Throws `command_line_error` for a length that is none.
  suppression(const model_options& options, int dimension);

  /// Takes the details away that are such at the sizes of the source, but for those in thin walls,
  /// where a size is small at one place of many a detail; notes that in its summary. Automatic sizes are made
  /// to fit the details that are left, and larger elsewhere by as much as keeps a wanted number of elements.
  void apply(model_source& source);

  /// Calls what meshes the source's geometry; when that blames faces, with these as they were drawn, and so
  /// on. What is thrown without a face to blame, or when all details are back, is thrown; so are surfaces
  /// that cross where the options say so.
  template <class F>
  auto retried(model_source& source, const F& mesh_it) {
    while (true)
      try {
        return mesh_it();
      } catch (const blames_faces& problem) {
        if ((is_crossing(problem) && options_.crossing_is_told) || !keep(source, problem.faces()))
          throw;
      }
  }

private:
  static constexpr std::size_t most_kept = 40;   ///< faces; beyond, everything stays as it was drawn
  static constexpr int most_joined_to_blame = 4; ///< times; beyond, no face is joined to another

  /// Makes the geometry again; false when nothing of it was simplified.
  bool keep(model_source& source, const std::vector<local_id>& faces);
  /// Whether one of the faces is several of the model as drawn.
  static bool is_joined(const any_geometry& model, const std::vector<local_id>& faces);
  void simplify(model_source& source);
  void fit_sizes(model_source& source) const;
  /// Larger than given by so much as makes room for the elements at details.
  any_sizing size_beside(const detail_fit& fit) const;

  const model_options& options_;
  int dimension_;                        ///< of the elements
  std::optional<any_geometry> as_drawn_; ///< when something was taken away
  any_sizing given_size_;                ///< before it was made to fit
  std::vector<local_id> kept_;
  int joined_to_blame_ = 0; ///< how often joined faces were
};

} // namespace dovetail::app
