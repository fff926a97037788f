// A model that is not thread-safe, meshed in threads: each of its objects answers the thread that made it.
#include "dovetail/mesh/mesh_hash.hpp"
#include "dovetail/models/implicit/shapes.hpp"
#include "dovetail/models/implicit_model.hpp"
#include "dovetail/parallel/serial.hpp"
#include "dovetail/parallel/threads.hpp"
#include "dovetail/partition/inertial.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/sizing/uniform.hpp"

#include <doctest/doctest.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <thread>
#include <type_traits>
#include <utility>

using namespace dovetail;

namespace {

/// Two shapes that meet in a curve. Counts the queries in another thread than that in which the object was
/// made: a kernel that fills caches would answer them wrongly now and then.
class model_of_one_thread {
public:
  explicit model_of_one_thread(std::shared_ptr<std::atomic<int>> strays)
      : model_(implicit::intersection(implicit::sphere{}, implicit::torus{}, 0.2),
               {{-1.5, -1.5, -1.5}, {1.5, 1.5, 1.5}}, {.resolution = 32}),
        strays_(std::move(strays)) {}
  model_of_one_thread(const model_of_one_thread& other) : model_(other.model_), strays_(other.strays_) {}
  model_of_one_thread& operator=(const model_of_one_thread&) = delete;
  ~model_of_one_thread() = default;

  const geometry_topology& topology() const { return model_.topology(); }
  box3 bounds() const { return model_.bounds(); }
  bool thread_safe() const { return false; }

  vec3 curve_point(local_id c, double t) const { return asked().curve_point(c, t); }
  dovetail::curve_frame curve_frame(local_id c, double t) const { return asked().curve_frame(c, t); }
  vec2 curve_uv(local_id f, int k, double t) const { return asked().curve_uv(f, k, t); }
  vec3 face_point(local_id f, vec2 uv) const { return asked().face_point(f, uv); }
  surface_frame face_frame(local_id f, vec2 uv) const { return asked().face_frame(f, uv); }
  double face_curvature(local_id f, vec2 uv) const { return asked().face_curvature(f, uv); }
  vec2 project_to_face(local_id f, vec3 p, vec2 seed) const { return asked().project_to_face(f, p, seed); }
  double project_to_curve(local_id c, vec3 p, double seed) const {
    return asked().project_to_curve(c, p, seed);
  }

private:
  const implicit_model& asked() const {
    if (std::this_thread::get_id() != made_in_)
      ++*strays_;
    return model_;
  }

  implicit_model model_;
  std::shared_ptr<std::atomic<int>> strays_;
  std::thread::id made_in_ = std::this_thread::get_id();
};

static_assert(geometry_model<model_of_one_thread>);

/// A mesh's hash, and the queries in other threads.
template <int D>
std::pair<std::uint64_t, int> made_by(const any_executor& run) {
  const auto strays = std::make_shared<std::atomic<int>>(0);
  generate_options options;
  options.subdomains = 4;
  const auto made = generate<D>(
      model_of_one_thread(strays), uniform_size(0.2),
      parameters<>{}.with_partitioner(partition::inertial{}).with_executor(run).with_options(options));
  REQUIRE(made.failures.empty());
  REQUIRE(made.mesh.counts.size() > 2);
  return {io::mesh_hash(made.mesh), strays->load()};
}

} // namespace

TEST_CASE_TEMPLATE("threads ask no object of a model that another one made", D,
                   std::integral_constant<int, 2>, std::integral_constant<int, 3>) {
  const auto [by_threads, strays] = made_by<D::value>(parallel::threads{.worker_count = 3});
  CHECK(strays == 0);
  CHECK(by_threads == made_by<D::value>(parallel::serial{}).first);
}
