// near miss 1: a text in place of sizes to fill by
// first error 1: takes a sizing_field
// near miss 2: a mesher of triangles to fill by
// first error 2: fill needs a mesher of tetrahedra
// near miss 3: no improver to fill by
// first error 3: fill needs an improver of tetrahedra
// near miss 4: a file name in place of the model of an adaptation
// first error 4: takes a geometry_model
// near miss 5: a partitioner in place of a redistributor
// first error 5: goes by a redistributor
// near miss 6: an improver in place of lists of operations
// first error 6: native_by takes lists of operations
#include "dovetail/improver/native_by.hpp"
#include "dovetail/mesher/by_regions.hpp"
#include "dovetail/models/plane_domain.hpp"
#include "dovetail/partition/greedy.hpp"
#include "dovetail/pipeline/fill.hpp"
#include "dovetail/remesh/patch_remesher.hpp"
#include "dovetail/sizing/uniform.hpp"
#include "dovetail/solver/adapt.hpp"
#include "dovetail/solver/pvtu_format.hpp"
#include "dovetail/solver/rank_files.hpp"

using namespace dovetail;

void call(const simplicial_mesh<2>& surface, const plane_domain& model, const adaptable_mesh<2>& mesh) {
  const uniform_size size(1);
#if NEAR_MISS == 1
  fill(surface, "0.1");
#elif NEAR_MISS == 2
  fill(surface, size, {}, mesher::by_regions<remesh::patch_remesher>{});
#elif NEAR_MISS == 3
  fill(surface, {}, mesher::native{}, 3);
#elif NEAR_MISS == 4
  adapt<2>("wing.step", mesh, size, parameters<>{});
#elif NEAR_MISS == 5
  io::rank_writer<io::pvtu_format, partition::greedy>{};
#elif NEAR_MISS == 6
  improvement::native_by<improvement::native>{};
#else
  fill(surface, size);
  fill(surface, {.growth = 0.5});
  fill(surface, {}, mesher::native{}, native_improver{});
  adapt<2>(model, mesh, size, parameters<>{});
  adapt<2>(mesh, size, parameters<>{});
  io::rank_writer<io::pvtu_format>{};
  improvement::native_by<improvement::native_operations>{};
#endif
}
