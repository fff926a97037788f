/// @file
/// An XDMF file that names the pieces in files of VTK's HDF format.
#pragma once

#include "dovetail/core/ids.hpp"
#include "dovetail/core/output_file.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace dovetail::io::detail {

/// How much a grid has.
struct grid_extent {
  std::uint64_t points = 0;
  std::uint64_t cells = 0;

  grid_extent& operator+=(const grid_extent& more) {
    points += more.points;
    cells += more.cells;
    return *this;
  }
};

inline grid_extent sum_of(const std::vector<grid_extent>& extents) {
  grid_extent sum;
  for (const grid_extent& each : extents)
    sum += each;
  return sum;
}

/// What XDMF calls the elements.
template <int D>
std::string xdmf_topology(bool second_order) {
  return std::string(D == 3 ? "Tetrahedron" : "Triangle").append(second_order ? (D == 3 ? "_10" : "_6") : "");
}

/// Rows of a dataset: those of one piece among those of its file.
struct xdmf_rows {
  std::string dataset; ///< "file:/path"
  const char* type;    ///< "Float" or "Int"
  int bytes;           ///< of a value
  std::uint64_t first, count, all;
  std::uint64_t columns = 1;
};

inline std::string xdmf_item(const xdmf_rows& rows) {
  const auto extent = [&](std::uint64_t count) {
    return std::to_string(count).append(rows.columns == 1 ? "" : " " + std::to_string(rows.columns));
  };
  const std::string whole = "<DataItem Dimensions=\"" + extent(rows.all) + "\" NumberType=\"" + rows.type +
                            "\" Precision=\"" + std::to_string(rows.bytes) + "\" Format=\"HDF\">" +
                            rows.dataset + "</DataItem>\n";
  if (rows.count == rows.all)
    return whole;
  const bool flat = rows.columns == 1;
  return "<DataItem ItemType=\"HyperSlab\" Dimensions=\"" + extent(rows.count) +
         "\" Type=\"HyperSlab\">\n<DataItem Dimensions=\"3 " + (flat ? "1" : "2") + "\" Format=\"XML\">" +
         std::to_string(rows.first) + (flat ? " 1 " : " 0 1 1 ") + extent(rows.count) + "</DataItem>\n" +
         whole + "</DataItem>\n";
}

/// One grid per piece. File f holds the pieces bounds[f] .. bounds[f + 1] - 1, of these extents.
inline void write_xdmf_index(output_file& file, const std::string& topology, std::uint64_t corners,
                             const std::vector<grid_extent>& extents, const std::vector<local_id>& bounds,
                             const std::vector<std::string>& names) {
  file.text("<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n<Domain>\n"
            "<Grid Name=\"mesh\" GridType=\"Collection\" CollectionType=\"Spatial\">\n");
  for (std::size_t f = 0; f < names.size(); ++f) {
    const auto begin = extents.begin() + bounds[f], end = extents.begin() + bounds[f + 1];
    const grid_extent all = sum_of({begin, end});
    const std::string root = names[f] + ":/VTKHDF/";
    grid_extent before;
    for (auto piece = begin; piece != end; before += *piece++) {
      const auto name = std::to_string(piece - extents.begin());
      file.text(
          "<Grid Name=\"subdomain " + name + "\">\n<Topology TopologyType=\"" + topology +
          "\" NumberOfElements=\"" + std::to_string(piece->cells) + "\">\n" +
          xdmf_item({root + "Connectivity", "Int", 4, corners * before.cells, corners * piece->cells,
                     corners * all.cells}) +
          "</Topology>\n<Geometry GeometryType=\"XYZ\">\n" +
          xdmf_item({root + "Points", "Float", 8, before.points, piece->points, all.points, 3}) +
          "</Geometry>\n<Attribute Name=\"GlobalNodeIds\" Center=\"Node\">\n" +
          xdmf_item({root + "PointData/GlobalNodeIds", "Int", 8, before.points, piece->points, all.points}) +
          "</Attribute>\n");
      for (const std::string array : {"subdomain", "region"})
        file.text("<Attribute Name=\"" + array + "\" Center=\"Cell\">\n" +
                  xdmf_item({root + "CellData/" + array, "Int", 4, before.cells, piece->cells, all.cells}) +
                  "</Attribute>\n");
      file.text("</Grid>\n");
    }
  }
  file.text("</Grid>\n</Domain>\n</Xdmf>\n");
}

} // namespace dovetail::io::detail
