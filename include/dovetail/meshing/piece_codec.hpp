/// @file
/// Finished pieces as bytes, for workers' results and the spool.
#pragma once

#include "dovetail/core/bytes.hpp"
#include "dovetail/core/report_codec.hpp"
#include "dovetail/mesh/distributed_mesh.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

namespace dovetail {

inline void encode(byte_writer& to, const piece_note& note) {
  to.value<std::uint64_t>(note.files.size());
  for (const piece_note::file& file : note.files) {
    to.text(file.path);
    to.value(file.bytes);
  }
  to.array(note.text);
}

inline piece_note decode_note(byte_reader& from) {
  piece_note note;
  for (auto left = from.value<std::uint64_t>(); left > 0; --left) {
    std::string path = from.text();
    note.files.push_back({std::move(path), from.value<std::uint64_t>()});
  }
  note.text = from.array<std::byte>();
  return note;
}

/// Tags are stored only where they differ from the piece's material.
template <int D>
void encode(byte_writer& to, const simplicial_piece<D>& piece) {
  to.value(piece.subdomain);
  to.value(piece.material);
  to.array(piece.skeleton_points);
  to.array(piece.mesh.points);
  to.array(piece.mesh.elements);
  const auto& tags = piece.mesh.tags;
  const bool one_material =
      std::all_of(tags.begin(), tags.end(), [&](local_id tag) { return tag == piece.material; });
  to.value<std::uint8_t>(tags.empty() ? 0 : one_material ? 1 : 2);
  if (!one_material)
    to.array(tags);
}

template <int D = 3>
simplicial_piece<D> decode_piece(byte_reader& from) {
  simplicial_piece<D> piece;
  piece.subdomain = from.value<local_id>();
  piece.material = from.value<local_id>();
  piece.skeleton_points = from.array<local_id>();
  piece.mesh.points = from.array<vec3>();
  piece.mesh.elements = from.array<simplex<D>>();
  switch (from.value<std::uint8_t>()) {
  case 0:
    break;
  case 1:
    piece.mesh.tags.assign(piece.mesh.elements.size(), piece.material);
    break;
  default:
    piece.mesh.tags = from.array<local_id>();
  }
  return piece;
}

} // namespace dovetail
