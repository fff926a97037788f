// error: e\.workers\(\).*invalid|no member named 'workers'
#include "dovetail/parallel/concepts.hpp"

struct my_executor {
  std::vector<dovetail::task_outcome> run(std::size_t, const dovetail::task_function&,
                                          const dovetail::run_options&) const;
#ifdef CORRECT
  int workers() const;
#endif
};

template <dovetail::executor E>
void use(const E&) {}

void call() {
  use(my_executor{});
}
