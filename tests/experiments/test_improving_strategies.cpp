// What is done to the elements at interfaces: every strategy keeps the mesh, and the baselines take just the
// layers that the paper says.
#include "distributed/lumps.hpp"
#include "dovetail/distributed/processes.hpp"
#include "dovetail/distributed/ranks.hpp"
#include "dovetail/experiments/baselines/ito_improvement.hpp"
#include "dovetail/experiments/baselines/loehner_improvement.hpp"
#include "dovetail/improver/native.hpp"
#include "dovetail/mesh/distributed_validity.hpp"
#include "dovetail/mesh/mesh_hash.hpp"
#include "dovetail/parallel/checkpointed.hpp"
#include "dovetail/parallel/in_process.hpp"
#include "dovetail/parallel/serial.hpp"
#include "files/scratch_folder.hpp"
#include "files/stacked_cubes.hpp"
#include "pipeline/solid_meshes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

using namespace dovetail;
using namespace dovetail::testing;

namespace {

const std::vector<std::pair<std::string, improving_strategy>> strategies{
    {"pieces", improve_pieces},
    {"ito", baselines::ito_improvement{}},
    {"loehner", baselines::loehner_improvement{}}};

using place = std::array<double, 3>;
using places = std::vector<place>; ///< of the vertices of an element or a side, growing

template <std::size_t N>
places places_of(std::span<const vec3> points, const std::array<local_id, N>& entity) {
  places at;
  for (const local_id v : entity) {
    const vec3& p = points[v];
    at.push_back({p.x, p.y, p.z});
  }
  std::sort(at.begin(), at.end());
  return at;
}

/// The sides on CAD faces and the edges on curves, by their places.
std::set<std::pair<int, places>> cad_entities_by_place(const fine_skeleton& skeleton) {
  std::set<std::pair<int, places>> found;
  for (std::size_t s = 0; s < skeleton.sides.size(); ++s)
    if (skeleton.side_hosts[s] != no_id)
      found.insert({skeleton.side_hosts[s], places_of(skeleton.points, skeleton.sides[s])});
  for (std::size_t c = 0; c < skeleton.curve_edges.size(); ++c)
    found.insert({skeleton.curves[c], places_of(skeleton.points, skeleton.curve_edges[c])});
  return found;
}

std::map<local_id, double> volumes_of_materials(const distributed_mesh& mesh) {
  std::map<local_id, double> volumes;
  for (std::size_t p = 0; p < mesh.counts.size(); ++p)
    volumes[mesh.counts[p].material] += volume_of(mesh.load(static_cast<local_id>(p)).mesh);
  return volumes;
}

quality_statistics measured(const distributed_mesh& mesh) {
  quality_statistics whole;
  for (std::size_t p = 0; p < mesh.counts.size(); ++p)
    whole.merge(measure_quality(io::load_checked(mesh, static_cast<local_id>(p)).mesh), whole.elements);
  return whole;
}

std::vector<distributed_mesh> test_meshes() {
  return {lumps(24, 5, 0.6), lumps(3, 1, 0.6), lumps(1, 1, 0.6),
          stacked_cubes{.cells = 8, .cuts = 2, .solids = 2, .jitter = 0.6}.distributed()};
}

} // namespace

TEST_CASE("every strategy keeps the mesh, its boundary and its materials, and makes it no worse") {
  for (const auto& mesh : test_meshes()) {
    const auto before = measured(mesh);
    for (const auto& named : strategies) {
      const auto& name = named.first; // named, since clang 14 captures no structured binding
      const auto& strategy = named.second;
      CAPTURE(name);
      CAPTURE(mesh.counts.size());
      const auto made = strategy(mesh, improvement::native{}, {}, parallel::serial{}, {});
      CHECK(io::check_distributed(made.mesh).text() == "");
      CHECK(cad_entities_by_place(made.mesh.skeleton) == cad_entities_by_place(mesh.skeleton));
      for (const auto& [material, volume] : volumes_of_materials(mesh))
        CHECK(volumes_of_materials(made.mesh)[material] == doctest::Approx(volume).epsilon(1e-12));
      const auto after = measured(made.mesh);
      CHECK(after.min_dihedrals.below(24) <= before.min_dihedrals.below(24));
      CHECK(after.min_dihedral_deg >= before.min_dihedral_deg);
      CHECK(made.quality.elements == after.elements);
      CHECK(made.quality.min_dihedrals.below(24) == after.min_dihedrals.below(24));
      CHECK(made.quality.worst_element == after.worst_element);
      CHECK(made.mesh.material_names == mesh.material_names);
    }
  }
}

TEST_CASE("the baselines improve what interfaces had kept from it") {
  const auto mesh = lumps(24, 5, 0.6);
  std::vector<std::int64_t> low;
  for (const auto& [name, strategy] : strategies)
    low.push_back(
        strategy(mesh, improvement::native{}, {}, parallel::serial{}, {}).quality.min_dihedrals.below(24));
  CHECK(low[1] < low[0]);
  CHECK(low[2] < low[0]);
}

TEST_CASE("every strategy gives the same by every executor, any number of ranks, and with a spool") {
  const auto mesh = lumps(8, 5, 0.5);
  for (const auto& named : strategies) {
    const auto& name = named.first; // named, since clang 14 captures no structured binding
    const auto& strategy = named.second;
    CAPTURE(name);
    const auto hash_by = [&](const any_executor& run) {
      return io::mesh_hash(strategy(mesh, improvement::native{}, {}, run, {}).mesh);
    };
    const auto hash = hash_by(parallel::serial{});
    CHECK(hash != io::mesh_hash(mesh));
    const scratch_folder folder("improving_strategies");
    const auto disk = spool::start(folder / "spool", {{"test", "1"}});
    CHECK(hash_by(parallel::processes{.worker_count = 2}) == hash);
    CHECK(hash_by(parallel::checkpointed(parallel::processes{.worker_count = 2}, disk)) == hash);
    parallel::run_ranks(3,
                        [&](parallel::in_process& mine) { CHECK(hash_by(parallel::ranks(mine)) == hash); });
  }
}

namespace {

/// Writes down what it gets to improve, and leaves it as it is.
struct observer {
  static constexpr improver_traits traits{};
  std::vector<std::set<places>>* seen = nullptr;

  report operator()(simplicial_mesh<3>& mesh, const frozen_entities<3>&, const any_sizing&) const {
    seen->emplace_back();
    for (const auto& element : mesh.elements)
      seen->back().insert(places_of(mesh.points, element));
    return {};
  }
};

/// The elements of a piece, and the pieces of one material at each place.
struct counted_mesh {
  std::vector<std::set<places>> elements; ///< per piece
  std::vector<local_id> materials;        ///< per piece
  std::map<std::pair<place, local_id>, std::set<local_id>> pieces_at;

  explicit counted_mesh(const distributed_mesh& mesh) {
    for (std::size_t p = 0; p < mesh.counts.size(); ++p) {
      const auto piece = mesh.load(static_cast<local_id>(p));
      materials.push_back(piece.material);
      elements.emplace_back();
      for (const auto& element : piece.mesh.elements) {
        const auto at = places_of(piece.mesh.points, element);
        elements.back().insert(at);
        for (const place& v : at)
          pieces_at[{v, piece.material}].insert(static_cast<local_id>(p));
      }
    }
  }
  const std::set<local_id>& pieces(const place& at, std::size_t p) const {
    return pieces_at.at({at, materials[p]});
  }
  /// Of piece p, the elements within two layers: those that `is_first` says, and those that share a vertex
  /// with one of them.
  template <class IsFirst>
  std::set<places> two_layers(std::size_t p, const IsFirst& is_first) const {
    std::set<place> touched;
    for (const auto& element : elements[p])
      if (std::any_of(element.begin(), element.end(), is_first))
        touched.insert(element.begin(), element.end());
    std::set<places> within;
    for (const auto& element : elements[p])
      if (std::any_of(element.begin(), element.end(), [&](const place& v) { return touched.contains(v); }))
        within.insert(element);
    return within;
  }
};

} // namespace

TEST_CASE("Ito's improver collects the elements of two layers, and no others, into a mesh per material") {
  for (const auto& mesh : test_meshes()) {
    CAPTURE(mesh.counts.size());
    const counted_mesh counted(mesh);
    std::map<local_id, std::set<places>> expected; // by material
    double count = 0;
    for (std::size_t p = 0; p < counted.elements.size(); ++p) {
      const auto within =
          counted.two_layers(p, [&](const place& v) { return counted.pieces(v, p).size() > 1; });
      if (!within.empty())
        expected[counted.materials[p]].insert(within.begin(), within.end());
      count += static_cast<double>(within.size());
    }
    std::vector<std::set<places>> seen;
    const auto made = baselines::ito_improvement{}(mesh, observer{&seen}, {}, parallel::serial{});
    REQUIRE(seen.size() == counted.elements.size() + expected.size());
    std::set<std::set<places>> collected, wanted;
    for (std::size_t k = counted.elements.size(); k < seen.size(); ++k)
      collected.insert(seen[k]);
    for (const auto& [material, elements] : expected)
      wanted.insert(elements);
    CHECK(collected == wanted);
    CHECK(made.summary.find("collection").get("elements", 0) == count);
    CHECK(made.summary.find("second pass").get("elements", 0) == count);
  }
}

TEST_CASE("Ito's improver gives the elements back to the pieces beside them") {
  const auto mesh = lumps(3, 1);
  const auto made = baselines::ito_improvement{}(mesh, improvement::native{}, {}, parallel::serial{});
  REQUIRE(made.mesh.counts.size() == 3);
  CHECK(made.summary.find("writing back").get("pieces") == 3);
  for (std::size_t p = 0; p < 3; ++p) {
    const auto before = static_cast<double>(mesh.counts[p].elements);
    CHECK(static_cast<double>(made.mesh.counts[p].elements) == doctest::Approx(before).epsilon(0.2));
  }
}

TEST_CASE("Loehner's improver gives two layers of each piece to its lesser neighbours, and no others") {
  for (const auto& mesh : test_meshes()) {
    CAPTURE(mesh.counts.size());
    const counted_mesh counted(mesh);
    const std::size_t pieces = counted.elements.size();
    std::vector<std::set<places>> expected(pieces);
    double moved = 0, all = 0, most = 0;
    for (std::size_t j = 0; j < pieces; ++j) {
      std::set<places> left = counted.elements[j];
      for (std::size_t i = 0; i < j; ++i)
        if (counted.materials[i] == counted.materials[j])
          for (const auto& element : counted.two_layers(j, [&](const place& v) {
                 return counted.pieces(v, j).contains(static_cast<local_id>(i));
               }))
            if (left.erase(element) == 1) {
              expected[i].insert(element);
              ++moved;
            }
      expected[j].insert(left.begin(), left.end());
    }
    std::erase_if(expected, [](const auto& elements) { return elements.empty(); });
    for (const auto& elements : expected) {
      all += static_cast<double>(elements.size());
      most = std::max(most, static_cast<double>(elements.size()));
    }
    std::vector<std::set<places>> seen;
    const auto made = baselines::loehner_improvement{}(mesh, observer{&seen}, {}, parallel::serial{});
    REQUIRE(made.mesh.counts.size() == expected.size());
    REQUIRE(seen.size() == pieces + expected.size());
    for (std::size_t p = 0; p < expected.size(); ++p) {
      CAPTURE(p);
      std::set<places> found;
      const auto piece = made.mesh.load(static_cast<local_id>(p));
      for (const auto& element : piece.mesh.elements)
        found.insert(places_of(piece.mesh.points, element));
      CHECK(found == expected[p]);
      CHECK(std::count(seen.begin() + static_cast<std::ptrdiff_t>(pieces), seen.end(), expected[p]) == 1);
    }
    const report& redistributed = made.summary.find("redistribution");
    CHECK(redistributed.get("elements") == moved);
    CHECK(redistributed.get("pieces") == static_cast<double>(expected.size()));
    CHECK(redistributed.get("largest_over_mean") ==
          doctest::Approx(most * static_cast<double>(expected.size()) / all));
  }
}

TEST_CASE("the summary has the rows of the paper's table 10") {
  const auto mesh = lumps(8, 5, 0.5);
  for (const auto& named : strategies) {
    const auto& name = named.first; // named, since clang 14 captures no structured binding
    const auto& strategy = named.second;
    if (name == "pieces")
      continue;
    CAPTURE(name);
    const auto made = strategy(mesh, improvement::native{}, {}, parallel::serial{}, {});
    double steps = 0;
    for (const report& step : made.summary.children) {
      CHECK(step.seconds > 0);
      steps += step.seconds;
    }
    CHECK(made.summary.children.size() == (name == "ito" ? 4 : 3));
    CHECK(made.summary.seconds >= steps);
    CHECK(made.summary.get("improver_seconds") > 0);
    CHECK(made.summary.get("pieces") == 8);
    CHECK(made.summary.get("elements") ==
          made.summary.find("first pass").get("elements") + made.summary.find("second pass").get("elements"));
  }
}
