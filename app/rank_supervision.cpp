#include "rank_supervision.hpp"

#include "failure.hpp"

#ifdef DOVETAIL_DRIVER_WITH_MPI
#include "mpi_segments.hpp"
#include "mpirun_rank.hpp"
#include "neighbouring_relays.hpp"
#include "rank_groups.hpp"
#include "rank_partitioner.hpp"
#include "relay_loop.hpp"
#include "stop_request.hpp"
#include "supervision.hpp"

#include "dovetail/core/bytes.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/distributed/mpi.hpp"
#include "dovetail/distributed/relayed.hpp"

#include <boost/mpi/environment.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <deque>
#include <optional>
#include <string>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <unistd.h>
#endif

namespace dovetail::app {

#ifdef DOVETAIL_DRIVER_WITH_MPI

namespace {

/// What the computing processes of other ranks write to the error stream, of which rank 0 says what is
/// needed.
class kept_error_stream {
public:
  explicit kept_error_stream(bool wanted) : file_(wanted ? ::memfd_create("said", MFD_CLOEXEC) : -1) {}
  kept_error_stream(const kept_error_stream&) = delete;
  kept_error_stream& operator=(const kept_error_stream&) = delete;
  ~kept_error_stream() {
    if (file_ >= 0)
      ::close(file_);
  }
  /// In the computing process.
  void redirect() const {
    if (file_ < 0)
      return;
    ::dup2(file_, STDERR_FILENO);
    const int null = ::open("/dev/null", O_WRONLY);
    ::dup2(null, STDOUT_FILENO);
    ::close(null);
  }
  std::string text() const {
    std::string said(file_ < 0 ? 0 : static_cast<std::size_t>(::lseek(file_, 0, SEEK_END)), '\0');
    if (!said.empty() && ::pread(file_, said.data(), said.size(), 0) < 0)
      said.clear();
    const std::string prefix = "dovetail: "; // libraries may have said something before
    const std::size_t line = ('\n' + said).rfind('\n' + prefix);
    return line == std::string::npos ? said : said.substr(line + prefix.size());
  }

private:
  int file_;
};

/// One end of what connects a relay and its computing process.
struct relay_sockets {
  int messages = -1; ///< between ranks
  int partition_desk = -1;

  void close() const {
    ::close(messages);
    ::close(partition_desk);
  }
};

/// That of the relay, and that of the computing process.
std::pair<relay_sockets, relay_sockets> connected_sockets() {
  const auto connected = [] {
    std::array<int, 2> ends{};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
      throw usage_error("the system refuses a socket between two processes");
    return ends;
  };
  const auto messages = connected(), partition_desk = connected();
  return {{messages[0], partition_desk[0]}, {messages[1], partition_desk[1]}};
}

/// The network of the computing process, which ends with its relay: it sees first that nobody answers, of
/// which there is nothing to say.
class network_by_relay {
public:
  explicit network_by_relay(int socket) : socket_(socket), network_(socket) {}

  int rank() const { return network_.rank(); }
  int size() const { return network_.size(); }
  void send(int to, std::int32_t tag, byte_buffer bytes) {
    with_relay([&] { network_.send(to, tag, std::move(bytes)); });
  }
  std::optional<rank_message> receive() {
    return with_relay([&] { return network_.receive(); });
  }
  void wait(std::chrono::milliseconds at_most) {
    with_relay([&] { network_.wait(at_most); });
  }
  int descriptor() const { return network_.descriptor(); }
  bool shares_process() const { return network_.shares_process(); }
  void abandon(const std::string& reason) { network_.abandon(reason); }

private:
  template <class F>
  std::invoke_result_t<const F&> with_relay(const F& f) {
    try {
      return f();
    } catch (const communication_error&) {
      pollfd relay{socket_, POLLRDHUP, 0};
      if (::poll(&relay, 1, 0) > 0)
        std::this_thread::sleep_for(std::chrono::seconds(5)); // the signal that ends this process is near
      throw;
    }
  }

  int socket_;
  parallel::relayed network_;
};

using relay_network = watched_network<parallel::mpi>;

/// On rank 0: the exit code of all, with what is to be said on the error stream. Others see that a rank was
/// stopped as a network that fails.
int conclude(const std::vector<rank_end>& ends, bool first_has_spoken, const clean_up_on_ranks& clean_up) {
  const auto has_failed = [](const rank_end& end) { return end.code != exit_ok && end.by_itself; };
  auto failed = std::find_if(ends.begin(), ends.end(),
                             [](const rank_end& end) { return end.code == exit_stopped && end.by_itself; });
  if (failed == ends.end())
    failed = std::find_if(ends.begin(), ends.end(),
                          [&](const rank_end& end) { return has_failed(end) && !end.was_told; });
  if (failed == ends.end())
    failed = std::find_if(ends.begin(), ends.end(), has_failed);
  if (failed == ends.end())
    return exit_ok;
  const bool can_go_on = cleaned_up(clean_up.of_all);
  const bool stopped = failed->code == exit_stopped;
  const bool all_alike =
      std::all_of(ends.begin(), ends.end(), [&](const rank_end& end) { return end.cause == failed->cause; });
  if (!first_has_spoken || !has_failed(ends.front()))
    complain(stopped     ? stopped_line(can_go_on)
             : all_alike ? failed->cause
                         : "rank " + std::to_string(failed - ends.begin()) + ": " + failed->cause);
  return failed->code;
}

/// Of one of the processes that see it; a relay and its computing process do not say it both.
void complain_of_lost_relay(int rank) {
  if (!has_complained())
    complain(
        "rank " + std::to_string(rank) +
        ": its relay, the process that speaks to the other ranks, is gone, killed perhaps (signal 9) for "
        "want of memory");
}

/// In a computing process that has begun nothing yet: returns when its relay speaks to all others, or false
/// when one of the relays is gone, for which MPI waits in vain until mpirun ends it.
bool all_meet(int socket, pid_t starter) {
  neighbouring_relays neighbours;
  for (;;) {
    neighbours.look_for(starter);
    const bool all_known = neighbours.count() >= place_of_mpirun().size;
    if (all_known)
      neighbours.await_change(socket, std::chrono::milliseconds(100));
    else
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    char next = 0;
    const ssize_t come = ::recv(socket, &next, 1, MSG_PEEK | MSG_DONTWAIT);
    if (come >= 0)
      return come > 0;
    if (!all_known || neighbours.all_live())
      continue;
    if (neighbours.first_living() == rank_of_mpirun().rank)
      complain_of_lost_relay(neighbours.first_gone());
    return false;
  }
}

/// What is left to do on the machine of a relay that was killed, in the second that mpirun leaves the ranks.
/// One of its neighbours says so, and cleans up; the others stay until then, or they would be taken for
/// killed too.
[[noreturn]] void end_without(int lost, supervisor& computing, const neighbouring_relays& neighbours,
                              const clean_up_on_ranks& clean_up) {
  const int speaker = neighbours.first_living();
  const bool speaks = speaker == rank_of_mpirun().rank;
  const auto nothing = [] { return false; };
  if (!computing.has_ended({}, nothing))
    computing.end();
  if (speaks)
    complain_of_lost_relay(lost);
  while (!computing.has_ended(std::chrono::milliseconds(1), nothing)) {
  }
  computing.await_workers();
  clean_up.of_rank();
  if (!speaks) {
    neighbours.await_relay(speaker, std::chrono::seconds(5));
    ::_exit(exit_failure);
  }
  neighbours.await_computing(std::chrono::seconds(5));
  std::this_thread::sleep_for(std::chrono::milliseconds(50)); // those that worked for it end with it
  cleaned_up(clean_up.of_all);
  ::_exit(exit_failure); // to finalise MPI needs all
}

void require_mpi_of_mpirun(int rank, int size) {
  const mpirun_rank expected = rank_of_mpirun();
  if (rank != expected.rank || size != expected.size)
    throw usage_error("mpirun says rank " + std::to_string(expected.rank) + " of " +
                      std::to_string(expected.size) + ", and MPI rank " + std::to_string(rank) + " of " +
                      std::to_string(size) + "; start it with the mpirun of the MPI it was built with");
}

int relay_of_rank(supervisor& computing, const relay_sockets& sockets, const kept_error_stream& said,
                  bool first, const clean_up_on_ranks& clean_up) {
  neighbouring_relays neighbours;
  relay_network network(parallel::mpi{}, neighbours);
  require_mpi_of_mpirun(network.rank(), network.size());
  any_communicator relays = relay_network(parallel::mpi{}, neighbours); // of which none abandons another
  partition_desk desk(sockets.partition_desk, relay_network(parallel::mpi{}, neighbours));
  neighbours.meet(relays, computing.child());
  try {
    const rank_end end = relay_loop(computing, network, sockets.messages,
                                    {.all_live = [&] { return neighbours.all_live(); },
                                     .said = [&] { return said.text(); },
                                     .serve = [&](const auto& pass_messages) { desk.serve(pass_messages); }})
                             .run();
    if (end.code != exit_ok)
      clean_up.of_rank();
    const std::vector<rank_end> all = relays.gather(end);
    byte_buffer code;
    if (first)
      code = encoded(conclude(all, !computing.was_killed() || has_complained(), clean_up));
    return decoded<int>(relays.broadcast(std::move(code)));
  } catch (const relay_lost& lost) {
    end_without(lost.rank, computing, neighbours, clean_up);
  }
}

/// From now on this process and its workers may use these, unless there are more than the system tells.
void use_processors(const std::vector<std::int32_t>& processors) {
  cpu_set_t bound;
  if (::sched_getaffinity(0, sizeof bound, &bound) != 0)
    return;
  CPU_ZERO(&bound);
  for (const std::int32_t p : processors)
    if (p < CPU_SETSIZE)
      CPU_SET(p, &bound);
  ::sched_setaffinity(0, sizeof bound, &bound); // where that is refused it stays as it is
}

/// Until the leader of this rank's group is done. Whatever ends it before, the relay knows.
void await_leader(network_by_relay& network, int leader, std::deque<rank_message> early) {
  const auto next = [&] {
    if (early.empty())
      return awaited(network);
    rank_message first = std::move(early.front());
    early.pop_front();
    return first;
  };
  while (next().peer != leader) {
  }
}

/// The command for all of a group on its leader; the others wait.
int compute_in_group(network_by_relay network, int partition_desk, const ranks_to_run& ranks,
                     const std::function<int(const relayed_rank&)>& command) {
  const int own = network.rank();
  met_ranks met;
  try {
    met = meet(network, introduction(), ranks.group, ranks.command_line);
    if (const int leader = met.groups.leader_of_rank[static_cast<std::size_t>(own)]; own != leader) {
      await_leader(network, leader, std::move(met.early));
      return exit_ok;
    }
  } catch (const cancelled&) {
    return ranks.stopped();
  } catch (const communication_error&) { // a rank that was asked to stop too may have gone first
    if (!stop_was_requested())
      throw;
    return ranks.stopped();
  }
  const std::vector<int> group = met.groups.group_of(own);
  if (group.size() > 1)
    use_processors(met.groups.processors[static_cast<std::size_t>(own)]);
  const int code =
      command({network_of_leaders(network, met.groups, std::move(met.early)), partition_desk, group});
  if (code == exit_ok)
    for (const int member : group)
      if (member != own)
        network.send(member, group_tags::over, {});
  return code;
}

} // namespace

int run_on_ranks(const ranks_to_run& ranks, const std::function<int(const relayed_rank&)>& command,
                 const clean_up_on_ranks& clean_up) {
  const auto [of_relay, of_computing] = connected_sockets();
  const bool first = rank_of_mpirun().rank == 0;
  const kept_error_stream said(!first);
  const pid_t relay = ::getpid(), starter = ::getppid();
  supervisor computing; // before MPI, which starts threads
  if (computing.has_no_child())
    throw usage_error("the system refuses to start a process");
  if (!computing.supervises()) {
    of_relay.close();
    ::setpgid(0, 0); // mpirun's signals go to the group of the relay, which passes them on
    end_without_parent();
    if (!all_meet(of_computing.messages, starter))
      return exit_failure;
    end_with_parent(relay);
    said.redirect();
    return compute_in_group(network_by_relay(of_computing.messages), of_computing.partition_desk, ranks,
                            command);
  }
  of_computing.close();
  if (place_of_mpirun().rank == 0)
    remove_dead_mpi_segments();
  const boost::mpi::environment started(boost::mpi::threading::single, false);
  try {
    return relay_of_rank(computing, of_relay, said, first, clean_up);
  } catch (const std::exception& problem) { // the others would wait for this relay
    computing.end();
    computing.await_workers();
    complain("rank " + std::to_string(rank_of_mpirun().rank) + ": " + problem.what());
    boost::mpi::environment::abort(exit_failure);
    return exit_failure;
  }
}

#else

int run_on_ranks(const ranks_to_run&, const std::function<int(const relayed_rank&)>&,
                 const clean_up_on_ranks&) {
  throw command_line_error(
      "this program was built without MPI and cannot run on several ranks; start it without "
      "mpirun, or build it where Boost.MPI is");
}

#endif

} // namespace dovetail::app
