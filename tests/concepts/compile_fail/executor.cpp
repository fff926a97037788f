// near miss 1: it does not say how many workers it has
// error 1: e\.workers\(\).*invalid|no member named 'workers'
// near miss 2: it keeps the outcomes to itself
// error 2: e\.run\(count, task, options\).*return-type|(constraint|because) 'std::same_as<void
// near miss 3: it takes no options
// error 3: e\.run\(count, task, options\).*invalid|too many arguments|no matching member function
// near miss 4: it does not say whether tasks share the process
// error 4: e\.shares_process\(\).*invalid|no member named 'shares_process'
// near miss 5: it cannot be copied, so the pipeline cannot hold it
// error 5: (copy_constructible|is_constructible)
#include "dovetail/parallel/concepts.hpp"

using outcomes = std::vector<dovetail::task_outcome>;

struct my_executor {
#if NEAR_MISS == 5
  my_executor(const my_executor&) = delete;
#endif
#if NEAR_MISS == 2
  void run(std::size_t, const dovetail::task_function&, const dovetail::run_options&) const;
#elif NEAR_MISS == 3
  outcomes run(std::size_t, const dovetail::task_function&) const;
#else
  outcomes run(std::size_t, const dovetail::task_function&, const dovetail::run_options&) const;
#endif
#if NEAR_MISS != 1
  int workers() const;
#endif
#if NEAR_MISS != 4
  bool shares_process() const;
#endif
};

template <dovetail::executor E>
void use(const E&) {}

template <class T>
const T& declared();

void call() {
  use(declared<my_executor>());
}
