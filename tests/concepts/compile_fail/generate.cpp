// near miss 1: options in place of parameters
// first error 1: options go into parameters<>\{\}\.with_options
// near miss 2: a mesher of triangles
// first error 2: needs a mesher of elements of dimension D
// near miss 3: an improver of triangles alone
// first error 3: needs an improver of elements of dimension D
// near miss 4: a mesher in place of parameters
// first error 4: a mesher into \.with_mesher
#include "dovetail/pipeline/generate.hpp"
// near miss 5: a mesher of tetrahedra for a background mesh of triangles
// error 5: needs a mesher of elements of dimension D
// near miss 6: an improver around another one whose call hides the one with a surface
// first error 6: hides the wrapped one's call with a surface
#include "dovetail/improver/wraps.hpp"
#include "dovetail/mesher/by_regions.hpp"
#include "dovetail/models/plane_domain.hpp"
#include "dovetail/sizing/uniform.hpp"

struct my_mesher {
  static constexpr dovetail::mesher_traits traits{.keeps_boundary = true};
  dovetail::mesher_result<3> operator()(const dovetail::mesher_input<3>&, const dovetail::any_sizing&) const;
};

struct improver_of_triangles {
  static constexpr dovetail::improver_traits traits{};
  dovetail::report operator()(dovetail::simplicial_mesh<2>&, const dovetail::frozen_entities<2>&,
                              const dovetail::any_sizing&) const;
};

struct timed : dovetail::improvement::wraps<timed, dovetail::improvement::native> {
#if NEAR_MISS != 6
  using wraps::operator();
#endif
  dovetail::report operator()(dovetail::simplicial_mesh<2>& mesh, const dovetail::frozen_entities<2>& frozen,
                              const dovetail::any_sizing& size) const {
    return wrapped(mesh, frozen, size);
  }
};

void call(const dovetail::plane_domain& model) {
  using namespace dovetail;
  const uniform_size size(1);
#if NEAR_MISS == 1
  generate<3>(model, size, generate_options{.subdomains = 4});
#elif NEAR_MISS == 2
  generate<3>(model, size, parameters<>{}.with_mesher(mesher::by_regions<any_surface_mesher>{}));
#elif NEAR_MISS == 3
  generate<3>(model, size, parameters<>{}.with_mesher(my_mesher{}).with_improver(improver_of_triangles{}));
#elif NEAR_MISS == 4
  generate<3>(model, size, my_mesher{});
#elif NEAR_MISS == 5
  make_background<2>(model, size, parameters<>{}.with_mesher(my_mesher{}));
#elif NEAR_MISS == 6
  generate<2>(model, size, parameters<>{}.with_improver(timed{}));
#else
  generate<2>(model, size, parameters<>{}.with_improver(timed{}));
  generate<3>(model, size, parameters<>{}.with_mesher(my_mesher{}).with_options({.subdomains = 4}));
  generate<3>(model, size, parameters<>{});
#endif
}
