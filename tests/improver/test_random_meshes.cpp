/// @file
/// Ten thousand small random meshes, all presets and objectives: what is frozen is kept, what is valid stays
/// valid, and nothing gets worse.
#include "dovetail/improver/native.hpp"
#include "dovetail/improver/shape_measure.hpp"
#include "random_meshes.hpp"

#include <doctest/doctest.h>

#include <string>

using namespace random_meshes;
using dovetail::improvement::native;
using dovetail::improvement::objective;

namespace {

template <class Measure>
double worst_by(const mesh_type& mesh) {
  double worst = 2;
  for (const auto& v : mesh.elements) {
    const auto p = dovetail::corners(std::span(mesh.points), v);
    worst = std::min(worst, dovetail::improvement::measure_of<Measure>(p[0], p[1], p[2], p[3]));
  }
  return worst;
}
double worst_by(objective kind, const mesh_type& mesh) {
  using namespace dovetail::improvement;
  return kind == objective::minimum_dihedral ? worst_by<minimum_dihedral>(mesh)
         : kind == objective::radius_ratio   ? worst_by<radius_ratio>(mesh)
                                             : worst_by<mean_ratio>(mesh);
}

native improver_for(std::uint64_t seed) {
  native improver = seed % 32 < 24   ? native::fast()
                    : seed % 32 < 30 ? native::fine()
                    : seed % 32 < 31 ? native::finest()
                                     : native::hard();
  if (seed % 64 != 7)
    improver.hard_passes = 1; // the costly operations are tried, but not again and again
  if (seed % 4 == 1)
    improver.global_passes = 2;
  improver.objective = seed % 7 == 5   ? objective::radius_ratio
                       : seed % 7 == 6 ? objective::mean_ratio
                                       : objective::minimum_dihedral;
  return improver;
}

struct tally {
  std::size_t valid = 0, better = 0, tangled = 0, untangled = 0, elements = 0, poor = 0;
};

void try_one(std::uint64_t seed, tally& counts) {
  CAPTURE(seed);
  const auto input = random_input(seed);
  const native improver = improver_for(seed);
  auto result = input.mesh;
  dovetail::any_sizing size;
  if (input.size > 0)
    size = [h = input.size](vec3) { return h; };
  improver(result, input.frozen, size);
  check_kept(input.mesh, result, input.frozen);
  counts.elements += input.mesh.elements.size();
  const std::size_t inverted = inverted_count(input.mesh);
  if (inverted > 0) {
    ++counts.tangled;
    counts.untangled += inverted_count(result) == 0;
    return;
  }
  const double before = worst_by(improver.objective, input.mesh),
               after = worst_by(improver.objective, result);
  CHECK(after >= before - 1e-6);
  ++counts.valid;
  counts.better += after > before + 1e-6;
  counts.poor += dovetail::measure_quality(input.mesh).min_dihedral_deg < 1;
}

} // namespace

TEST_CASE("ten thousand random meshes: nothing frozen moves, nothing valid breaks, nothing gets worse") {
  tally counts;
  for (std::uint64_t seed = 0; seed < 10000; ++seed)
    try_one(seed, counts);
  MESSAGE(counts.valid << " valid, " << counts.poor << " of them with angles under 1 degree, "
                       << counts.better << " made better; " << counts.tangled << " tangled, "
                       << counts.untangled << " of them untangled; " << counts.elements << " elements");
  // The inputs are as poor as they are meant to be, and the improver does something about it.
  CHECK(counts.valid > 7000);
  CHECK(counts.poor > counts.valid / 2);
  CHECK(counts.better > counts.valid / 4);
  CHECK(counts.tangled > 500);
  CHECK(counts.untangled > counts.tangled / 4);
}

TEST_CASE("the same mesh is the same, bit for bit, every time") {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    CAPTURE(seed);
    const auto input = random_input(seed);
    auto one = input.mesh, other = input.mesh;
    improver_for(seed)(one, input.frozen, {});
    improver_for(seed)(other, input.frozen, {});
    CHECK(one.points == other.points);
    CHECK(one.elements == other.elements);
    CHECK(one.tags == other.tags);
  }
}
