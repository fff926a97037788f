/// @file
/// What every redistributor keeps, whoever wrote it.
#pragma once

#include "dovetail/distributed/any_redistributor.hpp"
#include "dovetail/mesh/distributed_validity.hpp"
#include "dovetail/mesh/mesh_hash.hpp"
#include "dovetail/solver/check_rank_meshes.hpp"
#include "dovetail/solver/make_rank_mesh.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace dovetail::testing {

/// The elements by their places and tags, whatever the pieces.
template <int D>
std::uint64_t hash_by_place(const distributed_simplicial_mesh<D>& mesh) {
  io::mesh_hasher hasher;
  for (std::size_t p = 0; p < mesh.counts.size(); ++p)
    io::hash_elements_by_place(hasher, io::load_checked(mesh, static_cast<local_id>(p)));
  return hasher.value();
}

/// The number of sides on each CAD entity, seen from each piece beside them, and of edges on each curve.
template <int D>
std::map<std::pair<int, local_id>, int> cad_entities(const simplicial_skeleton<D>& skeleton) {
  std::map<std::pair<int, local_id>, int> count;
  for (const local_id on : skeleton.side_hosts)
    if (on != no_id)
      ++count[{D - 1, on}];
  for (const local_id on : skeleton.curves)
    ++count[{1, on}];
  return count;
}

/// Whether the result is a mesh of the same elements, which the ranks have in even shares and agree about.
template <int D, class R>
redistribution<D> check_redistributor(const R& policy, const distributed_simplicial_mesh<D>& mesh, int ranks,
                                      double most_imbalance) {
  CAPTURE(ranks);
  const redistribution<D> given = any_redistributor<D>(policy, "checked")(mesh, ranks);
  const auto& divided = given.divided(mesh);
  const auto again = policy(mesh, ranks);
  CHECK(again.rank_of_piece == given.rank_of_piece);
  CHECK(io::mesh_hash(again.divided(mesh)) == io::mesh_hash(divided));
  CHECK(hash_by_place(divided) == hash_by_place(mesh));
  CHECK(cad_entities(divided.skeleton) == cad_entities(mesh.skeleton));
  CHECK(io::check_distributed(divided).text() == "");

  const auto numbers = io::number_by_ranks(divided, given.rank_of_piece, ranks);
  std::vector<rank_mesh<D>> of_ranks;
  double elements = 0, largest = 0;
  for (local_id q = 0; q < ranks; ++q) {
    of_ranks.push_back(io::make_rank_mesh<D>(divided, numbers, q, true));
    elements += static_cast<double>(of_ranks.back().owned_elements);
    largest = std::max(largest, static_cast<double>(of_ranks.back().owned_elements));
  }
  CHECK(io::check_rank_meshes<D>(of_ranks) == std::vector<std::string>{});
  CHECK(largest * ranks / elements <= most_imbalance);
  CHECK(given.summary.get("ranks") == ranks);
  CHECK(given.summary.get("largest_rank") == largest);
  CHECK(given.summary.get("imbalance") == doctest::Approx(largest * ranks / elements));
  return given;
}

} // namespace dovetail::testing
