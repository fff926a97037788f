// A wrapper of each role has all that the wrapped policy has, and nothing that it has not.
#include "archetypes.hpp"

#include "dovetail/distributed/wraps.hpp"
#include "dovetail/files/vtu_writer.hpp"
#include "dovetail/files/wraps.hpp"
#include "dovetail/geometry/wraps.hpp"
#include "dovetail/improver/native.hpp"
#include "dovetail/improver/wraps.hpp"
#include "dovetail/mesher/any_mesher.hpp"
#include "dovetail/mesher/background_form.hpp"
#include "dovetail/mesher/native.hpp"
#include "dovetail/mesher/wraps.hpp"
#include "dovetail/models/plane_domain.hpp"
#include "dovetail/models/virtual_model.hpp"
#include "dovetail/parallel/any_executor.hpp"
#include "dovetail/parallel/clock_watch.hpp"
#include "dovetail/parallel/remembering.hpp"
#include "dovetail/parallel/serial.hpp"
#include "dovetail/parallel/threads.hpp"
#include "dovetail/parallel/wraps.hpp"
#include "dovetail/partition/greedy.hpp"
#include "dovetail/partition/wraps.hpp"
#include "dovetail/remesh/any_surface_mesher.hpp"
#include "dovetail/remesh/patch_remesher.hpp"
#include "dovetail/remesh/wraps.hpp"
#include "dovetail/simplification/angles_of_rule.hpp"
#include "dovetail/simplification/none.hpp"
#include "dovetail/simplification/paper.hpp"
#include "dovetail/simplification/wraps.hpp"
#include "dovetail/sizing/sources.hpp"
#include "dovetail/sizing/uniform.hpp"
#include "dovetail/sizing/wraps.hpp"
#include "dovetail/solver/openfoam_format.hpp"
#include "dovetail/solver/pvtu_format.hpp"
#include "dovetail/solver/wraps.hpp"

#include <doctest/doctest.h>

#include <string>
#include <utility>
#include <vector>

namespace dovetail {
namespace {

/// A mesher with every optional member; `number` tells its forms apart.
struct full_mesher {
  static constexpr mesher_traits traits{.keeps_boundary = true, .thread_safe = false};
  static constexpr double elements_per_inverse_cubed_size = 7;
  int number = 0;

  std::string name() const { return "full"; }
  mesher_traits actual_traits() const { return {.keeps_boundary = true, .may_crash = true}; }
  double elements_per_subdomain() const { return 1234; }
  full_mesher for_background() const { return {number + 10}; }
  std::vector<full_mesher> fallbacks() const { return {{number + 1}, {number + 2}}; }
  full_mesher with_lines(const std::vector<std::vector<vec3>>& lines) const {
    return {number + static_cast<int>(lines.size()) * 100};
  }
  mesher_result<3> operator()(const mesher_input<3>& /*input*/, const any_sizing& /*size*/) const {
    mesher_result<3> result;
    result.summary.set("number", number);
    return result;
  }
};

template <class M>
struct counting : mesher::wraps<counting<M>, M> {
  int extra = 0;

  mesher_result<3> operator()(const mesher_input<3>& input, const any_sizing& size) const {
    auto result = this->wrapped(input, size);
    result.summary.set("extra", extra);
    return result;
  }
};

template <class M>
std::pair<double, double> numbers_of(const M& mesh_it) {
  const report summary = mesh_it({}, {}).summary;
  return {summary.get("number"), summary.get("extra")};
}

using wrapped_mesher = counting<full_mesher>;
static_assert(boundary_keeping_mesher<wrapped_mesher, 3> && calibrated_mesher<wrapped_mesher> &&
              piece_sizing_mesher<wrapped_mesher> && has_background_form<wrapped_mesher> &&
              has_fallbacks<wrapped_mesher> && line_keeping_mesher<wrapped_mesher>);
static_assert(!wrapped_mesher::traits.thread_safe);

/// Whether two meshers have the same optional members.
template <class A, class B>
constexpr bool say_alike() {
  return calibrated_mesher<A> == calibrated_mesher<B> && piece_sizing_mesher<A> == piece_sizing_mesher<B> &&
         has_background_form<A> == has_background_form<B> && has_fallbacks<A> == has_fallbacks<B> &&
         line_keeping_mesher<A> == line_keeping_mesher<B>;
}

using wrapped_native = counting<mesher::native>;
static_assert(boundary_keeping_mesher<wrapped_native, 3> && wrapped_native::traits.thread_safe);
static_assert(say_alike<wrapped_native, mesher::native>());

TEST_CASE("a wrapped mesher keeps name, traits, calibration, fallbacks and forms, each wrapped too") {
  const wrapped_mesher mine{full_mesher{5}, 3};
  CHECK(policy_name(mine) == "full");
  CHECK(policy_traits(mine).may_crash);
  CHECK(elements_per_inverse_cubed_size(mine) == 7);
  CHECK(elements_per_subdomain(mine) == 1234);
  CHECK(numbers_of(mine) == std::pair(5.0, 3.0));
  CHECK(numbers_of(mine.for_background()) == std::pair(15.0, 3.0));
  CHECK(numbers_of(mine.with_lines({{}, {}})) == std::pair(205.0, 3.0));
  const auto attempts = with_fallbacks(mine);
  REQUIRE(attempts.size() == 3);
  CHECK(numbers_of(attempts[2]) == std::pair(7.0, 3.0));
  CHECK(numbers_of(form_for_background(mine).first) == std::pair(15.0, 3.0));
}

TEST_CASE("a wrapper of a mesher behind one type answers for the one that is held") {
  const counting<any_mesher<3>> mine{any_mesher<3>(full_mesher{5}), 3};
  CHECK(elements_per_inverse_cubed_size(mine) == 7);
  CHECK(elements_per_subdomain(mine) == 1234);
  CHECK(policy_traits(mine).may_crash);
  CHECK(has_form_for_background(mine));
  CHECK(numbers_of(form_for_background(mine)) == std::pair(15.0, 3.0));
  CHECK(with_fallbacks(mine).size() == 3);
  const counting<any_mesher<3>> plain{any_mesher<3>(archetype::mesher(0)), 3};
  CHECK_FALSE(has_form_for_background(plain));
  CHECK_FALSE(is_given(counting<any_mesher<3>>{}));
}

template <class H>
struct watched : sizing::wraps<watched<H>, H> {};

static_assert(bounded_below_sizing_field<watched<source_field>> &&
              feature_aware_sizing_field<watched<source_field>> &&
              narrowable_sizing_field<watched<source_field>>);
static_assert(sizing_field<watched<archetype::sizing>> &&
              !bounded_below_sizing_field<watched<archetype::sizing>> &&
              !feature_aware_sizing_field<watched<archetype::sizing>> &&
              !narrowable_sizing_field<watched<archetype::sizing>>);

TEST_CASE("a watched sizing field has the bounds of the field") {
  const watched<uniform_size> mine{uniform_size(0.25)};
  CHECK(mine({1, 2, 3}) == 0.25);
  CHECK(smallest_size_in(mine, box3{}) == 0.25);
}

template <class I>
struct timed : improvement::wraps<timed<I>, I> {};

static_assert(improver<timed<improvement::native>, 3> && surface_improver<timed<improvement::native>> &&
              timed<improvement::native>::traits.thread_safe);
static_assert(improver<timed<archetype::improver>, 3> && !surface_improver<timed<archetype::improver>>);

struct unsafe_surface_mesher : remesh::patch_remesher {
  static constexpr bool thread_safe = false;
};
template <class M>
struct noted : remesh::wraps<noted<M>, M> {};

static_assert(surface_mesher<noted<remesh::patch_remesher>> &&
              is_thread_safe<noted<remesh::patch_remesher>>() &&
              !is_thread_safe<noted<unsafe_surface_mesher>>());

TEST_CASE("a wrapped surface mesher behind one type runs in threads where the held one does") {
  CHECK_FALSE(may_run_in_threads(noted<any_surface_mesher>{any_surface_mesher(unsafe_surface_mesher{})}));
  CHECK(may_run_in_threads(noted<any_surface_mesher>{any_surface_mesher(remesh::patch_remesher{})}));
  CHECK(any_surface_mesher(noted<any_surface_mesher>{any_surface_mesher(remesh::patch_remesher{})})
            .may_run_in_threads());
  CHECK_FALSE(any_surface_mesher(noted<any_surface_mesher>{any_surface_mesher(unsafe_surface_mesher{})})
                  .may_run_in_threads());
}

template <class R>
struct harsher : simplifier::wraps<harsher<R>, R> {
  double penalty(const deficit& d) const { return 2 * this->wrapped.penalty(d); }
};

static_assert(simplification_rule<harsher<simplifier::paper>, 2> &&
              simplification_rule<harsher<simplifier::paper>, 3>);

TEST_CASE("a wrapped rule wants the angles of the rule") {
  const simplifier::paper wide{.volume_dihedral_deg = 41, .volume_shape_deg = 37};
  CHECK(wanted_angles_of<3>(harsher<simplifier::paper>{wide}).dihedral_deg == 41);
  CHECK(wanted_angles_of<3>(harsher<simplifier::paper>{wide}).face_deg == 37);
  const deficit some{};
  CHECK(harsher<simplifier::paper>{wide}.penalty(some) == 2 * wide.penalty(some));
}

template <class E>
struct slowed : parallel::wraps<slowed<E>, E> {};

static_assert(executor<slowed<parallel::serial>> && executor<slowed<parallel::clock_watch>>);
static_assert(uses_threads<parallel::remembering<parallel::threads>>() &&
              executor<parallel::forgetting<any_executor>>);
static_assert(uses_threads<slowed<slowed<parallel::threads>>>() && !uses_threads<slowed<parallel::serial>>());

/// Another process goes through the same program, and does what is done once.
struct second_of_two {
  int* times = nullptr;

  std::vector<task_outcome> run(std::size_t count, const task_function& task,
                                const run_options& options) const {
    return parallel::serial{}.run(count, task, options);
  }
  int workers() const { return 5; }
  bool shares_process() const { return false; }
  any_communicator network() const { return parallel::self{}; }
  byte_buffer once(const std::function<byte_buffer()>& work) const { return ++*times, work(); }
};

TEST_CASE("what wraps an executor that remembers finds what that has kept") {
  const parallel::remembering keeps(parallel::serial{});
  CHECK(slowed<parallel::remembering<parallel::serial>>{keeps}.results() == keeps.results());
  CHECK(any_executor(parallel::clock_watch(keeps, 1)).results() == keeps.results());
  CHECK(keeps.results() != nullptr);
  CHECK(parallel::remembering(keeps).results() == keeps.results()); // a copy
}

TEST_CASE("a wrapped executor has the ranks and the once of the executor") {
  int times = 0;
  const slowed<second_of_two> mine{second_of_two{&times}};
  static_assert(detail::has_network<slowed<second_of_two>> && detail::does_once<slowed<second_of_two>>);
  static_assert(!detail::has_network<slowed<parallel::serial>>);
  CHECK(mine.once([] { return byte_buffer(3); }).size() == 3);
  CHECK(times == 1);
  CHECK(mine.workers() == 5);
  CHECK_FALSE(runs_in_threads(mine));
}

template <class W>
struct announced : io::wraps<announced<W>, W> {};

static_assert(piecewise_mesh_writer<announced<io::vtu_writer>, 3> &&
              piecewise_mesh_writer<announced<io::vtu_writer>, 2>);
static_assert(mesh_writer<announced<archetype::writer>> &&
              !piecewise_mesh_writer<announced<archetype::writer>>);

template <class F>
struct renamed : io::format_wraps<renamed<F>, F> {
  std::string name() const { return "my " + this->wrapped.name(); }
};

/// A format of ranks with every optional member.
struct full_format {
  static constexpr bool second_order = true;
  std::string name() const { return "full"; }
  std::vector<std::string> files_of_all() const { return {}; }
  void write(const io::rank_source<3>&, const rank_mesh<3>&,
             const std::vector<std::filesystem::path>&) const {}
  void write_all(const io::rank_source<3>&, const std::vector<std::filesystem::path>&) const {}
  std::vector<std::string> files_of_rank(local_id q) const { return files_of_rank(q, 9); }
  std::vector<std::string> files_of_rank(local_id q, int n) const {
    return {std::to_string(q) + "_of_" + std::to_string(n)};
  }
  std::vector<std::string> outdated_files_of_rank(local_id q, int n) const {
    return {"outdated_" + files_of_rank(q, n)[0]};
  }
  bool may_replace(const std::filesystem::path& path) const { return path == "mine"; }
};

static_assert(rank_format<renamed<io::pvtu_format>, 2> && rank_format<renamed<io::pvtu_format>, 3> &&
              has_second_order<renamed<io::pvtu_format>> == has_second_order<io::pvtu_format>);
static_assert(rank_format<renamed<io::openfoam_format>, 3> && !rank_format<renamed<io::openfoam_format>, 2> &&
              !shared_rank_format<renamed<io::openfoam_format>, 3>);
static_assert(shared_rank_format<renamed<archetype::shared_rank_format>> &&
              !rank_format<renamed<archetype::shared_rank_format>>);
static_assert(io::detail::keeps_some_files<renamed<io::openfoam_format>> &&
              !io::detail::keeps_some_files<renamed<archetype::rank_format>> &&
              !io::detail::names_files_by_count<renamed<archetype::rank_format>> &&
              !io::detail::knows_outdated_files<renamed<archetype::rank_format>>);

TEST_CASE("a wrapped format of ranks has the files of the format, and leaves what that leaves") {
  const renamed<full_format> mine;
  static_assert(has_second_order<renamed<full_format>>);
  CHECK(mine.name() == "my full");
  CHECK(mine.files_of_rank(1) == std::vector<std::string>{"1_of_9"});
  CHECK(mine.files_of_rank(1, 3) == std::vector<std::string>{"1_of_3"});
  CHECK(mine.outdated_files_of_rank(1, 3) == std::vector<std::string>{"outdated_1_of_3"});
  CHECK(mine.may_replace("mine"));
  CHECK_FALSE(mine.may_replace("another"));
}

template <class P>
struct measured : partition::wraps<measured<P>, P> {};

static_assert(graph_partitioner<measured<archetype::partitioner>>);

template <class R>
struct told : redistribution_by::wraps<told<R>, R> {};

static_assert(redistributor<told<archetype::redistributor>, 3> &&
              !redistributor<told<archetype::redistributor>, 2>);

template <class G>
struct asked : model_wraps<asked<G>, G> {};

static_assert(geometry_model<asked<archetype::geometry>> &&
              !geometry_model_with_planes<asked<archetype::geometry>> &&
              geometry_model_with_planes<asked<plane_domain>>);
static_assert(!geometry_model_with_members<asked<archetype::geometry>> &&
              geometry_model_with_members<asked<virtual_model>>);
template <class G>
constexpr bool knows_volume = requires(const G& model) {
  model.volume();
};
struct model_with_volume : archetype::geometry {
  double volume() const { return 3; }
};
static_assert(knows_volume<asked<model_with_volume>> && !knows_volume<asked<archetype::geometry>>);

} // namespace
} // namespace dovetail
