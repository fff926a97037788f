#include "neighbouring_relays.hpp"

#include "mpirun_rank.hpp"

#include "dovetail/core/bytes.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>
#include <thread>

#include <poll.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace dovetail::app {
namespace {

std::vector<pid_t> children_of(pid_t process) {
  std::vector<pid_t> children;
  std::error_code problem;
  const auto threads = "/proc/" + std::to_string(process) + "/task";
  for (std::filesystem::directory_iterator thread(threads, problem), end; !problem && thread != end;
       thread.increment(problem)) {
    std::ifstream listed(thread->path() / "children");
    for (pid_t child = 0; listed >> child;)
      children.push_back(child);
  }
  return children;
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

std::string place_of_numbers() {
  std::string boot;
  std::ifstream("/proc/sys/kernel/random/boot_id") >> boot;
  std::error_code ignored;
  return boot + std::filesystem::read_symlink("/proc/self/ns/pid", ignored).string();
}

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
    if (place == here)
      add({rank, of_relay, descriptor_of(of_relay), descriptor_of(of_computing)});
    ++rank;
  }
}

void neighbouring_relays::look_for(pid_t starter) {
  for (const pid_t process : children_of(starter)) {
    const auto of_run = looked_at_.contains(process) ? std::nullopt : rank_of_mpirun(process);
    if (!of_run) // or not yet: it is still a copy of its starter
      continue;
    looked_at_.insert(process);
    add({of_run->rank, process, descriptor_of(process), -1});
  }
}

void neighbouring_relays::await_change(int socket, std::chrono::milliseconds at_most) const {
  std::vector<pollfd> watched = of_relays_;
  watched.push_back({socket, POLLIN, 0});
  ::poll(watched.data(), watched.size(), static_cast<int>(at_most.count()));
}

void neighbouring_relays::add(const processes& of_rank) {
  const auto after =
      std::find_if(ranks_.begin(), ranks_.end(), [&](const processes& p) { return p.rank > of_rank.rank; });
  ranks_.insert(after, of_rank);
  of_relays_.push_back({of_rank.relay, POLLIN, 0});
}

bool neighbouring_relays::all_live() const {
  std::vector<pollfd> watched = of_relays_;
  return ::poll(watched.data(), watched.size(), 0) <= 0;
}

void neighbouring_relays::require_all() const {
  if (!all_live())
    throw relay_lost{first_gone()};
}

void neighbouring_relays::await_relay(int rank, std::chrono::milliseconds at_most) const {
  for (const processes& of_rank : ranks_)
    if (of_rank.rank == rank)
      has_ended(of_rank.relay, at_most);
}

void neighbouring_relays::await_computing(std::chrono::milliseconds at_most) const {
  using clock = std::chrono::steady_clock;
  const auto until = clock::now() + at_most;
  const auto left = [&] {
    return std::max(std::chrono::milliseconds(0),
                    std::chrono::duration_cast<std::chrono::milliseconds>(until - clock::now()));
  };
  for (const processes& of_rank : ranks_) {
    has_ended(of_rank.computing, left());
    while (!has_ended(of_rank.relay) && !children_of(of_rank.process).empty() && left().count() > 0)
      std::this_thread::sleep_for(std::chrono::milliseconds(1)); // another one may have taken its place
  }
}

int neighbouring_relays::first(bool living) const {
  const auto found = std::find_if(ranks_.begin(), ranks_.end(),
                                  [&](const processes& p) { return has_ended(p.relay) != living; });
  return found == ranks_.end() ? nobody : found->rank;
}

} // namespace dovetail::app
