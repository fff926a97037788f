#include "pipeline/decomposed_shell.hpp"
#include "pipeline/plane_meshes.hpp"

#include "dovetail/core/error.hpp"
#include "dovetail/decomposition/skeleton_part.hpp"
#include "dovetail/mesh/distributed_validity.hpp"
#include "dovetail/mesh/mid_nodes.hpp"
#include "dovetail/mesh/selected_pieces.hpp"
#include "dovetail/mesher/native.hpp"
#include "dovetail/models/occt_model.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/pipeline/only.hpp"
#include "dovetail/sizing/uniform.hpp"
#include "support/refusal.hpp"

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <set>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

using namespace dovetail;
using dovetail::testing::in_parts;

namespace {

/// A box with a spherical dent.
occt_model dented_box() {
  return occt_shape_from(BRepAlgoAPI_Cut(BRepPrimAPI_MakeBox(2.0, 1.0, 1.0).Shape(),
                                         BRepPrimAPI_MakeSphere(gp_Pnt(0.7, 0.5, 1.0), 0.3).Shape())
                             .Shape())
      .model;
}
occt_model pipe() {
  return occt_shape_from(BRepPrimAPI_MakeCylinder(1.0, 3.0).Shape()).model;
}

generate_options parts_with(int parts, std::vector<local_id> only) {
  generate_options options = in_parts(parts);
  options.only = std::move(only);
  return options;
}

template <int D>
generated<D> mesh_parts(const std::vector<local_id>& only) {
  const auto how = parameters<>{}.with_options(parts_with(6, only));
  if constexpr (D == 3)
    return generate<3>(dented_box(), uniform_size(0.12), how);
  else
    return generate<2>(pipe(), uniform_size(0.2), how);
}

/// The sides of some pieces: their corners' places, in order, and their host. A side between two of them
/// once.
template <int D>
auto sides_of(const distributed_simplicial_mesh<D>& mesh, const std::set<local_id>& pieces) {
  using place = std::tuple<double, double, double>;
  std::multiset<std::pair<std::array<place, D>, local_id>> sides;
  for (std::size_t s = 0; s < mesh.skeleton.sides.size(); ++s) {
    const auto [behind, front] = mesh.skeleton.subdomains[s];
    if (!pieces.contains(behind) && !pieces.contains(front))
      continue;
    std::array<place, D> corners;
    for (std::size_t k = 0; k < D; ++k) {
      const vec3 p = mesh.skeleton.points[mesh.skeleton.sides[s][k]];
      corners[k] = {p.x, p.y, p.z};
    }
    std::sort(corners.begin(), corners.end());
    sides.insert({corners, mesh.skeleton.side_hosts[s]});
  }
  return sides;
}

/// The hosts of points and the edges on curves, by places.
template <int D>
auto hosts_of(const simplicial_skeleton<D>& skeleton) {
  std::map<std::tuple<double, double, double>, std::pair<int, local_id>> hosts;
  for (std::size_t v = 0; v < skeleton.points.size(); ++v) {
    const vec3 p = skeleton.points[v];
    hosts[{p.x, p.y, p.z}] = {skeleton.point_hosts[v].dimension, skeleton.point_hosts[v].id};
  }
  return hosts;
}

template <int D>
void require_as_in_whole() {
  const generated<D> whole = mesh_parts<D>({});
  REQUIRE(whole.failures.empty());
  REQUIRE(whole.mesh.counts.size() == 6);
  const std::vector<local_id> wanted{1, 4, 5};
  const generated<D> some = mesh_parts<D>(wanted);
  REQUIRE(some.failures.empty());
  CHECK(some.subdomains == 6);
  REQUIRE(some.mesh.counts.size() == wanted.size());
  CHECK_MESSAGE(io::check_distributed<D>(some.mesh).valid(), io::check_distributed<D>(some.mesh).text());

  global_id elements = 0;
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    const auto made = some.mesh.load(static_cast<local_id>(k));
    const auto expected = whole.mesh.load(wanted[k]);
    CHECK(made.subdomain == static_cast<local_id>(k));
    CHECK(made.mesh.points == expected.mesh.points);
    CHECK(made.mesh.elements == expected.mesh.elements);
    CHECK(made.mesh.tags == expected.mesh.tags);
    elements += some.mesh.counts[k].elements;
    CHECK(some.mesh.counts[k].elements == whole.mesh.counts[wanted[k]].elements);
    REQUIRE(some.mesh.quality[k].at_interfaces);
    CHECK(some.mesh.quality[k].all.min_dihedral_deg == whole.mesh.quality[wanted[k]].all.min_dihedral_deg);
  }
  CHECK(some.quality.elements == elements);
  CHECK(sides_of<D>(some.mesh, {0, 1, 2}) == sides_of<D>(whole.mesh, {1, 4, 5}));
  CHECK(some.mesh.skeleton.points.size() < whole.mesh.skeleton.points.size());
  const auto hosts = hosts_of<D>(whole.mesh.skeleton);
  for (const auto& [place, host] : hosts_of<D>(some.mesh.skeleton))
    CHECK(hosts.at(place) == host);
  if constexpr (D == 3) { // of its edges on curves those that its pieces touch
    std::set<std::array<local_id, 2>> edges;
    for (const auto& [a, b, c] : some.mesh.skeleton.sides)
      for (const auto& edge : {std::array{a, b}, std::array{b, c}, std::array{c, a}})
        edges.insert({std::min(edge[0], edge[1]), std::max(edge[0], edge[1])});
    const auto& on_curves = some.mesh.skeleton.curve_edges;
    REQUIRE(!on_curves.empty());
    CHECK(on_curves.size() == some.mesh.skeleton.curves.size());
    CHECK(on_curves.size() < whole.mesh.skeleton.curve_edges.size());
    for (const auto& [a, b] : on_curves)
      CHECK(edges.contains({std::min(a, b), std::max(a, b)}));
  }
}

/// What a mesh is made of whose pieces are made alone, and the whole of it.
struct divided_model {
  any_geometry model;
  double size = 0;
  generate_options options;

  generated<3> mesh(std::vector<local_id> only) const {
    generate_options given = options;
    given.repartition_locally = false;
    given.alone = !only.empty();
    given.only = std::move(only);
    return generate<3>(model, uniform_size(size), parameters<>{}.with_options(given));
  }
};

auto warnings_of_unseen(const generated<3>& made) {
  const auto& warnings = made.summary.children[5].warnings;
  return std::count_if(warnings.begin(), warnings.end(),
                       [](const auto& text) { return testing::has(text, "made in other runs may not fit"); });
}

bool is_same_piece(const distributed_mesh& one, const distributed_mesh& other, local_id k) {
  const auto a = one.load(0), b = other.load(k);
  return a.mesh.points == b.mesh.points && a.mesh.elements == b.mesh.elements && a.mesh.tags == b.mesh.tags;
}

/// The native mesher, which fails in large pieces.
struct refuses_large_pieces {
  static constexpr mesher_traits traits = mesher::native::traits;
  std::size_t most_sides = 0;

  refuses_large_pieces for_background() const { return {}; }
  mesher_result<3> operator()(const mesher_input<3>& input, const any_sizing& size) const {
    if (most_sides > 0 && input.boundary.elements.size() > most_sides)
      throw mesher_error("too large for this test");
    return mesher::native{}(input, size);
  }
};

} // namespace

TEST_CASE("some pieces of tetrahedra are bit for bit as in the whole mesh") {
  require_as_in_whole<3>();
}
TEST_CASE("some pieces of triangles are bit for bit as in the whole mesh") {
  require_as_in_whole<2>();
}

TEST_CASE("a piece made alone is as in the whole mesh, of whose skeleton less is made") {
  const divided_model box{any_geometry(dented_box()), 0.05, in_parts(100)};
  const auto whole = box.mesh({});
  REQUIRE(whole.failures.empty());
  REQUIRE(whole.mesh.counts.size() == 100);
  const auto counts_of = [](const generated<3>& made) {
    return made.summary.children[3].as<skeleton_counts>();
  };
  REQUIRE(counts_of(whole).matched_lines > 0);
  std::size_t most_triangles = 0;
  for (local_id k = 0; k < 100; k += 9) {
    const auto alone = box.mesh({k});
    REQUIRE(alone.failures.empty());
    REQUIRE(alone.mesh.counts.size() == 1);
    CHECK(alone.subdomains == 100);
    CHECK(is_same_piece(alone.mesh, whole.mesh, k));
    CHECK(sides_of<3>(alone.mesh, {0}) == sides_of<3>(whole.mesh, {k}));
    CHECK(alone.fine_angles.interface_faces > 0);
    most_triangles = std::max(most_triangles, counts_of(alone).triangles);
  }
  CHECK(most_triangles < 3 * counts_of(whole).triangles / 4);
}

TEST_CASE("around a piece is what may cross it, also across a gap") {
  simplicial_mesh<3> mesh; // three tetrahedra side by side, and two above a gap: a near and a far one
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {1, 1, 0}, {2, 0, 0}};
  mesh.elements = {{0, 1, 2, 3}, {1, 2, 3, 4}, {1, 4, 5, 6}};
  for (const double height : {1.5, 9.0}) {
    const auto first = static_cast<local_id>(mesh.points.size());
    for (const vec3 p : {vec3{0, 0, 0}, vec3{1, 0, 0}, vec3{0, 1, 0}, vec3{0, 0, 1}})
      mesh.points.push_back(p + vec3{0, 0, height});
    mesh.elements.push_back({first, first + 1, first + 2, first + 3});
  }
  const std::vector<local_id> subdomains{0, 1, 2, 3, 4};
  const auto around = points_with_surroundings(mesh, subdomains, std::vector<local_id>{0});
  std::vector<bool> expected(mesh.points.size(), true);
  std::fill(expected.end() - 4, expected.end(), false);
  CHECK(around == expected);
  const std::vector<local_id> alone{0, 1, 1, 2, 2}; // of a subdomain that touches it all points are
  CHECK(points_with_surroundings(mesh, alone, std::vector<local_id>{0}) == expected);
}

TEST_CASE("where all pieces are made alone they are merged as in the whole mesh") {
  divided_model thin{any_geometry(testing::shell(0.992)), 0.2, in_parts(20)};
  thin.options.coarse_scale = testing::flat_in_shells;
  thin.options.largest_merged_fraction = 1;
  std::vector<local_id> all(20);
  std::iota(all.begin(), all.end(), 0);
  const auto whole = thin.mesh({});
  const auto pieces = static_cast<local_id>(whole.mesh.counts.size());
  REQUIRE(pieces < 20);
  CHECK(warnings_of_unseen(whole) == 0);
  const auto alone = thin.mesh(all); // where all are wanted, all is seen
  CHECK(warnings_of_unseen(alone) == 0);
  CHECK(alone.only.size() == alone.mesh.counts.size());
  REQUIRE(alone.mesh.counts.size() == whole.mesh.counts.size());
  for (local_id k = 0; k < pieces; ++k)
    CHECK(alone.mesh.load(k).mesh.points == whole.mesh.load(k).mesh.points);
}

TEST_CASE("a piece that is made alone after merges has another number, and says that others may not fit") {
  divided_model thick{any_geometry(testing::shell(0.95)), 0.2, in_parts(24)};
  thick.options.coarse_scale = testing::flat_in_shells;
  thick.options.largest_merged_fraction = 1;
  const auto whole = thick.mesh({});
  REQUIRE(whole.mesh.counts.size() < 24);
  std::size_t same = 0, renumbered = 0;
  for (const local_id before : {0, 5, 10, 20}) {
    const auto alone = thick.mesh({before});
    REQUIRE(alone.only.size() == 1);
    const local_id now = alone.only.front();
    REQUIRE(now < static_cast<local_id>(alone.subdomains));
    CHECK(warnings_of_unseen(alone) == (alone.subdomains < 24 ? 1 : 0));
    renumbered += now != before ? 1 : 0;
    if (alone.subdomains == whole.subdomains) // it has seen the same crossings
      same += is_same_piece(alone.mesh, whole.mesh, now) ? 1 : 0;
  }
  CHECK(renumbered > 1);
  CHECK(same > 1);
}

TEST_CASE("pieces are not made alone where that cannot be") {
  const auto refusal = [](auto dimension, const generate_options& options) {
    return testing::refusal_of<usage_error>([&] {
      return generate<dimension()>(dented_box(), uniform_size(0.2), parameters<>{}.with_options(options));
    });
  };
  const std::integral_constant<int, 2> plane;
  const std::integral_constant<int, 3> solid;
  generate_options options = parts_with(6, {1});
  options.alone = true;
  CHECK(testing::has(refusal(solid, options), "needs generate_options::repartition_locally = false"));
  options.repartition_locally = false;
  CHECK(testing::has(refusal(plane, options), "is for tetrahedra"));
  options.only = {6};
  CHECK(testing::has(refusal(solid, options), "there is no subdomain 6"));
  options.only = {};
  CHECK(testing::has(refusal(solid, options), "needs subdomains in generate_options::only"));
}

TEST_CASE("a piece that there is not is refused by its number") {
  CHECK(testing::has(testing::refusal_of<usage_error>([] {
                       return mesh_parts<3>({2, 6});
                     }),
                     "there is no subdomain 6: there are 6, numbered from 0"));
  CHECK(testing::has(testing::refusal_of<usage_error>([] { return mesh_parts<3>({-1}); }),
                     "from 0 on that grow, each once"));
  CHECK(testing::has(testing::refusal_of<usage_error>([] {
                       return mesh_parts<3>({2, 1});
                     }),
                     "grow, each once"));
  CHECK(testing::has(testing::refusal_of<usage_error>([] {
                       return mesh_parts<2>({2, 2});
                     }),
                     "grow, each once"));
}

TEST_CASE("who meshes subdomains refuses numbers that there are not, and two of one") {
  const auto refusal = [](std::vector<local_id> wanted) {
    const meshing_options options{.wanted = std::move(wanted)};
    return testing::refusal_of<usage_error>([&] {
      return mesh_subdomains<3>(
          2, [](local_id) { return subdomain_input{}; }, mesher::native{}, improvement::native{},
          refined_sizing{any_sizing(uniform_size(1))}, any_executor(parallel::serial{}), options);
    });
  };
  for (const std::vector<local_id>& wanted : {std::vector<local_id>{2}, {-1}, {0, 0}})
    CHECK(testing::has(refusal(wanted), "subdomains that there are, each once"));
}

TEST_CASE("what makes whole meshes only says so") {
  generate_options options;
  CHECK_NOTHROW(dovetail::detail::refuse_only(options, "this test"));
  options.only = {0};
  CHECK(testing::has(testing::refusal_of<usage_error>([&] {
                       dovetail::detail::refuse_only(options, "this test");
                       return 0;
                     }),
                     "this test makes whole meshes"));
}

TEST_CASE("pieces are selected of those that there are, each once, in order") {
  const auto whole = mesh_parts<3>({});
  const auto refusal = [&](const std::vector<local_id>& wanted, const distributed_mesh& mesh) {
    return testing::refusal_of<usage_error>([&] { return selected_pieces<3>(mesh, wanted); });
  };
  CHECK(testing::has(refusal({0, 6}, whole.mesh), "there is no piece 6; the mesh has 6"));
  CHECK(testing::has(refusal({-1}, whole.mesh), "there is no piece -1"));
  CHECK(testing::has(refusal({1, 1}, whole.mesh), "must grow"));
  CHECK(testing::has(refusal({2, 1}, whole.mesh), "must grow"));
  distributed_mesh with_nodes = whole.mesh;
  with_nodes.mid_nodes = std::make_shared<const mid_edge_nodes<3>>();
  CHECK(testing::has(refusal({1}, with_nodes), "before mid-edge nodes are added"));
}

TEST_CASE("what is given up, and what is asked for then, has the numbers of the whole") {
  auto whole = mesh_parts<3>({}).mesh;
  std::vector<local_id> released, asked;
  whole.release = [&](local_id p, const piece_note&) { released.push_back(p); };
  whole.released = [&](local_id p) {
    asked.push_back(p);
    return std::optional<piece_note>();
  };
  const auto some = selected_pieces<3>(whole, std::vector<local_id>{2, 5});
  some.release(1, {});
  CHECK(!some.released(0));
  CHECK(released == std::vector<local_id>{5});
  CHECK(asked == std::vector<local_id>{2});
  whole.release = {};
  whole.released = {};
  const auto kept = selected_pieces<3>(whole, std::vector<local_id>{2, 5});
  CHECK(!kept.release);
  CHECK(!kept.released);
}

TEST_CASE("wanted pieces that fail are data, and nothing is merged for them") {
  const auto how = [](std::size_t most, std::vector<local_id> only) {
    return parameters<>{}
        .with_mesher(refuses_large_pieces{most})
        .with_options(parts_with(6, std::move(only)));
  };
  const auto all = mesh_parts<3>({});
  std::vector<std::size_t> sides(6, 0);
  for (const auto& beside : all.mesh.skeleton.subdomains)
    for (const local_id s : beside)
      if (s != no_id)
        ++sides[s];
  const auto largest = std::max_element(sides.begin(), sides.end());
  const auto number = static_cast<local_id>(largest - sides.begin());
  const auto made = generate<3>(dented_box(), uniform_size(0.12), how(*largest - 1, {number}));
  CHECK(made.subdomains == 6);
  REQUIRE(made.failures.size() == 1);
  CHECK(made.failures.front().subdomain == number);
  const auto merged = generate<3>(dented_box(), uniform_size(0.12), how(*largest - 1, {}));
  CHECK(merged.subdomains < 6); // where all are wanted, it is
}
