/// @file
/// Reads an XDMF file as `write_xdmf_index` and `xdmf_format` write it: which rows of which datasets make a
/// grid.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/core/input_file.hpp"
#include "dovetail/core/xml_tree.hpp"

#include <charconv>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace dovetail::io::detail {

/// Rows of a dataset in an HDF5 file.
struct xdmf_slab {
  std::filesystem::path file{};
  std::string dataset{};
  std::uint64_t all = 0; ///< rows of the dataset
  std::uint64_t columns = 1;
  std::uint64_t first = 0; ///< of these rows, the first that is meant
  std::uint64_t rows = 0;  ///< how many
};

/// What an XDMF file says of one grid.
struct xdmf_grid {
  std::string topology{};
  std::uint64_t elements = 0;
  std::vector<xdmf_slab> arrays{};
};

/// Throws `input_error` naming the file and the element that is not as dovetail writes it.
class xdmf_input {
public:
  explicit xdmf_input(std::filesystem::path path) : path_(std::move(path)) {}

  std::vector<xdmf_grid> read() const {
    const std::string content = read_file(path_);
    const xml_element root = xml_parser(content, path_.string()).parse();
    const auto* domain = root.name == "Xdmf" ? root.child("Domain") : nullptr;
    const auto* grid = domain == nullptr ? nullptr : domain->child("Grid");
    if (grid == nullptr)
      fail("there is no <Grid> in a <Domain> of <Xdmf>");
    std::vector<xdmf_grid> grids;
    if (grid->attribute("GridType") != "Collection")
      grids.push_back(grid_of(*grid));
    else
      for (const auto& child : grid->children)
        if (child.name == "Grid")
          grids.push_back(grid_of(child));
    if (grids.empty())
      fail("there is no <Grid> in the collection");
    return grids;
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw input_error(path_.string() + ": " + what + "; write the file anew");
  }

private:
  xdmf_grid grid_of(const xml_element& element) const {
    xdmf_grid grid;
    for (const auto& child : element.children) {
      const auto* item = child.child("DataItem");
      if (item == nullptr)
        fail("<" + std::string(child.name) + "> has no <DataItem>");
      if (child.name == "Topology") {
        grid.topology = child.attribute("TopologyType");
        const auto elements = numbers(child.attribute("NumberOfElements"));
        if (elements.size() != 1)
          fail("<Topology> has no NumberOfElements");
        grid.elements = elements[0];
      }
      grid.arrays.push_back(slab_of(*item));
    }
    return grid;
  }
  xdmf_slab slab_of(const xml_element& item) const {
    if (item.attribute("ItemType") != "HyperSlab")
      return dataset_of(item);
    if (item.children.size() != 2)
      fail("a <DataItem> of type HyperSlab has not its rows and its dataset");
    xdmf_slab slab = dataset_of(item.children[1]);
    const auto rows = numbers(item.children[0].text);
    const bool flat = rows.size() == 3;
    if (!flat && rows.size() != 6)
      fail("a <DataItem> of type HyperSlab has " + std::to_string(rows.size()) + " numbers, not 3 or 6");
    slab.first = rows[0];
    slab.rows = rows[flat ? 2 : 4];
    const bool whole_rows = flat ? slab.columns == 1 && rows[1] == 1
                                 : rows[1] == 0 && rows[2] == 1 && rows[3] == 1 && rows[5] == slab.columns;
    if (!whole_rows || slab.rows > slab.all || slab.first > slab.all - slab.rows)
      fail("a <DataItem> of type HyperSlab has other rows than there are in " + slab.dataset);
    return slab;
  }
  xdmf_slab dataset_of(const xml_element& item) const {
    const std::string text = xml_unescaped(item.text);
    const auto colon = text.rfind(":/");
    const auto extent = numbers(item.attribute("Dimensions"));
    if (item.attribute("Format") != "HDF" || colon == std::string::npos || extent.empty() ||
        extent.size() > 2)
      fail("a <DataItem> does not name a dataset of an HDF5 file, with its dimensions");
    const auto begin = text.find_first_not_of(" \n\t\r");
    const auto end = text.find_last_not_of(" \n\t\r");
    xdmf_slab slab;
    slab.file = path_.parent_path() / text.substr(begin, colon - begin);
    slab.dataset = text.substr(colon + 2, end + 1 - colon - 2);
    slab.all = slab.rows = extent[0];
    slab.columns = extent.size() == 2 ? extent[1] : 1;
    return slab;
  }
  std::vector<std::uint64_t> numbers(std::string_view text) const {
    std::vector<std::uint64_t> found;
    for (auto first = text.find_first_not_of(" \n\t\r"); first < text.size();
         first = text.find_first_not_of(" \n\t\r")) {
      text.remove_prefix(first);
      std::uint64_t value = 0;
      const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
      if (problem != std::errc())
        fail("'" + std::string(text.substr(0, 40)) + "' is no number");
      text.remove_prefix(static_cast<std::size_t>(end - text.data()));
      found.push_back(value);
    }
    return found;
  }

  std::filesystem::path path_;
};

} // namespace dovetail::io::detail
