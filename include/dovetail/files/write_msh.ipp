/// @file
/// What `write_msh.hpp` declares.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/core/output_file.hpp"
#include "dovetail/files/mesh_document.hpp"
#include "dovetail/files/msh_encoder.hpp"
#include "dovetail/files/write_msh.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::io {

namespace detail {

/// The elements of one dimension that have one tag and one subdomain: an entity of an MSH file.
struct tagged_part {
  std::vector<local_id> points; ///< that no part before uses
  std::vector<local_id> elements;
  box3 box;
};

using part_key = std::array<local_id, 3>; ///< dimension, tag, and subdomain or no_id

/// Sorts elements into parts. Points without elements go with the first part, so that none is lost.
class part_sorter {
public:
  explicit part_sorter(std::span<const vec3> points) : points_(points), filed_(points.size(), false) {}

  template <std::size_t N>
  void add(std::span<const std::array<local_id, N>> elements, std::span<const local_id> tags,
           std::span<const local_id> subdomains) {
    for (std::size_t e = 0; e < elements.size(); ++e) {
      const auto tag = tags.empty() ? 0 : tags[e];
      if (tag < 0)
        throw mesh_error("element " + std::to_string(e) + " has a negative tag");
      auto& part = parts_[{static_cast<local_id>(N) - 1, tag, subdomains.empty() ? no_id : subdomains[e]}];
      part.elements.push_back(static_cast<local_id>(e));
      for (const auto v : elements[e]) {
        part.box.include(points_[v]);
        if (!filed_[v])
          part.points.push_back(v);
        filed_[v] = true;
      }
    }
  }
  std::map<part_key, tagged_part> take() {
    if (!parts_.empty())
      for (std::size_t v = 0; v < filed_.size(); ++v)
        if (!filed_[v])
          parts_.begin()->second.points.push_back(static_cast<local_id>(v));
    return std::move(parts_);
  }

private:
  std::span<const vec3> points_;
  std::vector<bool> filed_;
  std::map<part_key, tagged_part> parts_;
};

/// The sections of an MSH file in which every part is an entity of its own. Those of a subdomain are parts of
/// the entity that has their tag.
class part_sections {
public:
  part_sections(msh_encoder& out, const mesh_document& mesh) : out_(out), mesh_(mesh) {
    part_sorter sorter(mesh.points);
    sorter.add(mesh.triangles, mesh.groups, {});
    sorter.add(mesh.tetrahedra, mesh.materials, mesh.subdomains);
    parts_ = sorter.take();
    for (const auto& [key, part] : parts_) {
      auto& whole = wholes_[{key[0], key[1]}];
      whole.include(part.box.lower), whole.include(part.box.upper);
      partitions_ = std::max(partitions_, key[2] + 1);
    }
    local_id next = 1;
    for (const auto& [key, part] : parts_)
      next = std::max(next, key[1] + 2);
    for (const auto& [key, part] : parts_)
      numbers_[key] = key[2] == no_id ? key[1] + 1 : next++;
  }

  void entities() {
    out_.begin("Entities");
    counts([](local_id) { return true; }, wholes_);
    for (const auto& [key, box] : wholes_) {
      out_.integer(key[1] + 1);
      describe(key[1], box);
    }
    out_.end("Entities");
    if (partitions_ == 0)
      return;
    out_.begin("PartitionedEntities");
    out_.count(static_cast<std::uint64_t>(partitions_)), out_.line();
    out_.count(0), out_.line(); // no ghosts
    counts([](local_id subdomain) { return subdomain != no_id; }, parts_);
    for (const auto& [key, part] : parts_)
      if (key[2] != no_id) {
        out_.integer(numbers_.at(key));
        out_.integer(key[0]), out_.integer(key[1] + 1); // what it is a part of
        out_.count(1), out_.integer(key[2] + 1);
        describe(key[1], part.box);
      }
    out_.end("PartitionedEntities");
  }
  void nodes() {
    out_.begin("Nodes");
    std::uint64_t least = 1, most = mesh_.points.size();
    if (!mesh_.ids.empty()) {
      least = number(*std::min_element(mesh_.ids.begin(), mesh_.ids.end()));
      most = number(*std::max_element(mesh_.ids.begin(), mesh_.ids.end()));
    }
    totals(parts_.empty() ? 0 : mesh_.points.size(), least, most);
    for (const auto& [key, part] : parts_) {
      head(key, 0, part.points.size());
      for (const auto v : part.points)
        out_.count(node(v)), out_.line();
      for (const auto v : part.points)
        out_.point(mesh_.points[v]), out_.line();
    }
    out_.end("Nodes");
  }
  void elements() {
    const auto count = mesh_.tetrahedra.size() + mesh_.triangles.size();
    out_.begin("Elements");
    totals(count, 1, count);
    for (const auto& [key, part] : parts_) {
      const bool solid = key[0] == 3;
      head(key, static_cast<int>(solid ? msh_type::tetrahedron : msh_type::triangle), part.elements.size());
      for (const auto e : part.elements) {
        const auto at = static_cast<std::size_t>(e);
        if (solid)
          element(at, mesh_.tetrahedra[at]);
        else
          element(mesh_.tetrahedra.size() + at, mesh_.triangles[at]);
      }
    }
    out_.end("Elements");
  }

private:
  static std::uint64_t number(global_id index) { return static_cast<std::uint64_t>(index) + 1; }
  std::uint64_t node(local_id v) const { return number(mesh_.ids.empty() ? v : mesh_.ids[v]); }
  template <std::size_t N>
  void element(std::size_t index, const std::array<local_id, N>& vertices) {
    out_.count(index + 1);
    for (const auto v : vertices)
      out_.count(node(v));
    out_.line();
  }
  /// How many there are of each dimension.
  template <class Wanted, class Parts>
  void counts(const Wanted& wanted, const Parts& parts) {
    std::array<std::size_t, 4> count{};
    for (const auto& [key, part] : parts)
      count[key[0]] += wanted(key.back()) ? 1 : 0;
    for (const std::size_t of_dimension : count)
      out_.count(of_dimension);
    out_.line();
  }
  void describe(local_id tag, const box3& box) {
    out_.point(box.lower), out_.point(box.upper);
    out_.count(1), out_.integer(tag + 1); // its physical group
    out_.count(0);                        // nothing is known to bound it
    out_.line();
  }
  void totals(std::size_t count, std::uint64_t least, std::uint64_t most) {
    out_.count(parts_.size()), out_.count(count), out_.count(least), out_.count(most);
    out_.line();
  }
  void head(const part_key& key, int what, std::size_t count) {
    out_.integer(key[0]), out_.integer(numbers_.at(key)), out_.integer(what), out_.count(count);
    out_.line();
  }

  msh_encoder& out_;
  const mesh_document& mesh_;
  std::map<part_key, tagged_part> parts_;
  std::map<std::array<local_id, 2>, box3> wholes_; ///< by dimension and tag
  std::map<part_key, local_id> numbers_;
  local_id partitions_ = 0;
};

DOVETAIL_INLINE void write_msh_document(const mesh_document& mesh, const std::filesystem::path& path,
                                        bool binary) {
  output_file file(path);
  msh_encoder out(file, binary);
  out.format();
  part_sections sections(out, mesh);
  std::vector<physical_name> groups;
  for (const auto& [tag, name] : mesh.group_names)
    groups.push_back({2, tag + 1, name});
  for (const auto& [tag, name] : mesh.material_names)
    groups.push_back({3, tag + 1, name});
  write_physical_names(file, groups);
  sections.entities();
  sections.nodes();
  sections.elements();
  file.commit();
}

} // namespace detail

} // namespace dovetail::io
