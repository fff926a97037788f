// near miss 1: it does not say how many ranks there are
// error 1: c\.size\(\).*invalid|no member named 'size'
// near miss 2: it waits for a message where it should say that there is none
// error 2: c\.receive\(\).*return-type|(constraint|because) 'std::same_as<dovetail::rank_message
// near miss 3: a message has no tag
// error 3: c\.send\(to, tag, .*invalid|too many arguments|no matching member function
// near miss 4: it cannot tell the others that it goes no further
// error 4: c\.abandon\(reason\).*invalid|no member named 'abandon'
// near miss 5: it cannot be moved, so nothing can hold it
// error 5: (movable|is_constructible)
#include "dovetail/parallel/communicator.hpp"

struct my_communicator {
#if NEAR_MISS == 5
  my_communicator(const my_communicator&) = delete;
#endif
  int rank();
#if NEAR_MISS != 1
  int size();
#endif
#if NEAR_MISS == 3
  void send(int, const dovetail::byte_buffer&);
#else
  void send(int, std::int32_t, const dovetail::byte_buffer&);
#endif
#if NEAR_MISS == 2
  dovetail::rank_message receive();
#else
  std::optional<dovetail::rank_message> receive();
#endif
  void wait(std::chrono::milliseconds);
  int descriptor();
  bool shares_process();
#if NEAR_MISS != 4
  void abandon(const std::string&);
#endif
};

template <dovetail::communicator C>
void use(C&) {}

template <class T>
T& declared();

void call() {
  use(declared<my_communicator>());
}
