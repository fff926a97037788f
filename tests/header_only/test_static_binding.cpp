// Header-only, policies are bound at compile time down to their calls: this program meshes by policies of its
// own, and does not even have the definitions of the types that could hide them.
#include "dovetail/mesher/native.hpp"
#include "dovetail/models/plane_domain.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/sizing/uniform.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

namespace dovetail {

class any_partitioner;
class any_simplification_rule;
class any_surface_mesher;
template <int D>
class any_mesher;
template <int D>
class any_improver;

} // namespace dovetail

using namespace dovetail;

namespace {

/// How often each policy was called.
struct calls {
  int judged = 0, preferred = 0, partitioned = 0, meshed = 0, improved = 0;
};

struct counted_rule : simplifier::paper {
  calls* count = nullptr;

  template <int D>
  side_judgement operator()(const simplicial_mesh<D>& mesh, const side_table<D>& sides) const {
    ++count->judged;
    return simplifier::paper::operator()(mesh, sides);
  }
  bool prefer_removal(const dihedral_side& a, const dihedral_side& b) const {
    ++count->preferred;
    return simplifier::paper::prefer_removal(a, b);
  }
};

struct counted_partitioner {
  calls* count = nullptr;

  std::vector<local_id> operator()(const csr_graph& graph, int parts) const {
    ++count->partitioned;
    return partition::greedy{}(graph, parts);
  }
};

struct counted_surface_mesher {
  calls* count = nullptr;

  patch_mesh operator()(const any_surface& surface, const patch_boundary& boundary,
                        const any_sizing& size) const {
    ++count->meshed;
    return remesh::patch_remesher{}(surface, boundary, size);
  }
};

struct counted_improver {
  static constexpr improver_traits traits{.thread_safe = true};
  calls* count = nullptr;

  template <int D>
  report operator()(simplicial_mesh<D>& mesh, const frozen_entities<D>& frozen,
                    const any_sizing& size) const {
    ++count->improved;
    return improvement::native{}(mesh, frozen, size);
  }
};

plane_domain square() {
  return plane_domain({{{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}}}, {}});
}

auto counted_by(calls& count) {
  return parameters<>{}
      .with_simplifier(counted_rule{{.surface_dihedral_deg = 70}, &count})
      .with_partitioner(counted_partitioner{&count})
      .with_surface_mesher(counted_surface_mesher{&count})
      .with_improver(counted_improver{&count})
      .with_background_improver(counted_improver{&count})
      .with_options({.subdomains = 3});
}

} // namespace

TEST_CASE("static binding: every policy is called as it is") {
  calls count;
  const auto made = generate<2>(square(), uniform_size(0.05), counted_by(count));
  CHECK(made.failures.empty());
  CHECK(made.mesh.counts.size() == 3);
  CHECK(count.judged == 1);
  CHECK(count.preferred > 0);
  CHECK(count.partitioned == 1);
  CHECK(count.meshed > 3);
  CHECK(count.improved == 3);
}

TEST_CASE("static binding: so it is for tetrahedra, of which a plane domain has none") {
  calls count;
  const auto policies = counted_by(count).with_mesher(mesher::native{});
  CHECK_THROWS_AS(generate<3>(square(), uniform_size(0.05), policies), error);
}

namespace {

template <class T>
concept is_defined = requires {
  sizeof(T);
};
static_assert(is_defined<any_executor>);
static_assert(!is_defined<any_partitioner> && !is_defined<any_simplification_rule> &&
              !is_defined<any_surface_mesher>);
static_assert(!is_defined<any_mesher<2>> && !is_defined<any_mesher<3>> && !is_defined<any_improver<2>> &&
              !is_defined<any_improver<3>>);

} // namespace
