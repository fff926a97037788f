/// @file
/// What a piece adds to an MSH file, in a file of its own: any worker encodes it, and when all are there the
/// parts are copied to their places.
#pragma once

#include "dovetail/core/encoding.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/fields.hpp"
#include "dovetail/core/output_file.hpp"
#include "dovetail/core/sequence.hpp"
#include "dovetail/files/msh_encoder.hpp"
#include "dovetail/files/msh_entities.hpp"
#include "dovetail/files/skeleton_entities.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"
#include "dovetail/mesh/global_numbering.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dovetail::io::detail {

/// The tag in the file of a node or element with a global number.
inline std::uint64_t msh_tag(global_id id) {
  return static_cast<std::uint64_t>(id) + 1;
}

/// Nodes come in VTK's order.
inline void write_element(msh_encoder& out, std::uint64_t tag, std::span<const global_id> nodes) {
  out.count(tag);
  for (std::size_t k = 0; k < nodes.size(); ++k)
    out.count(msh_tag(nodes[nodes.size() == quadratic_nodes<3> ? numbering::gmsh_nodes<3>[k] : k]));
  out.line();
}

/// What is in the file of a piece, one behind the other: elements, ghosts, coordinates of the inner nodes.
struct msh_piece_table {
  struct block {
    global_id face; ///< in D = 2 the CAD face that the elements are on
    global_id elements;
    std::uint64_t bytes;
  };
  std::vector<block> blocks;
  std::uint64_t ghosts = 0;
  std::uint64_t ghost_bytes = 0;
  std::uint64_t point_bytes = 0;

  using fields = field_list<&msh_piece_table::blocks, &msh_piece_table::ghosts, &msh_piece_table::ghost_bytes,
                            &msh_piece_table::point_bytes>;

  std::uint64_t element_bytes() const {
    return std::accumulate(blocks.begin(), blocks.end(), std::uint64_t{0},
                           [](std::uint64_t sum, const block& b) { return sum + b.bytes; });
  }
};

/// What the files of all pieces are written with.
struct msh_encoding {
  global_numbering numbers;
  bool binary = true;
  std::unique_ptr<const point_sharers> sharers = {}; ///< only where ghosts are wanted
};

template <int D>
class msh_piece_file {
public:
  msh_piece_file(const std::filesystem::path& path, const distributed_simplicial_mesh<D>& mesh,
                 std::shared_ptr<const msh_encoding> how)
      : mesh_(mesh), how_(std::move(how)), file_(path), out_(file_, how_->binary) {}

  /// Once.
  void add(const simplicial_piece<D>& piece) {
    const piece_nodes<D> nodes(mesh_, piece);
    write_elements(piece, nodes);
    const auto before_ghosts = file_.size();
    if (how_->sharers)
      write_ghosts(piece);
    const auto before_points = file_.size();
    for (const vec3 p : nodes.own()) {
      out_.point(p);
      out_.line();
    }
    table_.ghost_bytes = before_points - before_ghosts;
    table_.point_bytes = file_.size() - before_points;
  }
  std::uint64_t close() {
    const byte_buffer table = encoded(table_);
    file_.bytes(table.data(), table.size());
    file_.value<std::uint64_t>(table.size());
    file_.commit();
    return file_.size();
  }

private:
  void write_elements(const simplicial_piece<D>& piece, const piece_nodes<D>& nodes) {
    std::map<local_id, std::vector<std::size_t>> of_face;
    for (std::size_t e = 0; e < piece.mesh.elements.size(); ++e)
      of_face[D == 2 ? piece.mesh.tags[e] : 0].push_back(e);
    const global_id first = how_->numbers.first_element[piece.subdomain];
    std::vector<global_id> numbers(nodes.per_element());
    for (const auto& [face, elements] : of_face) {
      const auto before = file_.size();
      for (const std::size_t e : elements) {
        for (std::size_t k = 0; k < numbers.size(); ++k)
          numbers[k] = global_node(nodes, how_->numbers, piece.subdomain, nodes.of_element(e)[k]);
        write_element(out_, msh_tag(first + static_cast<global_id>(e)), span_of(numbers));
      }
      table_.blocks.push_back({face, static_cast<global_id>(elements.size()), file_.size() - before});
    }
  }

  /// Elements that touch another subdomain in a point, and which subdomains they touch.
  void write_ghosts(const simplicial_piece<D>& piece) {
    const global_id first = how_->numbers.first_element[piece.subdomain];
    std::vector<local_id> touched;
    for (std::size_t e = 0; e < piece.mesh.elements.size(); ++e) {
      touched.clear();
      for (const auto v : piece.mesh.elements[e])
        if (static_cast<std::size_t>(v) < piece.skeleton_points.size())
          for (const auto s : (*how_->sharers)[piece.skeleton_points[v]])
            if (s != piece.subdomain)
              touched.push_back(s);
      if (touched.empty())
        continue;
      sort_unique(touched);
      ++table_.ghosts;
      out_.count(msh_tag(first + static_cast<global_id>(e)));
      out_.integer(partition_tag(piece.subdomain));
      out_.count(touched.size());
      for (const auto s : touched)
        out_.integer(partition_tag(s));
      out_.line();
    }
  }

  const distributed_simplicial_mesh<D>& mesh_;
  std::shared_ptr<const msh_encoding> how_;
  output_file file_;
  msh_encoder out_;
  msh_piece_table table_;
};

/// Reads the end of a piece's file. Throws `io_error` naming it when it is not whole.
inline msh_piece_table read_msh_piece_table(const std::filesystem::path& path) {
  std::error_code missing;
  const auto whole = std::filesystem::file_size(path, missing);
  std::ifstream file(path, std::ios::binary);
  std::uint64_t size = 0;
  constexpr std::streamoff end = sizeof size;
  if (file.seekg(-end, std::ios::end).read(reinterpret_cast<char*>(&size), end) && size <= whole)
    file.seekg(-end - static_cast<std::streamoff>(size), std::ios::end);
  byte_buffer bytes(file && size <= whole ? size : 0);
  if (bytes.empty() || !file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size)))
    throw io_error("cannot read " + path.string() + ", a piece's part of an MSH file");
  return decoded<msh_piece_table>(bytes);
}

/// The files of all pieces. Their contents are copied to the whole file and go: of each piece first the
/// points, which are last in its file, then block by block the elements, then the ghosts.
class msh_piece_files {
public:
  explicit msh_piece_files(std::vector<std::filesystem::path> paths) : paths_(std::move(paths)) {
    for (const auto& path : paths_)
      tables_.push_back(read_msh_piece_table(path));
    copied_.resize(paths_.size());
    blocks_.resize(paths_.size());
  }
  const std::vector<msh_piece_table>& tables() const { return tables_; }

  void copy_points(output_file& to, local_id piece) const {
    const auto p = static_cast<std::size_t>(piece);
    const auto first = tables_[p].element_bytes() + tables_[p].ghost_bytes;
    to.copy(paths_[p], first, tables_[p].point_bytes);
    std::error_code ignored;
    std::filesystem::resize_file(paths_[p], first, ignored);
  }
  void copy_next_block(output_file& to, local_id piece) {
    const auto p = static_cast<std::size_t>(piece);
    copy_next(to, p, tables_[p].blocks[blocks_[p]++].bytes);
  }
  void copy_ghosts(output_file& to) {
    for (std::size_t p = 0; p < paths_.size(); ++p)
      copy_next(to, p, tables_[p].ghost_bytes);
  }

private:
  void copy_next(output_file& to, std::size_t p, std::uint64_t bytes) {
    if (bytes == 0)
      return; // the file may have gone
    to.copy(paths_[p], copied_[p], bytes);
    copied_[p] += bytes;
    std::error_code ignored;
    if (copied_[p] == tables_[p].element_bytes() + tables_[p].ghost_bytes)
      std::filesystem::remove(paths_[p], ignored);
  }

  std::vector<std::filesystem::path> paths_;
  std::vector<msh_piece_table> tables_;
  std::vector<std::uint64_t> copied_; ///< bytes of each file's beginning
  std::vector<std::size_t> blocks_;   ///< number of those copied of each file
};

} // namespace dovetail::io::detail
