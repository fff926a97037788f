#include "rank_supervision.hpp"

#include "failure.hpp"

#include <cstdlib>

#ifdef DOVETAIL_DRIVER_WITH_MPI
#include "supervision.hpp"

#include "dovetail/core/bytes.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/parallel/mpi.hpp"
#include "dovetail/parallel/relay.hpp"

#include <boost/mpi/environment.hpp>

#include <array>
#include <chrono>
#include <cstdio>
#include <string>
#include <vector>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <unistd.h>
#endif

namespace dovetail::app {

mpirun_rank rank_of_mpirun() {
  struct names {
    const char* rank;
    const char* size;
  };
  for (const names& starter :
       {names{"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"}, names{"PMI_RANK", "PMI_SIZE"},
        names{"SLURM_PROCID", "SLURM_STEP_NUM_TASKS"}}) {
    const char* rank = std::getenv(starter.rank);
    const char* size = std::getenv(starter.size);
    if (rank != nullptr && size != nullptr)
      return {std::atoi(rank), std::atoi(size)};
  }
  return {};
}

#ifdef DOVETAIL_DRIVER_WITH_MPI

namespace {

constexpr std::chrono::milliseconds pause{1}; ///< between two looks of a relay; a message waits so long

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
    const std::string prefix = "dovetail: ";
    return said.starts_with(prefix) ? said.substr(prefix.size()) : said;
  }

private:
  int file_;
};

/// How the computing process of a rank has ended.
struct rank_end {
  int code = exit_ok;
  bool by_itself = false; ///< and was not killed because another one had ended
  std::string cause;      ///< one line, where it did not end well
};

rank_end decode_end(const byte_buffer& bytes) {
  byte_reader from(bytes);
  rank_end end;
  end.code = from.value<std::int32_t>();
  end.by_itself = from.value<std::uint8_t>() != 0;
  end.cause = from.text();
  return end;
}

byte_buffer encode_end(const rank_end& end) {
  byte_writer to;
  to.value<std::int32_t>(end.code);
  to.value<std::uint8_t>(end.by_itself);
  to.text(end.cause);
  return to.take();
}

/// Passes messages until the computing process has ended.
rank_end relay_until_end(supervisor& computing, parallel::mpi& network, int socket,
                         const kept_error_stream& said) {
  parallel::relay relay(network, socket);
  bool others_go_on = true;
  while (!computing.has_ended(pause)) {
    try {
      if (others_go_on)
        while (relay.step()) {
        }
    } catch (const communication_error& problem) {
      others_go_on = false;
      relay.tell_abandoned(problem.what());
      computing.end_soon();
    }
  }
  computing.await_workers();
  try {
    while (others_go_on && relay.step()) { // what it said last
    }
  } catch (const communication_error&) {
    others_go_on = false;
  }
  rank_end end{computing.code(), others_go_on || !computing.was_killed(), {}};
  if (end.code == exit_ok || !end.by_itself)
    return end;
  end.cause = computing.ended()        ? stopped_line(false)
              : computing.was_killed() ? computing.killed_line()
                                       : said.text();
  if (others_go_on)
    network.abandon(end.cause);
  return end;
}

/// On rank 0: the exit code of all, with what is to be said on the error stream.
int conclude(const std::vector<rank_end>& ends, bool first_has_spoken,
             const std::function<bool()>& clean_up) {
  const rank_end* failed = nullptr;
  for (const rank_end& end : ends)
    if (end.code != exit_ok && end.by_itself && failed == nullptr)
      failed = &end;
  if (failed == nullptr)
    return exit_ok;
  const bool can_go_on = cleaned_up(clean_up);
  const bool stopped = failed->code == exit_stopped;
  if (failed != &ends.front() || !first_has_spoken)
    complain(stopped ? stopped_line(can_go_on)
             : failed == &ends.front()
                 ? failed->cause
                 : "rank " + std::to_string(failed - ends.data()) + ": " + failed->cause);
  return failed->code;
}

int relay_of_rank(supervisor& computing, int socket, const kept_error_stream& said, bool first,
                  const std::function<bool()>& clean_up) {
  const mpirun_rank expected = rank_of_mpirun();
  parallel::mpi network;
  if (network.rank() != expected.rank || network.size() != expected.size)
    throw usage_error("mpirun says rank " + std::to_string(expected.rank) + " of " +
                      std::to_string(expected.size) + ", and MPI rank " + std::to_string(network.rank()) +
                      " of " + std::to_string(network.size()) +
                      "; start it with the mpirun of the MPI it was built with");
  any_communicator relays = parallel::mpi{}; // of which none abandons another
  const rank_end end = relay_until_end(computing, network, socket, said);
  std::vector<rank_end> all;
  for (const byte_buffer& theirs : relays.gather(encode_end(end)))
    all.push_back(decode_end(theirs));
  byte_writer code;
  if (first)
    code.value<std::int32_t>(conclude(all, !computing.was_killed(), clean_up));
  const byte_buffer agreed = relays.broadcast(code.take());
  return byte_reader(agreed).value<std::int32_t>();
}

} // namespace

int run_on_ranks(const std::function<int(const any_communicator&)>& command,
                 const std::function<bool()>& clean_up) {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    throw usage_error("the system refuses a socket between two processes");
  const bool first = rank_of_mpirun().rank == 0;
  const kept_error_stream said(!first);
  supervisor computing; // before MPI, which starts threads
  if (computing.has_no_child())
    throw usage_error("the system refuses to start a process");
  if (!computing.supervises()) {
    ::close(ends[0]);
    said.redirect();
    return command(parallel::relayed(ends[1]));
  }
  ::close(ends[1]);
  const boost::mpi::environment started(boost::mpi::threading::single, false);
  try {
    return relay_of_rank(computing, ends[0], said, first, clean_up);
  } catch (const std::exception& problem) { // the others would wait for this relay
    computing.end();
    computing.await_workers();
    complain("rank " + std::to_string(rank_of_mpirun().rank) + ": " + problem.what());
    boost::mpi::environment::abort(exit_failure);
    return exit_failure;
  }
}

#else

int run_on_ranks(const std::function<int(const any_communicator&)>&, const std::function<bool()>&) {
  throw command_line_error(
      "this program was built without MPI and cannot run on several ranks; start it without "
      "mpirun, or build it where Boost.MPI is");
}

#endif

} // namespace dovetail::app
