/// Second-order elements: on the CAD model, the same from both sides, never inverted, of fourth order in
/// volume, and read by Gmsh and VTK.
#include "files/scratch_folder.hpp"
#include "files/stacked_cubes.hpp"

#include "dovetail/adapters/tetgen.hpp"
#include "dovetail/distributed/processes.hpp"
#include "dovetail/files/finishing_pass.hpp"
#include "dovetail/files/msh_writer.hpp"
#include "dovetail/files/vtu_writer.hpp"
#include "dovetail/mesh/mesh_hash.hpp"
#include "dovetail/models/implicit/shapes.hpp"
#include "dovetail/models/implicit_model.hpp"
#include "dovetail/models/plane/svg_path.hpp"
#include "dovetail/models/plane_domain.hpp"
#include "dovetail/parallel/checkpointed.hpp"
#include "dovetail/parallel/threads.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/sizing/uniform.hpp"
#include "dovetail/solver/pvtu_format.hpp"
#include "dovetail/solver/rank_files.hpp"
#include "dovetail/solver/rank_msh_format.hpp"
#include "dovetail/solver/second_order.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <gmsh.h>
#include <numbers>
#include <set>
#include <string>
#include <tuple>
#include <vector>

using namespace dovetail;

namespace {

const implicit_model ball(implicit::sphere{}, {{-1.5, -1.5, -1.5}, {1.5, 1.5, 1.5}}, {.resolution = 24});

template <int D>
generated<D> ball_of(double size, int subdomains) {
  return generate<D>(ball, uniform_size(size),
                     parameters<>{}.with_mesher(mesher::tetgen{}).with_options({.subdomains = subdomains}));
}
template <>
generated<2> ball_of<2>(double size, int subdomains) {
  return generate<2>(ball, uniform_size(size), parameters<>{}.with_options({.subdomains = subdomains}));
}

/// Derivatives of the map of an element by barycentric coordinates 1 .. D, at a place.
template <int D>
std::array<vec3, D> derivatives(const std::array<vec3, quadratic_nodes<D>>& nodes,
                                const std::array<double, D + 1>& at) {
  std::array<vec3, D + 1> by{};
  for (std::size_t i = 0; i <= D; ++i)
    by[i] += (4 * at[i] - 1) * nodes[i];
  for (std::size_t e = 0; e < edges_per_element<D>; ++e) {
    const auto a = static_cast<std::size_t>(numbering::edges<D>[e][0]);
    const auto b = static_cast<std::size_t>(numbering::edges<D>[e][1]);
    by[a] += 4 * at[b] * nodes[D + 1 + e];
    by[b] += 4 * at[a] * nodes[D + 1 + e];
  }
  std::array<vec3, D> columns;
  for (std::size_t i = 0; i < D; ++i)
    columns[i] = by[i + 1] - by[0];
  return columns;
}
double determinant(const std::array<vec3, 10>& nodes, const std::array<double, 4>& at) {
  const auto [u, v, w] = derivatives<3>(nodes, at);
  return dot(cross(u, v), w);
}

template <int D>
std::array<vec3, quadratic_nodes<D>> nodes_of(const std::vector<vec3>& points,
                                              const quadratic_simplex<D>& element) {
  std::array<vec3, quadratic_nodes<D>> nodes;
  for (std::size_t k = 0; k < nodes.size(); ++k)
    nodes[k] = points[element[k]];
  return nodes;
}

/// Exact: the determinant is a cubic polynomial.
double volume(const io::second_order_mesh<3>& mesh) {
  double sum = 0;
  for (const auto& element : mesh.elements) {
    const auto nodes = nodes_of<3>(mesh.points, element);
    sum -= 4.0 / 5 / 6 * determinant(nodes, {0.25, 0.25, 0.25, 0.25});
    for (std::size_t i = 0; i < 4; ++i) {
      std::array<double, 4> at{1.0 / 6, 1.0 / 6, 1.0 / 6, 1.0 / 6};
      at[i] = 0.5;
      sum += 9.0 / 20 / 6 * determinant(nodes, at);
    }
  }
  return sum;
}

double volume(const simplicial_mesh<3>& mesh) {
  double sum = 0;
  for (const auto& [a, b, c, d] : mesh.elements) {
    const auto at = [&](local_id v) { return mesh.points[v]; };
    sum += signed_volume(at(a), at(b), at(c), at(d));
  }
  return sum;
}

using coordinates = std::tuple<double, double, double>;

/// The nodes of all elements, as points, in the order of the elements.
template <int D>
std::vector<coordinates> all_nodes(const distributed_simplicial_mesh<D>& mesh) {
  std::vector<coordinates> nodes;
  for (std::size_t p = 0; p < mesh.counts.size(); ++p) {
    const auto piece = mesh.load(static_cast<local_id>(p));
    const piece_nodes<D> of(mesh, piece);
    for (std::size_t e = 0; e < piece.mesh.elements.size(); ++e)
      for (const local_id v : of.of_element(e)) {
        const auto i = static_cast<std::size_t>(v);
        const auto shared = of.shared().size();
        const vec3 q = i < shared ? skeleton_node(mesh, of.shared()[i]) : of.own()[i - shared];
        nodes.emplace_back(q.x, q.y, q.z);
      }
  }
  return nodes;
}
template <int D>
std::vector<coordinates> all_nodes(const io::second_order_mesh<D>& mesh) {
  std::vector<coordinates> nodes;
  for (const auto& element : mesh.elements)
    for (const vec3 q : nodes_of<D>(mesh.points, element))
      nodes.emplace_back(q.x, q.y, q.z);
  return nodes;
}

/// A plane with the arc of height `bulge` over the x axis between 0 and 1 as an inner line, and two triangles
/// at it, of heights 0.1 above and 1 below.
struct two_at_an_arc {
  explicit two_at_an_arc(double bulge) : domain(drawing(bulge)) {
    const auto& curves = domain.topology().curves;
    for (std::size_t c = 0; c < curves.size(); ++c)
      if (const vec3 p =
              domain.curve_point(static_cast<local_id>(c), 0.5 * (curves[c].t[0] + curves[c].t[1]));
          p.x > 0 && p.x < 1 && std::abs(p.y - bulge) < 1e-6)
        arc = static_cast<local_id>(c);
  }
  static plane_drawing drawing(double bulge) {
    auto all = drawing_from_svg_path("M-5 -5 H5 V5 H-5 Z");
    plane_path line;
    for (int i = 0; i <= 64; ++i)
      line.points.push_back({i / 64.0, 4 * bulge * (i / 64.0) * (1 - i / 64.0)});
    all.lines.push_back(line);
    return all;
  }
  io::gathered_mesh<2> gathered() const {
    io::gathered_mesh<2> whole;
    whole.mesh = {{{0, 0, 0}, {1, 0, 0}, {0.5, 0.1, 0}, {0.5, -1, 0}}, {{0, 1, 2}, {1, 0, 3}}, {0, 0}};
    whole.sides = {{0, 1}};
    whole.side_hosts = {arc};
    return whole;
  }
  distributed_simplicial_mesh<2> distributed() const {
    distributed_simplicial_mesh<2> mesh;
    mesh.skeleton.points = {{0, 0, 0}, {1, 0, 0}, {0.5, 0.1, 0}, {0.5, -1, 0}};
    mesh.skeleton.point_hosts.own().assign(4, {2, 0});
    mesh.skeleton.sides = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {3, 1}};
    mesh.skeleton.subdomains = {{0, 1}, {0, no_id}, {0, no_id}, {1, no_id}, {1, no_id}};
    mesh.skeleton.side_hosts = {arc, no_id, no_id, no_id, no_id};
    mesh.counts = {{0, 0, 1}, {0, 0, 1}};
    mesh.load = [](local_id s) {
      simplicial_piece<2> piece;
      piece.subdomain = s;
      piece.skeleton_points = s == 0 ? std::vector<local_id>{0, 1, 2} : std::vector<local_id>{1, 0, 3};
      piece.mesh = {{{0, 0, 0}, {1, 0, 0}, {0.5, 0.1, 0}}, {{0, 1, 2}}, {0}};
      if (s == 1)
        piece.mesh.points = {{1, 0, 0}, {0, 0, 0}, {0.5, -1, 0}};
      return piece;
    };
    return mesh;
  }
  plane_domain domain;
  local_id arc = no_id;
};

} // namespace

TEST_CASE("the bound of the Jacobian is 1 for straight elements, and below it nowhere else") {
  std::array<vec3, 10> nodes{vec3{0, 0, 0}, vec3{2, 0, 0}, vec3{0.3, 1, 0}, vec3{0.2, 0.4, 0.5}};
  for (std::size_t e = 0; e < 6; ++e)
    nodes[4 + e] = midpoint(nodes[numbering::edges<3>[e][0]], nodes[numbering::edges<3>[e][1]]);
  CHECK(least_jacobian(nodes) == doctest::Approx(1));
  const double straight = determinant(nodes, {0.25, 0.25, 0.25, 0.25});
  nodes[5] -= vec3{0.05, 0.02, -0.06};
  nodes[8] -= vec3{0.03, -0.05, 0.05};
  double least = 1e300;
  for (int i = 0; i <= 10; ++i)
    for (int j = 0; i + j <= 10; ++j)
      for (int k = 0; i + j + k <= 10; ++k)
        least = std::min(least, determinant(nodes, {(10 - i - j - k) / 10.0, i / 10.0, j / 10.0, k / 10.0}));
  CHECK(least_jacobian(nodes) <= least / straight + 1e-12);
  CHECK(least_jacobian(nodes) > least / straight - 0.2); // and near it
  CHECK(least / straight < 0.9);
}

TEST_CASE("a ball's volume is of fourth order, of second with linear elements") {
  std::array<double, 2> linear, quadratic;
  for (int fine = 0; fine < 2; ++fine) {
    const auto whole = io::gather(ball_of<3>(fine == 0 ? 0.4 : 0.2, 3).mesh);
    const auto curved = io::second_order(whole, ball);
    const double exact = 4.0 / 3 * std::numbers::pi;
    linear[fine] = exact - volume(whole.mesh);
    quadratic[fine] = std::abs(exact - volume(curved));
    CHECK(curved.summary.get("on_cad") == 1.5 * static_cast<double>(whole.sides.size()));
    CHECK(curved.summary.get("not_found") == 0);
    std::size_t off = 0; // beyond the edge of a face's chart the model knows its start triangulation alone
    for (const auto& side : curved.sides)
      for (const local_id v : side) {
        const double away = std::abs(norm(curved.points[v]) - 1);
        CHECK(away < 1e-3);
        off += away > 1e-9 ? 1 : 0;
      }
    CHECK(off <= curved.sides.size() / 50);
    for (const auto& element : curved.elements)
      CHECK(least_jacobian(nodes_of<3>(curved.points, element)) >= 0.1);
  }
  MESSAGE("errors of linear elements " << linear[0] << ", " << linear[1] << ", of quadratic ones "
                                       << quadratic[0] << ", " << quadratic[1]);
  CHECK(linear[0] / linear[1] < 6);
  CHECK(quadratic[0] / quadratic[1] > 11);
  CHECK(quadratic[1] < 0.02 * linear[1]);
}

TEST_CASE_TEMPLATE("pieces have the nodes of the gathered mesh, whoever finds them", T,
                   std::integral_constant<int, 3>, std::integral_constant<int, 2>) {
  constexpr int D = T::value;
  const auto mesh = ball_of<D>(0.3, 4).mesh;
  REQUIRE(mesh.counts.size() == 4);
  const auto curved = io::second_order(io::gather(mesh), ball);
  const auto expected = all_nodes(curved);
  for (const any_executor& executor :
       {any_executor(parallel::serial{}), any_executor(parallel::threads{.worker_count = 2}),
        any_executor(parallel::processes{.worker_count = 2})}) {
    auto with_nodes = mesh;
    const auto summary = io::add_mid_nodes(with_nodes, ball, executor);
    CHECK(all_nodes(with_nodes) == expected);
    for (const char* counter : {"nodes", "on_cad", "not_found", "moved_back", "straightened"})
      CHECK(summary.get(counter) == curved.summary.get(counter));
    CHECK(io::mesh_hash(with_nodes) == io::mesh_hash(mesh));
  }
}

TEST_CASE("middles that would invert an element go back by halves, for both elements at the edge") {
  const auto height = [](const io::second_order_mesh<2>& mesh) { return mesh.points[mesh.elements[0][3]].y; };
  const two_at_an_arc flat(0.01);
  const auto untouched = io::second_order(flat.gathered(), flat.domain);
  CHECK(height(untouched) == doctest::Approx(0.01));
  CHECK(untouched.summary.get("moved_back") == 0);

  const two_at_an_arc high(0.15); // over the apex
  REQUIRE(high.arc != no_id);
  const auto moved = io::second_order(high.gathered(), high.domain);
  CHECK(moved.summary.get("moved_back") == 1);
  CHECK(moved.summary.get("straightened") == 0);
  const double halves = std::log2(0.15 / height(moved));
  CHECK(halves == doctest::Approx(std::round(halves)).epsilon(1e-3));
  CHECK(halves > 1);
  for (const auto& element : moved.elements)
    CHECK(least_jacobian(nodes_of<2>(moved.points, element)) >= 0.1);

  auto pieces = high.distributed();
  const auto summary = io::add_mid_nodes(pieces, high.domain);
  CHECK(all_nodes(pieces) == all_nodes(moved));
  CHECK(summary.get("moved_back") == 1);
  CHECK(summary.get("rounds") == 2);
}

TEST_CASE("a run that is resumed takes the nodes that it has kept") {
  const testing::scratch_folder folder("second_order_store");
  const two_at_an_arc arc(0.15);
  const any_executor keeps =
      parallel::checkpointed(parallel::serial{}, spool::start(folder / "spool", {{"test", "1"}}));
  auto first = arc.distributed();
  io::add_mid_nodes(first, arc.domain, keeps);
  auto second = arc.distributed();
  second.load = [](local_id) -> simplicial_piece<2> { throw mesh_error("given up"); };
  CHECK(io::add_mid_nodes(second, arc.domain, keeps).get("moved_back") == 1);
  CHECK(second.mid_nodes->points == first.mid_nodes->points);
  CHECK(second.mid_nodes->inner == first.mid_nodes->inner);
  CHECK_THROWS_AS(io::add_mid_nodes(second, arc.domain, parallel::serial{}), mesh_error);
}

TEST_CASE_TEMPLATE("Gmsh reads the elements, with positive Jacobians and the ball's volume or area", T,
                   std::integral_constant<int, 3>, std::integral_constant<int, 2>) {
  constexpr int D = T::value;
  auto mesh = ball_of<D>(0.3, 3).mesh;
  const auto summary = io::add_mid_nodes(mesh, ball);
  const testing::scratch_folder folder("second_order_gmsh");
  io::msh_writer{}(mesh, folder);
  std::vector<std::vector<std::string>> meshes{{"mesh.msh"}};
  if constexpr (D == 3) {
    io::partitioned_msh_writer{.binary = false}(mesh, folder);
    meshes.push_back({"mesh_partitioned.msh"});
    io::rank_writer<io::rank_msh_format>{.ranks = 2}(mesh, folder);
    meshes.push_back({"ranks_1.msh", "ranks_2.msh"});
  }
  for (const auto& files : meshes) {
    gmsh::initialize();
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::logger::start();
    gmsh::open((folder / files.front()).string());
    for (std::size_t f = 1; f < files.size(); ++f)
      gmsh::merge((folder / files[f]).string());
    std::vector<std::string> log;
    gmsh::logger::get(log);
    gmsh::logger::stop();
    for (const auto& line : log)
      CHECK_MESSAGE((line.starts_with("Info") || line.starts_with("Progress")), line);
    std::vector<int> types;
    gmsh::model::mesh::getElementTypes(types, D);
    CHECK(types == std::vector<int>{D == 3 ? 11 : 9});
    gmsh::model::mesh::getElementTypes(types, D - 1);
    CHECK((D == 2 || types == std::vector<int>{9}));
    const int type = D == 3 ? 11 : 9;
    std::vector<double> places, weights, jacobians, determinants, points;
    gmsh::model::mesh::getIntegrationPoints(type, "Gauss4", places, weights);
    gmsh::model::mesh::getJacobians(type, places, jacobians, determinants, points);
    double measure = 0;
    for (std::size_t i = 0; i < determinants.size(); ++i)
      measure += weights[i % weights.size()] * determinants[i];
    CHECK(*std::min_element(determinants.begin(), determinants.end()) > 0);
    CHECK(measure ==
          doctest::Approx(D == 3 ? 4.0 / 3 * std::numbers::pi : 4 * std::numbers::pi).epsilon(3e-4));
    std::vector<std::size_t> nodes;
    std::vector<double> parameters;
    gmsh::model::mesh::getNodes(nodes, points, parameters);
    const auto all_nodes = std::set(nodes.begin(), nodes.end()).size();
    CHECK((files.size() > 1 || all_nodes == nodes.size())); // several files have what they share each
    global_id corners = static_cast<global_id>(mesh.skeleton.points.size());
    for (const auto& piece : mesh.counts)
      corners += piece.inner_points;
    CHECK(static_cast<double>(all_nodes) == static_cast<double>(corners) + summary.get("nodes"));
    gmsh::finalize();
  }
}

TEST_CASE_TEMPLATE("VTK reads the elements, which share their nodes and have positive Jacobians", T,
                   std::integral_constant<int, 3>, std::integral_constant<int, 2>) {
  if (std::system("/usr/bin/python3 -c 'import vtkmodules.vtkIOXML, numpy' > /dev/null 2>&1") != 0) {
    MESSAGE("skipped: python3-vtk9 is not installed");
    return;
  }
  constexpr int D = T::value;
  auto mesh = ball_of<D>(0.3, 3).mesh;
  const auto summary = io::add_mid_nodes(mesh, ball);
  const testing::scratch_folder folder("second_order_vtk");
  io::finish_mesh<D>(mesh, {io::vtu_writer{.files = 2}}, folder, parallel::processes{.worker_count = 2});
  io::rank_writer<io::pvtu_format>{.ranks = 2}(mesh, folder);
  const auto log = folder / "check.txt";
  global_id nodes = static_cast<global_id>(mesh.skeleton.points.size());
  for (const auto& piece : mesh.counts)
    nodes += piece.inner_points;
  nodes += static_cast<global_id>(summary.get("nodes"));
  for (const char* file : {"mesh.pvtu", "ranks.pvtu"}) {
    const int status =
        std::system(("/usr/bin/python3 " DOVETAIL_TESTS "/check_second_order.py '" +
                     (folder / file).string() + "' " + std::to_string(nodes) + " " +
                     std::to_string(D == 3 ? 4.0 / 3 * std::numbers::pi : 4 * std::numbers::pi) + " > '" +
                     log.string() + "' 2>&1")
                        .c_str());
    INFO(testing::file_content(log));
    CHECK(status == 0);
  }
}
