// near miss 1: it takes no options
// first error 1: with_executor takes an? executor
// near miss 2: it does not say how many tasks run at a time
// first error 2: with_executor takes an? executor
// near miss 3: nor where they run
// first error 3: with_executor takes an? executor
#include "dovetail/pipeline/parameters.hpp"

#include <vector>

struct my_policy {
#if NEAR_MISS == 1
  std::vector<dovetail::task_outcome> run(std::size_t, const dovetail::task_function&) const;
#else
  std::vector<dovetail::task_outcome> run(std::size_t, const dovetail::task_function&,
                                          const dovetail::run_options&) const;
#endif
#if NEAR_MISS != 2
  int workers() const;
#endif
#if NEAR_MISS != 3
  bool shares_process() const;
#endif
};

void call() {
  dovetail::parameters<>{}.with_executor(my_policy{});
}
