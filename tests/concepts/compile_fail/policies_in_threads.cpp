// near miss 1: the mesher may not run in threads
// first error 1: this mesher may not run in threads: take parallel::processes or serial
// near miss 2: nor may the improver
// first error 2: this improver may not run in threads: take parallel::processes or serial
// near miss 3: the same in an executor of one's own that says that it uses threads
// first error 3: this mesher may not run in threads: take parallel::processes or serial
// near miss 4: a wrapper of such an executor
// first error 4: this mesher may not run in threads: take parallel::processes or serial
// near miss 5: the mesher of the surfaces may not run in threads
// first error 5: this surface mesher may not run in threads: take parallel::processes or serial
#include "dovetail/geometry/any_geometry.hpp"
#include "dovetail/parallel/threads.hpp"
#include "dovetail/parallel/wraps.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/sizing/uniform.hpp"

struct my_mesher {
  static constexpr dovetail::mesher_traits traits{.keeps_boundary = true,
                                                  .thread_safe = NEAR_MISS % 2 == 0 && NEAR_MISS != 4};
  dovetail::mesher_result<3> operator()(const dovetail::mesher_input<3>&, const dovetail::any_sizing&) const;
};
struct my_improver {
  static constexpr dovetail::improver_traits traits{.thread_safe = NEAR_MISS != 2};
  dovetail::report operator()(dovetail::simplicial_mesh<3>&, const dovetail::frozen_entities<3>&,
                              const dovetail::any_sizing&) const;
};
struct my_threads : dovetail::parallel::threads {};
struct my_logged_threads : dovetail::parallel::wraps<my_logged_threads, dovetail::parallel::threads> {};
struct my_surface_mesher : dovetail::remesh::patch_remesher {
  static constexpr bool thread_safe = NEAR_MISS != 5;
};

void call(const dovetail::any_geometry& model) {
  using namespace dovetail;
  const auto given = parameters<>{}
                         .with_mesher(my_mesher{})
                         .with_improver(my_improver{})
                         .with_surface_mesher(my_surface_mesher{});
#if NEAR_MISS == 3
  generate<3>(model, uniform_size(1), given.with_executor(my_threads{}));
#elif NEAR_MISS == 4
  generate<3>(model, uniform_size(1), given.with_executor(my_logged_threads{}));
#elif NEAR_MISS == 5
  generate<2>(model, uniform_size(1),
              parameters<>{}.with_surface_mesher(my_surface_mesher{}).with_executor(parallel::threads{}));
#else
  generate<3>(model, uniform_size(1), given.with_executor(parallel::threads{}));
#endif
}
