/// @file
/// What is seen of a mesh in several files, of which one at a time is in memory.
#pragma once

#include "view_labels.hpp"
#include "view_sample.hpp"
#include "view_scene.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace dovetail::app {

/// The scene has the sides that `scene_of` has for the whole mesh, in the same order, but of the elements
/// only those asked for; and groups of the surface from the file beside a mesh without any.
class view_pieces {
public:
  /// Reads all pieces: the scene gets the elements of a page with at most `most` triangles. Nothing where the
  /// files cannot be read one by one. Memory: a piece, the sides seen and those around pieces, and thrice the
  /// elements kept. Throws `input_error`.
  /// \param most 0: no elements
  static std::optional<view_pieces> read(const std::filesystem::path& mesh, std::int64_t most);

  /// Reads all pieces again: the scene has those elements instead for which `wanted(angle, corners)`, or the
  /// worst `most` of them.
  /// \param apart how far pieces are moved, over their distance from the middle
  /// \return how many are wanted
  std::size_t take_elements(double apart, std::size_t most,
                            const std::function<bool(float, const std::array<vec3, 4>&)>& wanted);

  view_scene scene;
  std::string elsewhere; ///< in words, that these are parts of a larger mesh; empty: they are not

private:
  /// In place of those that the scene has.
  void set_elements(std::span<const lone_element> elements, std::vector<simplex<3>> vertices);

  std::filesystem::path mesh_;
  tag_labels pieces_; ///< by what the files have: subdomains, else materials
  tag_labels materials_;
  bool has_subdomains_ = false;
};

} // namespace dovetail::app
