#include "rank_partitioner.hpp"

#include "failure.hpp"
#include "named_policies.hpp"

#include "dovetail/core/encoding.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/fields.hpp"
#include "dovetail/graph/distributed_csr_graph.hpp"
#include "dovetail/parallel/error_codec.hpp"

#ifdef DOVETAIL_DRIVER_WITH_PTSCOTCH
#include "dovetail/adapters/ptscotch.hpp"
#endif
#ifdef DOVETAIL_DRIVER_WITH_PARMETIS
#include "dovetail/adapters/parmetis.hpp"
#endif

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <optional>
#include <thread>
#include <utility>

#include <poll.h>

namespace dovetail::app {
namespace {

/// Of the messages between a computing process and its relay's desk, of which there is one kind each way.
constexpr std::int32_t desk_tag = 0;

/// Those that the relays call together.
std::vector<any_distributed_partitioner> partitioners_of_relays() {
  std::vector<any_distributed_partitioner> known;
#ifdef DOVETAIL_DRIVER_WITH_PTSCOTCH
  known.emplace_back(partition::ptscotch{}, "ptscotch");
#endif
#ifdef DOVETAIL_DRIVER_WITH_PARMETIS
  known.emplace_back(partition::parmetis{}, "parmetis");
#endif
  return known;
}

struct partition_request {
  std::string partitioner;
  distributed_csr_graph graph;
  int parts = 1;

  using fields =
      field_list<&partition_request::partitioner, &partition_request::graph, &partition_request::parts>;
};

struct partition_answer {
  std::vector<local_id> parts;
  std::optional<byte_buffer> error; ///< in place of them (`encode_error`)

  using fields = field_list<&partition_answer::parts, &partition_answer::error>;
};

/// The parts, or the error, which is that of all ranks.
partition_answer answer_to(const partition_request& request, any_communicator& relays) {
  try {
    const auto partitioner = chosen(partitioners_of_relays(), request.partitioner, "--rank-partitioner");
    return {partitioner(relays, request.graph, request.parts), {}};
  } catch (const std::exception&) { // not that a relay is gone
    return {{}, encode_error(std::current_exception())};
  }
}

/// A model of `distributed_graph_partitioner` in a computing process.
class partitioner_by_relays {
public:
  partitioner_by_relays(std::string name, int relay) : name_(std::move(name)), relay_(relay) {}

  static constexpr bool depends_on_ranks() { return true; }
  std::vector<local_id> operator()(any_communicator&, const distributed_csr_graph& graph, int parts) const {
    detail::socket_frames frames(relay_);
    frames.send(graph.rank, desk_tag, encoded(partition_request{name_, graph, parts}));
    for (;;) {
      const bool all_sent = frames.flush();
      if (const auto message = frames.receive()) {
        auto answer = decoded<partition_answer>(message->bytes);
        if (answer.error)
          throw_error(*answer.error);
        return std::move(answer.parts);
      }
      if (frames.closed()) {
        std::this_thread::sleep_for(std::chrono::seconds(5)); // the signal that ends this process is near
        throw communication_error("the process that speaks to the other ranks is gone");
      }
      pollfd watched{relay_, static_cast<short>(all_sent ? POLLIN : POLLIN | POLLOUT), 0};
      ::poll(&watched, 1, 100);
    }
  }

private:
  std::string name_;
  int relay_;
};
static_assert(distributed_graph_partitioner<partitioner_by_relays>);

} // namespace

std::vector<std::string> rank_partitioner_names() {
  std::vector<std::string> names = names_of(partitioners_of_relays());
  names.insert(names.begin(), "gathered");
  return names;
}

any_distributed_partitioner make_rank_partitioner(const std::string& name, const any_partitioner& of_run,
                                                  int relay) {
  const std::string option = "--rank-partitioner";
  const auto names = rank_partitioner_names();
  const std::string found = chosen_name(names, name, option);
  if (found == names.front())
    return of_run;
  if (relay < 0)
    throw command_line_error(option + " " + found +
                             " partitions on several ranks: start the run by mpirun -n 2 or more, or use " +
                             names.front());
  return {partitioner_by_relays(found, relay), found};
}

partition_desk::partition_desk(int socket, any_communicator relays)
    : frames_(socket), relays_(std::move(relays)) {
  // PT-Scotch has threads otherwise, and its implementation of ParMETIS gives what they happen to find.
  ::setenv("SCOTCH_PTHREAD_NUMBER", "1", 0); // NOLINT(concurrency-mt-unsafe): a relay reads it in one thread
}

void partition_desk::serve(const std::function<void()>& pass_messages) {
  frames_.flush();
  const auto asked = frames_.receive();
  if (!asked)
    return;
  await_others(pass_messages);
  frames_.send(relays_.rank(), desk_tag,
               encoded(answer_to(decoded<partition_request>(asked->bytes), relays_)));
}

void partition_desk::await_others(const std::function<void()>& pass_messages) {
  const std::int32_t tag = relays_.next_tag();
  for (int rank = 0; rank < relays_.size(); ++rank)
    if (rank != relays_.rank())
      relays_.send(rank, tag, {});
  for (int asked = 1;;) {
    pass_messages();
    while (relays_.receive(tag))
      ++asked;
    if (asked == relays_.size())
      return;
    relays_.wait(std::chrono::milliseconds(1));
  }
}

} // namespace dovetail::app
