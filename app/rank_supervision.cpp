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
  const auto number = [](const char* first, const char* second, int otherwise) {
    for (const char* name : {first, second})
      if (const char* text = std::getenv(name))
        return std::atoi(text);
    return otherwise;
  };
  return {number("OMPI_COMM_WORLD_RANK", "PMI_RANK", 0), number("OMPI_COMM_WORLD_SIZE", "PMI_SIZE", 1)};
}

#ifdef DOVETAIL_DRIVER_WITH_MPI

namespace {

constexpr std::chrono::milliseconds pause{1}; ///< between two looks of a relay; a message waits so long

/// What the computing processes of other ranks say on the error stream, which rank 0 says for all.
class silenced {
public:
  explicit silenced(bool wanted) : file_(wanted ? ::memfd_create("said", MFD_CLOEXEC) : -1) {}
  silenced(const silenced&) = delete;
  silenced& operator=(const silenced&) = delete;
  ~silenced() {
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
  bool own = false;  ///< and not because another one had
  std::string cause; ///< one line, where it did not end well
};

rank_end decode_end(const byte_buffer& bytes) {
  byte_reader from(bytes);
  rank_end end;
  end.code = from.value<std::int32_t>();
  end.own = from.value<std::uint8_t>() != 0;
  end.cause = from.text();
  return end;
}

byte_buffer encode_end(const rank_end& end) {
  byte_writer to;
  to.value<std::int32_t>(end.code);
  to.value<std::uint8_t>(end.own);
  to.text(end.cause);
  return to.take();
}

/// Passes messages until the computing process has ended.
rank_end relay_until_end(supervisor& computing, parallel::mpi& network, int socket, const silenced& said) {
  parallel::relay relay(network, socket);
  bool others_go_on = true;
  while (!computing.has_ended(pause)) {
    try {
      if (others_go_on)
        while (relay.step()) {
        }
    } catch (const communication_error&) {
      others_go_on = false;
      if (!computing.was_requested()) // as the other rank was, and it says so itself
        computing.end();
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
  if (end.code == exit_ok || !end.own)
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
    if (end.code != exit_ok && end.own && failed == nullptr)
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

} // namespace

int run_on_ranks(const std::function<int(const any_communicator&)>& command,
                 const std::function<bool()>& clean_up) {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    throw usage_error("the system refuses a socket between two processes");
  const bool first = rank_of_mpirun().rank == 0;
  const silenced said(!first);
  supervisor computing; // before MPI, which starts threads
  if (!computing.supervises()) {
    ::close(ends[0]);
    said.redirect();
    return command(parallel::relayed(ends[1]));
  }
  ::close(ends[1]);
  const boost::mpi::environment started(boost::mpi::threading::single, false);
  parallel::mpi network;
  any_communicator relays = parallel::mpi{}; // of which none abandons another
  const rank_end end = relay_until_end(computing, network, ends[0], said);
  ::close(ends[0]);
  std::vector<rank_end> all;
  for (const byte_buffer& theirs : relays.gather(encode_end(end)))
    all.push_back(decode_end(theirs));
  byte_writer code;
  if (first)
    code.value<std::int32_t>(conclude(all, !computing.was_killed(), clean_up));
  const byte_buffer agreed = relays.broadcast(code.take());
  return byte_reader(agreed).value<std::int32_t>();
}

#else

int run_on_ranks(const std::function<int(const any_communicator&)>&, const std::function<bool()>&) {
  throw command_line_error(
      "this program was built without MPI and cannot run on several ranks; start it without "
      "mpirun, or build it where Boost.MPI is");
}

#endif

} // namespace dovetail::app
