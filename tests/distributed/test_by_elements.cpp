// Elements to ranks: the same mesh in other pieces, even, connected, with clean interfaces, whoever runs it.
#include "redistributor_contract.hpp"

#include "dovetail/adapters/metis.hpp"
#include "dovetail/distributed/by_elements.hpp"
#include "dovetail/distributed/by_pieces.hpp"
#include "dovetail/distributed/piece_supers.hpp"
#include "dovetail/distributed/processes.hpp"
#include "dovetail/distributed/ranks.hpp"
#include "dovetail/graph/disjoint_sets.hpp"
#include "dovetail/models/discrete/repair.hpp"
#include "dovetail/models/discrete_model.hpp"
#include "dovetail/models/plane_domain.hpp"
#include "dovetail/parallel/checkpointed.hpp"
#include "dovetail/parallel/in_process.hpp"
#include "dovetail/parallel/threads.hpp"
#include "dovetail/partition/recursive_coordinate.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/sizing/uniform.hpp"
#include "files/scratch_folder.hpp"
#include "files/stacked_cubes.hpp"
#include "lumps.hpp"
#include "models/discrete_shapes.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

using namespace dovetail;
using namespace dovetail::testing;

namespace {

const redistribution_by::elements by_elements{.super_elements = 40};

generated<2> open_box(double size, int parts) {
  generate_options options;
  options.subdomains = parts;
  const auto soup = open_box_soup({0, 0, 0}, {1, 1, 1}, 2);
  return generate<2>(discrete_model(repaired(soup, "box", {.allow_sheets = true}), {.allow_sheets = true}),
                     uniform_size(size), parameters<>{}.with_options(options));
}

/// Three strips of triangles that meet along an axis, each a piece or all one.
distributed_simplicial_mesh<2> wings(local_id length, bool in_one_piece) {
  distributed_simplicial_mesh<2> mesh;
  auto& skeleton = mesh.skeleton;
  const local_id row = length + 1;
  const std::array<vec3, 4> rows{vec3{0, 0, 0}, {1, 0, 0}, {-0.5, 0.8, 0}, {-0.5, -0.8, 0}};
  for (const vec3& at : rows)
    for (local_id i = 0; i < row; ++i)
      skeleton.points.own().push_back(at + vec3{0, 0, static_cast<double>(i)});
  skeleton.point_hosts.own().assign(skeleton.points.size(), {2, 0});
  std::vector<simplicial_piece<2>> pieces(in_one_piece ? 1 : 3);
  for (local_id w = 1; w <= 3; ++w) {
    const local_id to = in_one_piece ? 0 : w - 1;
    auto& piece = pieces[to];
    const auto add_side = [&](local_id a, local_id b, local_id on) {
      skeleton.sides.own().push_back({a, b});
      skeleton.subdomains.own().push_back({to, no_id});
      skeleton.side_hosts.own().push_back(on);
    };
    const local_id tip = w * row;
    for (local_id i = 0; i < length; ++i) {
      piece.mesh.elements.push_back({i, tip + i, tip + i + 1});
      piece.mesh.elements.push_back({i, tip + i + 1, i + 1});
      add_side(i + 1, i, 6);
      add_side(tip + i, tip + i + 1, w);
    }
    add_side(0, tip, no_id);
    add_side(tip + length, length, no_id);
  }
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    auto& piece = pieces[p];
    piece.subdomain = static_cast<local_id>(p);
    for (const auto& element : piece.mesh.elements)
      append(piece.skeleton_points, element);
    sort_unique(piece.skeleton_points);
    for (auto& element : piece.mesh.elements)
      for (local_id& v : element)
        v = static_cast<local_id>(
            std::lower_bound(piece.skeleton_points.begin(), piece.skeleton_points.end(), v) -
            piece.skeleton_points.begin());
    for (const local_id v : piece.skeleton_points)
      piece.mesh.points.push_back(skeleton.points[v]);
    piece.mesh.tags.assign(piece.mesh.elements.size(), 0);
    mesh.counts.push_back({0, 0, static_cast<global_id>(piece.mesh.elements.size())});
  }
  mesh.load = [pieces](local_id p) { return pieces[p]; };
  return mesh;
}

} // namespace

TEST_CASE("every redistributor keeps the contract") {
  for (const int solids : {1, 3}) {
    CAPTURE(solids);
    const auto mesh = stacked_cubes{.cells = 6, .cuts = 3, .solids = solids, .jitter = 0.3}.distributed();
    for (const int ranks : {1, 2, 5}) {
      check_redistributor<3>(redistribution_by::blocks{}, mesh, ranks, 1.2);
      check_redistributor<3>(redistribution_by::pieces{}, mesh, ranks, 1.2);
      check_redistributor<3>(by_elements, mesh, ranks, 1.05);
    }
  }
}

TEST_CASE("by elements, ranks of uneven pieces are even and connected, and old interfaces are inside") {
  for (std::uint32_t seed = 0; seed < 4; ++seed)
    for (const int ranks : {2, 3, 7}) {
      CAPTURE(seed);
      const auto mesh = lumps(20 * ranks, seed, 0.5);
      const auto given = check_redistributor<3>(by_elements, mesh, ranks, 1.05);
      CHECK(given.rank_of_piece.size() == static_cast<std::size_t>(ranks));
      CHECK(given.summary.get("disconnected_ranks") == 0);
      CHECK(given.summary.get("seams_after") < 0.5 * given.summary.get("seams_before"));
      CHECK(given.summary.get("interface_sides") >= given.summary.get("seams_after"));
      CHECK(given.summary.get("avoidable_angles") == 0);
      CHECK(given.summary.find("simplification").get("super_elements") > 20 * ranks);
    }
}

TEST_CASE("a warning says how uneven ranks are that could not be made even") {
  const auto mesh = stacked_cubes{.cells = 1, .cuts = 1}.distributed(); // of 6 elements
  CHECK(by_elements(mesh, 2).summary.warnings.empty());
  const auto warnings = by_elements(mesh, 4).summary.warnings;
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0] ==
        "the largest rank has 1.333 times the average of elements, more than the 1.03 that were "
        "tried for: connected ranks came no nearer");
  auto how = by_elements;
  how.imbalance = 1.4;
  CHECK(how(mesh, 4).summary.warnings.empty());
}

TEST_CASE("the lighter old interfaces weigh, the more of them stay") {
  const auto mesh = lumps(60, 2, 0.5);
  auto how = by_elements;
  how.seam_weight = 0.05;
  CHECK(how(mesh, 3).summary.get("seams_after") > 2 * by_elements(mesh, 3).summary.get("seams_after") + 100);
}

TEST_CASE("a CAD face inside a piece stays, also where both of its sides go to one rank") {
  auto mesh = stacked_cubes{.cells = 1, .cuts = 1}.distributed();
  const auto piece = mesh.load(0);
  const auto table = build_sides(piece.mesh);
  for (std::size_t s = 0; s < table.size(); ++s)
    if (!table.is_boundary(static_cast<local_id>(s))) {
      auto sheet = table.vertices[s];
      for (local_id& v : sheet)
        v = piece.skeleton_points[v];
      mesh.skeleton.sides.own().push_back(sheet);
      mesh.skeleton.subdomains.own().push_back({0, 0});
      mesh.skeleton.side_hosts.own().push_back(99);
      break;
    }
  REQUIRE(io::check_distributed(mesh).valid());
  for (const int ranks : {1, 2, 3}) {
    const auto given = check_redistributor<3>(by_elements, mesh, ranks, 1.05);
    CHECK(given.mesh->skeleton.side_hosts[12] == 99);
  }
}

TEST_CASE("any partitioner does, and more ranks than pieces are no matter") {
  const auto mesh = stacked_cubes{.cells = 6, .cuts = 1}.distributed();
  for (const any_partitioner& partitioner :
       {any_partitioner(partition::metis{}), any_partitioner(partition::recursive_coordinate{}),
        any_partitioner([](const csr_graph&graph, int parts) {
          std::vector<local_id> part;
          for (local_id v = 0; v < graph.node_count(); ++v)
            part.push_back(v % parts);
          return part;
        })}) {
    auto how = by_elements;
    how.partitioner = partitioner;
    how.super_elements = 200;
    const auto given = check_redistributor<3>(how, mesh, 4, 1.6);
    CHECK(given.summary.get("disconnected_ranks") == 0);
    CHECK(given.mesh->counts.size() == 4);
  }
}

TEST_CASE("the result is the same for every executor, any number of ranks, and with a spool") {
  const auto mesh = lumps(12, 1, 0.5);
  const auto alone = by_elements(mesh, 3);
  CHECK(alone.summary.get("depends_on_ranks", 1) == 0);
  CHECK(alone.summary.warnings.empty());
  const auto same = [&](const any_executor& run) {
    auto how = by_elements;
    how.run_tasks = run;
    const auto given = how(mesh, 3);
    return given.rank_of_piece == alone.rank_of_piece &&
           io::mesh_hash(*given.mesh) == io::mesh_hash(*alone.mesh);
  };
  const scratch_folder folder("by_elements");
  const auto disk = spool::start(folder / "spool", {{"test", "1"}});
  CHECK(same(parallel::checkpointed(parallel::serial{}, disk)));
  CHECK(same(parallel::processes{.worker_count = 2}));
  CHECK(same(parallel::checkpointed(parallel::processes{.worker_count = 2}, disk)));
  CHECK(same(parallel::threads{.worker_count = 3}));
  for (const int ranks : {1, 2, 4}) {
    const auto shared = spool::start(folder / std::to_string(ranks), {{"test", "1"}});
    parallel::run_ranks(ranks, [&](parallel::in_process& mine) {
      CHECK(same(parallel::ranks(mine)));
      CHECK(same(parallel::checkpointed(parallel::ranks(mine), shared)));
      const auto own = folder / (std::to_string(ranks) + "_" + std::to_string(mine.rank()));
      CHECK(same(
          parallel::checkpointed(parallel::ranks(mine), spool::start(own, {{"test", "1"}}).of_one_rank())));
    });
  }
}

TEST_CASE("new pieces that a spool has are not written again") {
  const auto mesh = stacked_cubes{.cells = 4, .cuts = 2}.distributed();
  const scratch_folder folder("found");
  auto how = by_elements;
  how.run_tasks = parallel::checkpointed(how.run_tasks, spool::start(folder / "spool", {{"test", "1"}}));
  const auto first = how(mesh, 3);
  const auto long_ago = std::filesystem::file_time_type::clock::now() - std::chrono::hours(1);
  std::size_t pieces = 0;
  for (const auto& file : std::filesystem::directory_iterator(folder / "spool"))
    if (file.path().filename().string().starts_with("redistributed_")) {
      std::filesystem::last_write_time(file, long_ago);
      ++pieces;
    }
  CHECK(pieces == first.mesh->counts.size());
  CHECK(io::mesh_hash(*how(mesh, 3).mesh) == io::mesh_hash(*first.mesh));
  for (const auto& file : std::filesystem::directory_iterator(folder / "spool"))
    if (file.path().filename().string().starts_with("redistributed_"))
      CHECK(std::filesystem::last_write_time(file) == long_ago);
}

TEST_CASE("triangles: drawings, closed shells, and edges where three sheets meet") {
  plane_drawing drawing;
  drawing.polygons = {{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, "square"},
                      {{{0.3, 0.3}, {0.5, 0.3}, {0.5, 0.6}, {0.3, 0.6}}, "hole"}};
  generate_options options;
  options.subdomains = 9;
  const auto plane =
      generate<2>(plane_domain(drawing), uniform_size(0.03), parameters<>{}.with_options(options));
  for (const int ranks : {1, 3}) {
    const auto given = check_redistributor<2>(by_elements, plane.mesh, ranks, 1.05);
    CHECK(given.summary.get("disconnected_ranks") == 0);
    CHECK(given.rank_of_piece.size() == static_cast<std::size_t>(ranks));
  }
  check_redistributor<2>(by_elements, open_box(0.1, 8).mesh, 3, 1.2);
  for (const bool in_one_piece : {false, true})
    for (const int ranks : {1, 2, 5})
      check_redistributor<2>(by_elements, wings(30, in_one_piece), ranks, 1.2);
}

TEST_CASE("super-elements are about as many as asked for, connected, and none crosses the skeleton") {
  const auto mesh = stacked_cubes{.cells = 8, .cuts = 1, .jitter = 0.6}.distributed();
  const auto sides = sort_by_subdomain(mesh.skeleton, 1);
  const auto piece = mesh.load(0);
  const auto [known, supers] = simplify_piece<3>(piece, mesh.skeleton, sides[0], simplifier::paper{}, 150);
  CHECK(known.graph.node_count() <= 150);
  CHECK(known.graph.node_count() >= 60);
  CHECK(known.super_at_side.size() == mesh.skeleton.sides.size());
  const auto table = build_sides(piece.mesh);
  disjoint_sets within(piece.mesh.elements.size());
  for (const auto& [a, b] : table.elements)
    if (b != no_id && supers.super_of_element[a] == supers.super_of_element[b])
      within.unite(a, b);
  CHECK(within.number_sets().count == known.graph.node_count());
  // No side between two of them is bad, unless it was refused.
  const auto judged = simplifier::paper{}(piece.mesh, table);
  std::size_t between = 0;
  for (std::size_t s = 0; s < table.size(); ++s)
    if (const auto [a, b] = table.elements[s];
        b != no_id && supers.super_of_element[a] != supers.super_of_element[b]) {
      ++between;
      CHECK((judged.quality[s] >= judged.wanted_quality ||
             std::binary_search(supers.refused.begin(), supers.refused.end(), static_cast<local_id>(s))));
    }
  CHECK(between > 100);
}

TEST_CASE("bad sides of an old interface have a penalty, and so have those beside a small dihedral") {
  const auto mesh = stacked_cubes{.cells = 8, .cuts = 2, .jitter = 0.9}.distributed();
  const auto sides = sort_by_subdomain(mesh.skeleton, mesh.counts.size());
  std::size_t bad = 0, beside_small_dihedrals = 0;
  for (local_id p = 0; p < 8; ++p) {
    const auto piece = mesh.load(p);
    const auto known =
        simplify_piece<3>(piece, mesh.skeleton, sides[p], simplifier::paper{.volume_shape_deg = 36}, 50)
            .first;
    for (std::size_t i = 0; i < known.penalty_of_side.size(); ++i) {
      const auto corners_of = corners(span_of(mesh.skeleton.points), mesh.skeleton.sides[sides[p][i]]);
      if (smallest_corner_angle(corners_of) < 36) {
        CHECK(known.penalty_of_side[i] > 10);
        ++bad;
      } else if (known.penalty_of_side[i] > 1) {
        ++beside_small_dihedrals;
      }
    }
  }
  CHECK(bad > 0);
  CHECK(beside_small_dihedrals > 0);
}

TEST_CASE("what cannot be redistributed is refused, and a piece that does not fit is named") {
  const stacked_cubes cubes{.cells = 2, .cuts = 2};
  auto mesh = cubes.distributed();
  CHECK_THROWS_AS((void)by_elements(mesh, 0), partition_error);
  CHECK_THROWS_AS((void)by_elements(mesh, 49), partition_error); // elements are 48
  CHECK_THROWS_AS((void)redistribution_by::elements{.super_elements = 0}(mesh, 2), usage_error);
  CHECK_THROWS_AS((void)redistribution_by::elements{.seam_weight = 0}(mesh, 2), usage_error);
  const auto turned =
      cubes.spoilt(3, [](mesh_piece& piece) { std::swap(piece.mesh.elements[0], piece.mesh.elements[1]); });
  CHECK(hash_by_place(*by_elements(turned, 2).mesh) == hash_by_place(mesh));
  const auto lost =
      cubes.spoilt(3, [](mesh_piece& piece) { piece.mesh.elements[0] = piece.mesh.elements[1]; });
  CHECK_THROWS_WITH_AS((void)by_elements(lost, 2), doctest::Contains("subdomain 3 has no element at side"),
                       mesh_error);
  int loads = 0;
  mesh.load = [load = mesh.load, &loads](local_id p) {
    auto piece = load(p);
    if (p == 5 && ++loads > 1)
      piece.mesh.tags[0] = 7;
    return piece;
  };
  CHECK_THROWS_WITH_AS((void)by_elements(mesh, 2),
                       "elements were changed or lost on their way to other pieces", mesh_error);
  mesh.mid_nodes = std::make_shared<mid_edge_nodes<3>>();
  CHECK_THROWS_AS((void)by_elements(mesh, 2), usage_error);
}
