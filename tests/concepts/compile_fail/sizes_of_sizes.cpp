// near miss 1: a number in place of sizes to scale
// first error 1: scaled takes a sizing_field
// near miss 2: a number in place of sizes to clamp
// first error 2: bounded takes a sizing_field
// near miss 3: a number beside sizes
// first error 3: minimum_of takes models of sizing_field
// near miss 4: sizes that depend on no place
// first error 4: graded_size takes a sizing_field
// near miss 5: a text in place of a mesher
// first error 5: any_mesher<D> holds a boundary_keeping_mesher
// near miss 6: a mesher of triangles in place of one of tetrahedra
// first error 6: any_mesher<D> holds a boundary_keeping_mesher
#include "dovetail/mesher/any_mesher.hpp"
#include "dovetail/mesher/by_regions.hpp"
#include "dovetail/mesher/native.hpp"
#include "dovetail/remesh/patch_remesher.hpp"
#include "dovetail/sizing/compose.hpp"
#include "dovetail/sizing/graded.hpp"
#include "dovetail/sizing/uniform.hpp"

using namespace dovetail;

const uniform_size size(1);
const box3 domain{{0, 0, 0}, {1, 1, 1}};
#if NEAR_MISS == 1
const scaled wrong(0.1, 2);
#elif NEAR_MISS == 2
const bounded wrong(0.1, 0.05, 1);
#elif NEAR_MISS == 3
const minimum_of wrong(size, 0.1);
#elif NEAR_MISS == 4
const graded_size wrong([] { return 0.1; }, domain);
#elif NEAR_MISS == 5
const any_mesher<3> wrong("native");
#elif NEAR_MISS == 6
const any_mesher<3> wrong(mesher::by_regions<remesh::patch_remesher>{});
#else
const scaled half(size, 0.5);
const bounded clamped(size, 0.05, 1);
const minimum_of least(size, half, [](vec3) { return 0.1; });
const graded_size grown(least, domain);
const any_mesher<3> mesher(mesher::native{});
#endif
