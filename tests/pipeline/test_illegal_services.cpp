#include "dovetail/distributed/processes.hpp"
#include "dovetail/files/finishing_pass.hpp"
#include "dovetail/files/vtu_writer.hpp"
#include "dovetail/mesh/mesh_hash.hpp"
#include "dovetail/models/plane/read.hpp"
#include "dovetail/parallel/serial.hpp"
#include "dovetail/partition/any_partitioner.hpp"
#include "dovetail/partition/greedy.hpp"
#include "dovetail/remesh/any_surface_mesher.hpp"
#include "dovetail/remesh/mesh_regions.hpp"
#include "dovetail/simplification/any_simplification_rule.hpp"
#include "dovetail/simplification/paper.hpp"
#include "files/scratch_folder.hpp"
#include "mesher/surface_mesher_contract.hpp"
#include "pipeline/plane_meshes.hpp"
#include "support/refusal.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <functional>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

using namespace dovetail;
using testing::contains;
using testing::no_number;
using testing::refusal_of;
using testing::unit_square;

namespace {

template <class Model, class Parameters>
generated<2> mesh_in_four(const Model& model, const Parameters& given,
                          const any_sizing& size = uniform_size(0.05)) {
  return generate<2>(model, size, given.with_options({.subdomains = 4}));
}

[[noreturn]] void fail() {
  throw std::out_of_range("no such luck");
}
[[noreturn]] void sleep_for_ever() {
  for (;;)
    std::this_thread::sleep_for(std::chrono::seconds(1));
}

struct throwing_partitioner {
  std::vector<local_id> operator()(const csr_graph&, int) const { fail(); }
};

struct throwing_rule : simplifier::paper {
  template <int D>
  side_judgement operator()(const simplicial_mesh<D>&, const side_table<D>&) const {
    fail();
  }
};

/// Runs tasks one after the other, and changes what it says of them.
struct lying_executor {
  std::function<void(std::vector<task_outcome>&)> change;
  std::vector<task_outcome> run(std::size_t count, const task_function& task,
                                const run_options& options) const {
    auto outcomes = parallel::serial{}.run(count, task, options);
    if (count > 0)
      change(outcomes);
    return outcomes;
  }
  int workers() const { return 1; }
  bool shares_process() const { return true; }
};

enum class square_fault {
  nothing,
  throws,
  throws_no_exception,
  point_is_no_number,
  curve_not_there,
  vertex_not_there,
  solid_not_there,
  no_range,
  coedges_lost,
  vertex_is_no_number,
};

/// The unit square, with one thing wrong.
class wrong_square {
public:
  explicit wrong_square(square_fault how) : how_(how), square_(unit_square()), topology_(square_.topology()) {
    if (how == square_fault::curve_not_there)
      topology_.faces[0].loops[0][1].curve = topology_.faces[0].coedges[1].curve = 99;
    if (how == square_fault::vertex_not_there)
      topology_.curves[2].vertices[0] = -1;
    if (how == square_fault::solid_not_there)
      topology_.faces[0].solids[0] = 5;
    if (how == square_fault::no_range)
      topology_.curves[3].t = {1, 1};
    if (how == square_fault::coedges_lost)
      topology_.faces[0].coedges.pop_back();
    if (how == square_fault::vertex_is_no_number)
      topology_.vertices[1].point.y = no_number;
  }
  const geometry_topology& topology() const { return topology_; }
  vec3 curve_point(local_id c, double t) const { return square_.curve_point(c, t); }
  dovetail::curve_frame curve_frame(local_id c, double t) const { return square_.curve_frame(c, t); }
  vec2 curve_uv(local_id f, int k, double t) const { return square_.curve_uv(f, k, t); }
  vec3 face_point(local_id f, vec2 uv) const { return spoilt(square_.face_point(f, uv)); }
  surface_frame face_frame(local_id f, vec2 uv) const {
    surface_frame frame = square_.face_frame(f, uv);
    frame.point = spoilt(frame.point);
    return frame;
  }
  double face_curvature(local_id f, vec2 uv) const { return square_.face_curvature(f, uv); }
  vec2 project_to_face(local_id f, vec3 p, vec2 uv) const { return square_.project_to_face(f, p, uv); }
  double project_to_curve(local_id c, vec3 p, double t) const { return square_.project_to_curve(c, p, t); }
  box3 bounds() const { return square_.bounds(); }
  bool thread_safe() const { return true; }

private:
  vec3 spoilt(vec3 p) const {
    const bool inside = p.x > 0.3 && p.x < 0.7 && p.y > 0.3 && p.y < 0.7;
    if (inside && how_ == square_fault::throws)
      fail();
    if (inside && how_ == square_fault::throws_no_exception)
      throw 7;
    if (inside && how_ == square_fault::point_is_no_number)
      return {p.x, p.y, no_number};
    return p;
  }

  square_fault how_;
  plane_domain square_;
  geometry_topology topology_;
};

std::string complaint_of_square(square_fault how) {
  return refusal_of<geometry_error>([&] { mesh_in_four(wrong_square(how), parameters<>{}); });
}

/// VTU files, with one thing wrong.
struct wrong_writer {
  std::function<void(io::piecewise_output<2>&)> change;
  io::piecewise_output<2> begin(const distributed_simplicial_mesh<2>& mesh,
                                const std::filesystem::path& unfinished) const {
    auto output = io::vtu_writer{}.begin(mesh, unfinished);
    change(output);
    return output;
  }
};

std::size_t files_in(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

/// What is said of a writer when it ends in such an error, which leaves nothing behind.
template <class Error>
std::string complaint_of_writer(const std::function<void(io::piecewise_output<2>&)>& change,
                                const any_executor& run = parallel::serial{}) {
  static const auto mesh = mesh_in_four(unit_square(), parameters<>{}).mesh;
  const testing::scratch_folder folder("wrong_writer");
  std::string said = refusal_of<Error>(
      [&] { io::finish_mesh<2>(mesh, {wrong_writer{change}}, folder, run, {.limit_seconds = 0.3}); });
  CHECK((said == "accepted" || files_in(folder) == 0));
  return said;
}

/// The native mesher, whose result is changed.
std::string complaint_of_surface_mesher(const std::function<void(patch_mesh&)>& change) {
  const auto plane = contract::plane_at_run_time();
  surface_region region;
  contract::add_loop(region.boundary, plane, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 0.2);
  const auto mine = [&](const any_surface& surface, const patch_boundary& boundary, const any_sizing& size) {
    patch_mesh made = remesh::patch_remesher{}(surface, boundary, size);
    change(made);
    return made;
  };
  return refusal_of<mesher_error>(
      [&] { mesh_region(any_surface_mesher(mine, "mine"), plane, region, [](vec3) { return 0.2; }, {}); });
}

} // namespace

TEST_CASE("what a partitioner, a rule or sizes throw becomes an error that names them") {
  CHECK(refusal_of<partition_error>([] {
          mesh_in_four(unit_square(),
                       parameters<>{}.with_partitioner(any_partitioner(throwing_partitioner{}, "mine")));
        }) == "the partitioner 'mine' threw: no such luck");
  CHECK(refusal_of<usage_error>([] {
          mesh_in_four(unit_square(),
                       parameters<>{}.with_simplifier(any_simplification_rule(throwing_rule{}, "mine")));
        }) == "the simplification rule 'mine' threw: no such luck");
  const any_sizing size = [](vec3 p) { return p.x > 0.8 ? throw std::out_of_range("no such luck") : 0.05; };
  const std::string said =
      refusal_of<sizing_error>([&] { mesh_in_four(unit_square(), parameters<>{}, size); });
  CHECK(contains(said, "the size at ("));
  CHECK(contains(said, "threw: no such luck"));
}

TEST_CASE("an executor that breaks its promises is refused by name") {
  const auto run_by = [](const std::function<void(std::vector<task_outcome>&)>& change) {
    return refusal_of<error>([&] {
      mesh_in_four(unit_square(), parameters<>{}.with_executor(any_executor(lying_executor{change}, "mine")));
    });
  };
  CHECK(run_by([](auto&) {}) == "accepted");
  CHECK(contains(run_by([](auto& outcomes) { outcomes.pop_back(); }), "the executor 'mine' gave "));
  CHECK(contains(run_by([](auto& outcomes) { outcomes.emplace_back(); }), "the executor 'mine' gave "));
  CHECK(contains(run_by([](auto& outcomes) { outcomes.clear(); }), "the executor 'mine' gave 0 outcomes"));
  CHECK(run_by([](auto&) { fail(); }) == "the executor 'mine' threw: no such luck");
  CHECK(contains(run_by([](auto& outcomes) { outcomes.back().result.clear(); }),
                 "another result than it returned"));
  CHECK(contains(run_by([](auto& outcomes) { std::swap(outcomes.front(), outcomes.back()); }),
                 "another result than it returned"));
  CHECK(run_by([](auto& outcomes) {
          for (auto& outcome : outcomes) {
            outcome.ok = false;
            outcome.failure = "no such luck";
          }
        }) != "accepted");
}

TEST_CASE("a geometry that is none is refused, with the entity") {
  CHECK(complaint_of_square(square_fault::nothing) == "accepted");
  CHECK(contains(complaint_of_square(square_fault::curve_not_there),
                 "face 0 is bounded by curve 99, which does not exist"));
  CHECK(contains(complaint_of_square(square_fault::vertex_not_there),
                 "curve 2 ends at vertex -1, which does not exist"));
  CHECK(contains(complaint_of_square(square_fault::solid_not_there),
                 "face 0 bounds solid 5, which does not exist"));
  CHECK(contains(complaint_of_square(square_fault::no_range), "curve 3 has no parameter range"));
  CHECK(contains(complaint_of_square(square_fault::coedges_lost), "face 0 has 4 coedges in its loops and 3"));
  CHECK(contains(complaint_of_square(square_fault::vertex_is_no_number), "vertex 1 has a coordinate"));
  CHECK(contains(complaint_of_square(square_fault::point_is_no_number),
                 "face 0 has a point that is not finite"));
  CHECK(contains(complaint_of_square(square_fault::throws), "face 0 threw: no such luck"));
  CHECK(contains(complaint_of_square(square_fault::throws_no_exception),
                 "face 0 threw what is no std::exception"));
}

TEST_CASE("a writer that breaks its promises is refused, and leaves nothing") {
  CHECK(complaint_of_writer<error>([](auto&) {}) == "accepted");
  const auto refused = [](const auto& change) { return complaint_of_writer<usage_error>(change); };
  CHECK(contains(refused([](auto& out) { out.bounds.pop_back(); }), "do not take pieces 0 to 3"));
  CHECK(contains(refused([](auto& out) { out.bounds = {}; }), "do not take pieces 0 to 3"));
  CHECK(contains(refused([](auto& out) { std::swap(out.bounds[1], out.bounds[2]); }), "do not take pieces"));
  CHECK(contains(refused([](auto& out) { out.names.pop_back(); }), "3 names for 4 files"));
  CHECK(contains(refused([](auto& out) { out.open = {}; }), "does not say how"));
  CHECK(contains(refused([](auto& out) { out.finish = {}; }), "does not say how"));
  for (const any_executor& run : {any_executor(parallel::serial{}), any_executor(parallel::processes{2})}) {
    const auto failed = [&](const auto& change) { return complaint_of_writer<io_error>(change, run); };
    CHECK(failed([](auto&) { fail(); }) == "the writer threw: no such luck");
    CHECK(contains(failed([](auto& out) { out.open = [](std::size_t) -> io::piece_file<2> { fail(); }; }),
                   "could not be written: no such luck"));
    CHECK(contains(failed([](auto& out) { out.open = [](std::size_t) { return io::piece_file<2>{}; }; }),
                   "subdomain 0 could not be written: "));
    CHECK(failed([](auto& out) {
            out.others = {{"the map of rank 7", [] { fail(); }}};
          }) == "the map of rank 7 could not be written: no such luck");
    CHECK(failed([](auto& out) {
            out.counts = {{"the share of rank 7", []() -> byte_buffer { fail(); }}};
          }) == "the share of rank 7 could not be written: no such luck");
    CHECK(failed([](auto& out) {
            out.counts = {{"", [] { return byte_buffer(); }}};
            out.prepare = [](const auto&) { fail(); };
          }) == "the writer threw: no such luck");
    CHECK(failed([](auto& out) { out.finish = [](const auto&) -> report { fail(); }; }) ==
          "the writer threw: no such luck");
  }
  CHECK(complaint_of_writer<io_error>(
            [](auto& out) {
              out.others = {{"the map of rank 7", [] { std::abort(); }}};
            },
            parallel::processes{2}) ==
        "the map of rank 7 could not be written: the worker was ended by signal 6 (Aborted); run again from "
        "what is kept, with fewer workers where memory is short");
  CHECK(contains(complaint_of_writer<io_error>(
                     [](auto& out) { out.open = [](std::size_t) -> io::piece_file<2> { sleep_for_ever(); }; },
                     parallel::processes{2}),
                 "subdomain 0 could not be written: "));
}

TEST_CASE("a surface mesher that breaks its promises is refused by name") {
  CHECK(complaint_of_surface_mesher([](auto&) {}) == "accepted");
  const auto refused = [](const auto& change) { return complaint_of_surface_mesher(change); };
  CHECK(refused([](auto&) { fail(); }) == "the surface mesher 'mine' threw: no such luck");
  const std::string mine = "the surface mesher 'mine': ";
  CHECK(refused([](auto& made) { made.inner_points.pop_back(); }) ==
        mine + "its triangles name points that do not exist");
  CHECK(refused([](auto& made) { made.triangles[0][0] = 1 << 30; }) ==
        mine + "its triangles name points that do not exist");
  const std::string moved = mine + "its point 0 is not where its parameters are on the surface";
  CHECK(refused([](auto& made) { made.inner_points[0].z += 0.1; }) == moved);
  CHECK(refused([](auto& made) { made.inner_points[0].z = no_number; }) == moved);
  CHECK(refused([](auto& made) { made.inner_uv[0].x = no_number; }) == moved);
  CHECK(contains(refused([](auto& made) { made.triangles.push_back(made.triangles[0]); }), mine));
  CHECK(contains(refused([](auto& made) { std::swap(made.triangles[0][0], made.triangles[0][1]); }), mine));
  CHECK(contains(refused([](auto& made) {
                   const auto inner =
                       std::find_if(made.triangles.begin(), made.triangles.end(),
                                    [](const auto& t) { return t[0] >= 20 && t[1] >= 20 && t[2] >= 20; });
                   made.triangles.erase(inner == made.triangles.end() ? made.triangles.begin() : inner);
                 }),
                 mine));
  CHECK(contains(refused([](auto& made) { made.triangles.clear(); }), mine));
}
