#include "view_labels.hpp"

#include <algorithm>
#include <cstddef>

namespace dovetail::app {

void tag_labels::finish(const tag_names& given, const std::string& word) {
  for (auto& [tag, label] : labels_) {
    label = static_cast<local_id>(names_.size());
    const auto named =
        std::find_if(given.begin(), given.end(), [t = tag](const auto& n) { return n.first == t; });
    names_.push_back(named == given.end() ? word + " " + std::to_string(tag) : named->second);
  }
  if (!labels_.empty())
    last_ = *labels_.begin();
}

view_labels labels_of(const std::vector<local_id>& tags, const tag_names& names, const std::string& word) {
  tag_labels known;
  for (const local_id tag : tags)
    known.note(tag);
  known.finish(names, word);
  view_labels labels{known.names(), {}};
  labels.of.reserve(tags.size());
  for (const local_id tag : tags)
    labels.of.push_back(known.label(tag));
  return labels;
}

local_id group_labels::label(std::optional<local_id> tag, bool outer, local_id element) {
  if (tag)
    return label_named(tags_.names()[tags_.label(*tag)]);
  if (!outer)
    return label_named("between pieces");
  const view_labels& materials = scene_.materials;
  if (has_triangles_ || materials.names.size() < 2)
    return label_named(has_triangles_ ? "without a group" : "surface");
  const local_id material = materials.of[element];
  return label_named("surface of " + materials.names[material]);
}

local_id group_labels::label_named(const std::string& name) {
  const auto [at, is_new] = labels_.emplace(name, static_cast<local_id>(scene_.groups.names.size()));
  if (is_new)
    scene_.groups.names.push_back(name);
  return at->second;
}

void group_labels::sort() {
  std::vector<std::string> names = tags_.names();
  names.insert(names.end(), scene_.groups.names.begin(), scene_.groups.names.end());
  std::vector<local_id> label(scene_.groups.names.size(), no_id);
  std::vector<std::string> sorted;
  for (const std::string& name : names)
    if (const auto at = labels_.find(name); at != labels_.end() && label[at->second] == no_id) {
      label[at->second] = static_cast<local_id>(sorted.size());
      sorted.push_back(name);
    }
  for (local_id& of : scene_.groups.of)
    of = label[of];
  scene_.groups.names = std::move(sorted);
}

} // namespace dovetail::app
