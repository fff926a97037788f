#include "neighbouring_relays.hpp"

#include "dovetail/core/bytes.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

#include <poll.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace dovetail::app {
namespace {

/// The same for processes that know each other by number.
std::string place_of_numbers() {
  std::string boot;
  std::ifstream("/proc/sys/kernel/random/boot_id") >> boot;
  std::error_code ignored;
  return boot + std::filesystem::read_symlink("/proc/self/ns/pid", ignored).string();
}

int descriptor_of(pid_t process) {
  return static_cast<int>(::syscall(SYS_pidfd_open, process, 0));
}

/// Whether the process has ended, now or within so long.
bool has_ended(int descriptor, std::chrono::milliseconds at_most = {}) {
  pollfd watched{descriptor, POLLIN, 0};
  return descriptor >= 0 && ::poll(&watched, 1, static_cast<int>(at_most.count())) > 0;
}

} // namespace

neighbouring_relays::~neighbouring_relays() {
  for (const processes& of_rank : ranks_)
    for (const int descriptor : {of_rank.relay, of_rank.computing})
      if (descriptor >= 0)
        ::close(descriptor);
}

void neighbouring_relays::meet(any_communicator& relays, pid_t computing) {
  const std::string here = place_of_numbers();
  int rank = 0;
  for (const auto& [place, of_relay, of_computing] :
       relays.all_gather(std::tuple(here, ::getpid(), computing))) {
    if (place == here) {
      const int relay = descriptor_of(of_relay);
      ranks_.push_back({rank, relay, descriptor_of(of_computing)});
      of_relays_.push_back({relay, POLLIN, 0});
    }
    ++rank;
  }
}

bool neighbouring_relays::all_live() const {
  std::vector<pollfd> watched = of_relays_;
  return ::poll(watched.data(), watched.size(), 0) <= 0;
}

void neighbouring_relays::require_all() const {
  if (!all_live())
    throw relay_lost{first(false)};
}

void neighbouring_relays::await_relay(int rank, std::chrono::milliseconds at_most) const {
  for (const processes& of_rank : ranks_)
    if (of_rank.rank == rank)
      has_ended(of_rank.relay, at_most);
}

void neighbouring_relays::await_computing(std::chrono::milliseconds at_most) const {
  const auto until = std::chrono::steady_clock::now() + at_most;
  for (const processes& of_rank : ranks_)
    has_ended(of_rank.computing,
              std::max(std::chrono::milliseconds(0), std::chrono::duration_cast<std::chrono::milliseconds>(
                                                         until - std::chrono::steady_clock::now())));
}

int neighbouring_relays::first(bool living) const {
  const auto found = std::find_if(ranks_.begin(), ranks_.end(),
                                  [&](const processes& p) { return has_ended(p.relay) != living; });
  return found == ranks_.end() ? nobody : found->rank;
}

} // namespace dovetail::app
