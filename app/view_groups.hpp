/// @file
/// The groups of a mesh whose own files have none, from the file of its surface beside them.
#pragma once

#include "view_labels.hpp"

#include "dovetail/core/vector.hpp"
#include "dovetail/mesh/simplicial_mesh.hpp"

#include <array>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

namespace dovetail::app {

/// The file `surface.vtp` that `dovetail mesh` writes beside a PVTU file; empty where there is none, and of
/// other files.
std::filesystem::path surface_beside(const std::filesystem::path& mesh);

/// The triangles of that file with their groups.
class surface_groups {
public:
  /// No triangles where there is no such file, or none that can be read.
  static surface_groups beside(const std::filesystem::path& mesh);

  /// Whether a point of the mesh is in the same place here, or not here at all. O(log points).
  bool agrees(global_id id, vec3 at) const;
  /// Of a triangle by the numbers of its points, in any order: its group, `no_id` where it has none; nothing
  /// where there is no such triangle. O(log triangles).
  std::optional<local_id> group_of(std::array<global_id, 3> ids) const;
  const tag_names& names() const { return names_; } ///< of the groups

private:
  static surface_groups read(const std::filesystem::path& file);

  std::vector<std::pair<global_id, vec3>> points_;                       ///< in the order of their numbers
  std::vector<std::pair<std::array<global_id, 3>, local_id>> triangles_; ///< numbers ascending; in order
  tag_names names_;
};

} // namespace dovetail::app
