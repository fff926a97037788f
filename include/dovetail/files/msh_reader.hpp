/// @file
/// Reads Gmsh's MSH files, versions 2.2 and 4.1, text and binary.
#pragma once

#include "dovetail/core/input_file.hpp"
#include "dovetail/core/number_text.hpp"
#include "dovetail/files/msh_decoder.hpp"
#include "dovetail/mesh/loaded_mesh.hpp"
#include "dovetail/mesh/quadratic_element.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dovetail::io {

namespace detail {

/// What an MSH file says about an entity.
struct msh_entity_tags {
  local_id physical = 0;  ///< its first physical group, or 0
  local_id partition = 0; ///< the first partition of a partitioned entity, or 0
  bool is_inside = false; ///< whether it is in an entity of a higher dimension, as those between partitions
};

/// Collects the sections of one file. Node numbers are translated at the end, since sections may come in any
/// order.
class msh_parser {
public:
  msh_parser(std::string_view content, const std::string& name, element_order elements)
      : at_(content, name), in_(at_), elements_(elements) {}

  loaded_mesh parse() {
    read_format();
    for (at_.skip_space(); !at_.at_end(); at_.skip_space())
      read_section();
    if (!has_nodes_ || !has_elements_)
      at_.fail(has_nodes_ ? "there is no section $Elements" : "there is no section $Nodes");
    translate_nodes();
    note_parts();
    return std::move(mesh_);
  }

private:
  void read_format() {
    at_.skip_space();
    if (at_.word() != "$MeshFormat")
      at_.fail("this is not an MSH file: it does not start with $MeshFormat");
    version_ = at_.number<double>();
    const auto kind = at_.number<int>();
    const auto size = at_.number<int>();
    if (version_ != 2.2 && version_ != 4.1)
      at_.fail("MSH version " + number_text(version_) + (version_ == std::floor(version_) ? ".0" : "") +
               " is not supported; save the mesh as version 4.1 or 2.2");
    if ((kind != 0 && kind != 1) || size != 8)
      at_.fail("the format line is damaged");
    in_.binary = kind == 1;
    if (in_.binary) {
      at_.line();
      const auto one = at_.raw<std::int32_t>();
      if (one != 1 && byte_swapped(one) != 1)
        at_.fail("the byte order is unclear: the number after the format line is not 1");
      in_.swapped = one != 1;
    }
    expect("$EndMeshFormat");
  }
  void expect(std::string_view word) {
    if (const auto found = at_.word(); found != word)
      at_.fail("\"" + std::string(word) + "\" is expected");
  }

  void read_section() {
    const auto word = at_.word();
    if (!word.starts_with('$'))
      at_.fail("a section is expected");
    const auto section = std::string(word.substr(1));
    if (in_.binary && section != "PhysicalNames" && section != "Comments")
      at_.line(); // binary data start behind the end of the line
    if (section == "PhysicalNames")
      read_names();
    else if (section == "Entities" && is_4())
      read_entities(false);
    else if (section == "PartitionedEntities" && is_4())
      read_entities(true);
    else if (section == "Nodes")
      is_4() ? read_nodes_4() : read_nodes_2();
    else if (section == "Elements")
      is_4() ? read_elements_4() : read_elements_2();
    else if (section == "NodeData")
      read_node_data();
    else
      return skip_section(section);
    expect("$End" + section);
  }
  bool is_4() const { return version_ == 4.1; }
  void skip_section(const std::string& section) {
    if (section != "Comments" && section != "GhostElements" && mesh_.passed_over.size() < most_point_arrays)
      mesh_.pass_over("the section $" + section.substr(0, 40));
    const auto end = "$End" + section;
    const auto found = at_.rest().find(end);
    if (found == std::string_view::npos)
      at_.fail("the file ends early: " + end + " is missing");
    at_.skip(found + end.size());
  }

  void read_names() {
    const auto count = at_.number<std::uint32_t>();
    for (std::uint32_t i = 0; i < count; ++i) {
      const auto dimension = at_.number<int>();
      const auto tag = at_.number<local_id>();
      const auto text = at_.line();
      const auto first = text.find('"');
      const auto last = text.rfind('"');
      if (first == std::string_view::npos || last == first)
        at_.fail("the name of a physical group is not in quotes");
      if (dimension == 2 || dimension == 3)
        (dimension == 3 ? mesh_.material_names : mesh_.triangle_names)
            .emplace_back(tag_of(tag), std::string(text.substr(first + 1, last - first - 1)));
    }
  }

  void read_entities(bool partitioned) {
    if (partitioned) {
      constexpr auto most = static_cast<std::uint64_t>(std::numeric_limits<local_id>::max());
      mesh_.parts = static_cast<local_id>(std::min(in_.count(), most));
      for (auto ghosts = in_.count_of(8); ghosts > 0; --ghosts) {
        ghosts_.insert(in_.integer());
        in_.integer(); // the partition that has them
      }
    }
    std::array<std::size_t, 4> counts;
    for (auto& count : counts)
      count = in_.count_of(8);
    for (int dimension = 0; dimension < 4; ++dimension)
      for (std::size_t i = 0; i < counts[dimension]; ++i) {
        const auto tag = in_.integer();
        auto& entity = entities_[{dimension, tag}];
        if (partitioned) {
          entity.is_inside = in_.integer() > dimension; // the dimension of the parent
          in_.integer();                                // its tag
          const auto partitions = read_integers();
          entity.partition = partitions.empty() ? 0 : partitions.front();
        }
        for (int k = 0; k < (dimension == 0 ? 3 : 6); ++k)
          in_.real();
        const auto physicals = read_integers();
        entity.physical = physicals.empty() ? 0 : physicals.front();
        if (physicals.size() > 1 && dimension > 1)
          mesh_.pass_over("all but the first group of what is in several");
        if (dimension > 0)
          read_integers(); // what bounds it
      }
  }
  std::vector<std::int32_t> read_integers() {
    std::vector<std::int32_t> values(in_.count_of(4));
    for (auto& value : values)
      value = in_.integer();
    return values;
  }

  void read_nodes_4() {
    has_nodes_ = true;
    const auto blocks = in_.count_of(20);
    in_.count(), in_.count(), in_.count(); // total, smallest and largest number
    for (std::size_t b = 0; b < blocks; ++b) {
      const auto dimension = in_.integer();
      in_.integer();
      const bool parametric = in_.integer() != 0;
      const auto count = in_.count_of(32);
      for (std::size_t i = 0; i < count; ++i)
        numbers_.push_back(in_.count());
      for (std::size_t i = 0; i < count; ++i) {
        mesh_.mesh.points.push_back(in_.point());
        for (int k = 0; parametric && k < dimension; ++k)
          in_.real();
      }
    }
  }
  void read_elements_4() {
    has_elements_ = true;
    const auto blocks = in_.count_of(20);
    in_.count(), in_.count(), in_.count();
    for (std::size_t b = 0; b < blocks; ++b) {
      const auto dimension = in_.integer();
      const auto tag = in_.integer();
      const auto type = in_.integer();
      const auto nodes = msh_node_count(type, elements_);
      const auto count = in_.count_of(8 * (1 + nodes));
      if (nodes == 0 && count > 0)
        refuse(type);
      const auto found = entities_.find({dimension, tag});
      const auto entity = found == entities_.end() ? msh_entity_tags{} : found->second;
      const bool of_others = found == entities_.end() && ghosts_.contains(tag);
      const bool between_parts =
          dimension == 2 && entity.is_inside; // whatever its group: Gmsh has the parent's
      if (count > 0 && entity.partition > 0)
        parts_with_elements_[dimension].insert(entity.partition - 1);
      for (std::size_t i = 0; i < count; ++i) {
        in_.count();
        node_numbers vertices{};
        for (std::size_t k = 0; k < nodes; ++k)
          vertices[k] = in_.count();
        if (!of_others && !between_parts)
          add_element(type, vertices, entity.physical != 0 ? entity.physical : tag, entity.partition);
      }
    }
  }

  void read_nodes_2() {
    has_nodes_ = true;
    const auto count = at_.plausible(at_.number<std::uint64_t>(), in_.binary ? 28 : 8);
    if (in_.binary)
      at_.line();
    for (std::size_t i = 0; i < count; ++i) {
      numbers_.push_back(unsigned_of(in_.integer()));
      mesh_.mesh.points.push_back(in_.point());
    }
  }
  void read_elements_2() {
    has_elements_ = true;
    const auto count = at_.plausible(at_.number<std::uint64_t>(), in_.binary ? 8 : 4);
    if (in_.binary)
      at_.line();
    for (std::size_t read = 0; read < count;) {
      if (!in_.binary)
        in_.integer(); // the element's number
      const auto type = in_.integer();
      const auto nodes = msh_node_count(type, elements_);
      if (nodes == 0)
        refuse(type);
      const auto in_block = in_.binary ? in_.integer() : 1;
      const auto tags = in_.integer();
      if (in_block < 1 || tags < 0 || tags > 1000)
        at_.fail("an element's description is damaged");
      for (std::int32_t i = 0; i < in_block; ++i, ++read) {
        if (in_.binary)
          in_.integer();
        add_element_2(type, nodes, tags);
      }
    }
  }
  /// Tags: physical group, entity, number of partitions, partitions.
  void add_element_2(int type, std::size_t nodes, std::int32_t tags) {
    local_id physical = 0, entity = 0, partition = 0;
    for (std::int32_t t = 0; t < tags; ++t) {
      const auto value = in_.integer();
      if (t == 0)
        physical = value;
      else if (t == 1)
        entity = value;
      else if (t == 3)
        partition = std::abs(value);
    }
    node_numbers vertices{};
    for (std::size_t k = 0; k < nodes; ++k)
      vertices[k] = unsigned_of(in_.integer());
    add_element(type, vertices, physical != 0 ? physical : entity, partition);
  }
  std::uint64_t unsigned_of(std::int32_t value) {
    if (value < 0)
      at_.fail("a node has a negative number");
    return static_cast<std::uint64_t>(value);
  }

  /// Groups and entities count from 1 in MSH files, tags from 0.
  static local_id tag_of(local_id number) { return number > 0 ? number - 1 : 0; }

  [[noreturn]] void refuse(int type) {
    at_.fail("there are elements of type " + std::to_string(type) +
             "; only points, lines, linear triangles and linear tetrahedra are read");
  }
  /// The numbers of an element's nodes, as many as it has.
  using node_numbers = std::array<std::uint64_t, quadratic_nodes<3>>;

  void add_element(int type, const node_numbers& vertices, local_id tag, local_id partition) {
    switch (static_cast<msh_type>(type)) {
    case msh_type::quadratic_triangle:
      add_middles<2>(vertices, triangle_middles_);
      [[fallthrough]];
    case msh_type::triangle:
      triangles_.push_back({vertices[0], vertices[1], vertices[2]});
      mesh_.triangle_tags.push_back(tag_of(tag));
      partitions_of_triangles_.push_back(partition);
      break;
    case msh_type::quadratic_tetrahedron:
      add_middles<3>(vertices, middles_);
      [[fallthrough]];
    case msh_type::tetrahedron:
      tetrahedra_.push_back({vertices[0], vertices[1], vertices[2], vertices[3]});
      mesh_.mesh.tags.push_back(tag_of(tag));
      partitions_.push_back(partition);
      break;
    default:
      mesh_.pass_over("points and lines as elements");
    }
  }
  template <int D>
  static void add_middles(const node_numbers& vertices,
                          std::vector<std::array<std::uint64_t, edges_per_element<D>>>& middles) {
    auto& of_edges = middles.emplace_back();
    for (std::size_t k = D + 1; k < quadratic_nodes<D>; ++k)
      of_edges[numbering::gmsh_nodes<D>[k] - (D + 1)] = vertices[k];
  }

  /// Node data of one component per node are kept; those of more are passed over.
  void read_node_data() {
    const auto strings = at_.number<std::uint32_t>();
    at_.line();
    std::string name;
    for (std::uint32_t s = 0; s < strings && !at_.at_end(); ++s) {
      auto text = std::string(at_.line());
      std::erase(text, '"');
      if (s == 0)
        name = text;
    }
    for (auto reals = at_.number<std::uint32_t>(); reals > 0; --reals)
      at_.number<double>();
    std::vector<std::int64_t> integers(at_.plausible(at_.number<std::uint32_t>(), 2));
    for (auto& value : integers)
      value = at_.number<std::int64_t>();
    if (integers.size() < 3 || integers[2] < 0)
      at_.fail("node data without a number of components and nodes");
    if (in_.binary)
      at_.line();
    const auto components = integers[1];
    if (components < 1 || components > 9)
      at_.fail("node data have an impossible number of components");
    const auto count = at_.plausible(static_cast<std::uint64_t>(integers[2]), in_.binary ? 12 : 4);
    node_data data{name, {}};
    for (std::size_t i = 0; i < count; ++i) {
      const auto node = unsigned_of(in_.integer());
      for (std::int64_t c = 0; c < components; ++c) {
        const auto value = in_.real();
        if (c == 0)
          data.values.emplace_back(node, value);
      }
    }
    if (components == 1 && node_data_.size() == most_point_arrays)
      at_.fail("there are more than " + std::to_string(most_point_arrays) + " sections of node data");
    if (components == 1)
      node_data_.push_back(std::move(data));
    else
      mesh_.pass_over("node data of several components");
  }

  /// Partitions count from 1; nothing where no element is in any.
  static std::vector<local_id> subdomains_of(const std::vector<local_id>& partitions) {
    std::vector<local_id> subdomains;
    if (std::any_of(partitions.begin(), partitions.end(), [](local_id p) { return p != 0; }))
      for (const auto p : partitions)
        subdomains.push_back(p - 1);
    return subdomains;
  }
  void translate_nodes() {
    const node_lookup nodes(numbers_, at_);
    const auto index = [&](std::uint64_t number) { return nodes.index(number); };
    const auto translate = [&](const auto& all, auto& to) {
      for (const auto& vertices : all)
        std::transform(vertices.begin(), vertices.end(), to.emplace_back().begin(), index);
    };
    translate(tetrahedra_, mesh_.mesh.elements);
    translate(triangles_, mesh_.triangles);
    translate(middles_, mesh_.middles);
    translate(triangle_middles_, mesh_.triangle_middles);
    for (const auto number : numbers_) // global numbers count from 0, those of MSH from 1
      mesh_.node_ids.push_back(static_cast<global_id>(number) - 1);
    mesh_.subdomains = subdomains_of(partitions_);
    if (tetrahedra_.empty()) // else they are sides of elements
      mesh_.triangle_subdomains = subdomains_of(partitions_of_triangles_);
    for (const auto& [name, values] : node_data_) {
      point_array array{name, std::vector<double>(numbers_.size(), std::numeric_limits<double>::quiet_NaN())};
      for (const auto& [number, value] : values)
        array.values[index(number)] = value;
      mesh_.point_scalars.push_back(std::move(array));
    }
  }

  /// Of the elements that the mesh is made of: others may be between parts.
  void note_parts() {
    const int dimension = !tetrahedra_.empty() ? 3 : 2;
    const std::set<local_id>& here = parts_with_elements_[dimension];
    mesh_.parts_here = static_cast<local_id>(here.size());
    if (!here.empty())
      mesh_.first_part = *here.begin();
  }

  struct node_data {
    std::string name;
    std::vector<std::pair<std::uint64_t, double>> values; ///< node number, value
  };

  file_cursor at_;
  msh_decoder in_;
  element_order elements_;
  double version_ = 0;
  bool has_nodes_ = false;
  bool has_elements_ = false;
  std::map<std::pair<int, int>, msh_entity_tags> entities_;
  std::set<int> ghosts_;                                  ///< entities of elements that other parts have
  std::map<int, std::set<local_id>> parts_with_elements_; ///< by dimension
  std::vector<std::uint64_t> numbers_;                    ///< of the nodes, in the order of the points
  std::vector<std::array<std::uint64_t, 4>> tetrahedra_;
  std::vector<std::array<std::uint64_t, 3>> triangles_;
  std::vector<std::array<std::uint64_t, edges_per_element<3>>> middles_; ///< of tetrahedra
  std::vector<std::array<std::uint64_t, edges_per_element<2>>> triangle_middles_;
  std::vector<local_id> partitions_;              ///< per tetrahedron
  std::vector<local_id> partitions_of_triangles_; ///< per triangle
  std::vector<node_data> node_data_;
  loaded_mesh mesh_;
};

} // namespace detail

/// Reads MSH 2.2 and 4.1 files: tetrahedra, triangles, and node data of one component. A tag is the first
/// physical group of an element's entity, or the entity's number where it has none, less one, as MSH counts
/// from 1; likewise `subdomains` is the partition and `node_ids` the node number, less one. Of a file that
/// has one part of a mesh it reads that part; elements that are ghosts in it are left out, and triangles that
/// are only there since elements on both sides are of different partitions.
struct msh_reader {
  element_order elements = element_order::first; ///< which elements to take

  loaded_mesh operator()(const std::filesystem::path& file) const {
    const auto content = read_file(file);
    return detail::msh_parser(content, file.string(), elements).parse();
  }
};

} // namespace dovetail::io
