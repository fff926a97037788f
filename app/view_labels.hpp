/// @file
/// Names for the tags of a mesh, and for groups of its sides.
#pragma once

#include "view_scene.hpp"

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::app {

using tag_names = std::vector<std::pair<local_id, std::string>>;

/// Tags as labels, in the order of the tags.
class tag_labels {
public:
  /// There is one more thing with a tag.
  void note(local_id tag) {
    if (labels_.empty() || tag != last_.first) // which is mostly that of the thing before
      last_ = *labels_.emplace(tag, 0).first;
  }
  /// When all tags are known: those without a name become "word tag".
  void finish(const tag_names& given, const std::string& word);
  /// Of a tag that was noted.
  local_id label(local_id tag) {
    if (tag != last_.first)
      last_ = *labels_.find(tag);
    return last_.second;
  }
  const std::vector<std::string>& names() const { return names_; }

private:
  std::map<local_id, local_id> labels_;
  std::pair<local_id, local_id> last_{};
  std::vector<std::string> names_; ///< by label
};

/// The labels of many things at once.
view_labels labels_of(const std::vector<local_id>& tags, const tag_names& names, const std::string& word);

/// Gives the triangles of a scene their groups: tags of the file have their names, other sides get new ones.
class group_labels {
public:
  /// \param scene whose materials are known
  /// \param tags of the triangles of the file, finished
  /// \param has_triangles whether the file has any
  group_labels(view_scene& scene, tag_labels tags, bool has_triangles)
      : scene_(scene), tags_(std::move(tags)), has_triangles_(has_triangles) {}

  /// The next triangle of the scene.
  void add(std::optional<local_id> tag, bool outer, local_id element) {
    scene_.groups.of.push_back(label(tag, outer, element));
  }
  /// Puts the labels into the order of the tags, with the others after them.
  void sort();

private:
  local_id label(std::optional<local_id> tag, bool outer, local_id element);
  local_id label_named(const std::string& name);

  view_scene& scene_;
  tag_labels tags_;
  std::map<std::string, local_id> labels_;
  bool has_triangles_;
};

} // namespace dovetail::app
