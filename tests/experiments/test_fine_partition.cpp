// A fine mesh of the whole, cut into parts that are improved with their interfaces fixed.
#include "dovetail/adapters/tetgen.hpp"
#include "dovetail/distributed/processes.hpp"
#include "dovetail/experiments/baselines/generate_by_fine_partition.hpp"
#include "dovetail/improver/native.hpp"
#include "dovetail/mesh/distributed_validity.hpp"
#include "dovetail/mesh/mesh_hash.hpp"
#include "dovetail/models/occt_model.hpp"
#include "dovetail/sizing/uniform.hpp"
#include "pipeline/solid_meshes.hpp"

#include <BRepPrimAPI_MakeBox.hxx>
#include <BRep_Builder.hxx>
#include <TopoDS_Compound.hxx>
#include <doctest/doctest.h>

#include <cmath>
#include <set>

using namespace dovetail;
using namespace dovetail::testing;

namespace {

template <class Improver>
generated<3> made_in_parts(const TopoDS_Shape& shape, double size, int parts, const Improver& improver,
                           const any_executor& run = parallel::serial{}) {
  return baselines::generate_by_fine_partition(any_geometry(occt_shape_from(shape).model),
                                               erased_sizing(uniform_size(size)),
                                               parameters<>{}
                                                   .with_mesher(mesher::tetgen{})
                                                   .with_improver(improver)
                                                   .with_executor(run)
                                                   .with_options({.subdomains = parts}),
                                               300);
}

const report& account(const generated<3>& made) {
  return made.summary.find("fine partition");
}

void check_mesh(const generated<3>& made, double volume, std::size_t parts) {
  REQUIRE(made.failures.empty());
  CHECK(io::check_distributed(made.mesh).text() == "");
  CHECK(volume_of(made.mesh) == doctest::Approx(volume));
  CHECK(made.mesh.counts.size() >= parts);
  std::int64_t elements = 0;
  for (const piece_counts& piece : made.mesh.counts)
    elements += piece.elements;
  CHECK(made.quality.elements == elements);
  CHECK(made.background.elements().elements.empty());
  CHECK(made.fine_angles.min_dihedral_deg() == doctest::Approx(account(made).get("min_dihedral_deg")));
  CHECK(made.fine_angles.interface_faces > 0);
}

} // namespace

TEST_CASE("the elements of a mesh of the whole are in parts, and their interfaces are what the mesher made") {
  const auto box = BRepPrimAPI_MakeBox(1.0, 1.0, 1.0).Shape();
  const auto unimproved = made_in_parts(box, 0.1, 12, improvement::none{});
  check_mesh(unimproved, 1, 12);
  CHECK(account(unimproved).get("super_elements") == static_cast<double>(unimproved.quality.elements));
  CHECK(account(unimproved).get("seams_before") == 0);
  CHECK(account(unimproved).get("interface_sides") > 0);
  CHECK(unimproved.plan.subdomains == 12);

  // One piece of the same mesh, by the pipeline: the elements are the same, cut or not.
  const auto whole = generate<3>(occt_shape_from(box).model, uniform_size(0.1),
                                 parameters<>{}
                                     .with_mesher(mesher::tetgen{})
                                     .with_improver(improvement::none{})
                                     .with_options({.subdomains = 1}));
  CHECK(whole.mesh.counts.size() == 1);
  CHECK(whole.quality.elements == unimproved.quality.elements);
  CHECK(whole.quality.min_dihedral_deg == doctest::Approx(unimproved.quality.min_dihedral_deg));

  const auto improved = made_in_parts(box, 0.1, 12, improvement::native{});
  check_mesh(improved, 1, 12);
  CHECK(improved.quality.min_dihedrals.below(24) < unimproved.quality.min_dihedrals.below(24));
  CHECK(improved.mesh.skeleton.sides == unimproved.mesh.skeleton.sides);
  CHECK(improved.mesh.skeleton.points == unimproved.mesh.skeleton.points);
  CHECK(improved.fine_angles.min_dihedral_deg() == unimproved.fine_angles.min_dihedral_deg());
}

TEST_CASE("parts follow from the elements where no number is given") {
  const auto made = made_in_parts(BRepPrimAPI_MakeBox(1.0, 1.0, 1.0).Shape(), 0.15, 0, improvement::none{});
  CHECK(made.plan.subdomains > 2);
  CHECK(made.plan.subdomains == std::lround(static_cast<double>(made.quality.elements) / 300));
  check_mesh(made, 1, static_cast<std::size_t>(made.plan.subdomains));
}

TEST_CASE("no part has elements of two solids, whose common face stays") {
  TopoDS_Compound both;
  BRep_Builder builder;
  builder.MakeCompound(both);
  builder.Add(both, BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 0), gp_Pnt(1, 1, 1)).Shape());
  builder.Add(both, BRepPrimAPI_MakeBox(gp_Pnt(1, 0.2, 0.1), gp_Pnt(2, 0.8, 0.9)).Shape());
  const auto made = made_in_parts(both, 0.15, 7, improvement::native{});
  check_mesh(made, 1.48, 7);
  std::set<local_id> materials;
  for (const piece_counts& piece : made.mesh.counts)
    materials.insert(piece.material);
  CHECK(materials == std::set<local_id>{0, 1});
}

TEST_CASE("the same mesh by every executor") {
  const auto box = BRepPrimAPI_MakeBox(1.0, 1.0, 1.0).Shape();
  const auto by_two =
      made_in_parts(box, 0.15, 6, improvement::native{}, parallel::processes{.worker_count = 2});
  CHECK(io::mesh_hash(by_two.mesh) == io::mesh_hash(made_in_parts(box, 0.15, 6, improvement::native{}).mesh));
}
