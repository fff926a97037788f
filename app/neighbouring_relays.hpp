/// @file
/// The relays of the ranks on this machine: each sees when another one is killed, before MPI does or hangs.
#pragma once

#include "dovetail/parallel/any_communicator.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <poll.h>
#include <sys/types.h>

namespace dovetail::app {

/// The same for processes that know each other by number.
std::string place_of_numbers();

/// Thrown where this relay goes no further since another one is gone.
struct relay_lost {
  int rank;
};

/// Holds nobody until `meet` or `look_for`, nor where the kernel has no descriptors of processes (Linux
/// before 5.3).
class neighbouring_relays {
public:
  neighbouring_relays() = default;
  neighbouring_relays(const neighbouring_relays&) = delete;
  neighbouring_relays& operator=(const neighbouring_relays&) = delete;
  ~neighbouring_relays();

  /// Collective, of the relays; `computing` is the process that this one speaks for.
  void meet(any_communicator& relays, pid_t computing);

  /// Before MPI is initialised: adds those that this process has started for the same run since it was last
  /// looked for them.
  void look_for(pid_t starter);
  int count() const { return static_cast<int>(ranks_.size()); }
  /// Until one is gone, or there is something to read or nobody at the other end of the socket, or so long.
  void await_change(int socket, std::chrono::milliseconds at_most) const;

  /// By one call of the system, however many they are: a relay asks at each look for messages.
  bool all_live() const;
  /// Throws `relay_lost` with the lowest rank whose relay is gone.
  void require_all() const;
  /// The lowest rank whose relay lives, maybe this one; whose relay is gone.
  int first_living() const { return first(true); }
  int first_gone() const { return first(false); }
  /// Until this one's relay has ended, or so long.
  void await_relay(int rank, std::chrono::milliseconds at_most) const;
  /// Until no process computes on this machine, or so long.
  void await_computing(std::chrono::milliseconds at_most) const;

  static constexpr int nobody = -1;

private:
  /// The relay, and descriptors of processes; -1: none to be had.
  struct processes {
    int rank;
    pid_t process;
    int relay;
    int computing;
  };
  void add(const processes& of_rank);
  int first(bool living) const;

  std::vector<processes> ranks_;  ///< by rank, this one too
  std::set<pid_t> looked_at_;     ///< of `look_for`
  std::vector<pollfd> of_relays_; ///< of the same, to be watched together
};

/// A model of `communicator` that throws `relay_lost` where `C` would wait for a relay that is gone.
template <communicator C>
class watched_network {
public:
  watched_network(C network, const neighbouring_relays& neighbours)
      : network_(std::move(network)), neighbours_(&neighbours) {}

  int rank() const { return network_.rank(); }
  int size() const { return network_.size(); }
  void send(int to, std::int32_t tag, byte_buffer bytes) { network_.send(to, tag, std::move(bytes)); }
  std::optional<rank_message> receive() {
    auto next = network_.receive();
    if (!next)
      neighbours_->require_all();
    return next;
  }
  void wait(std::chrono::milliseconds at_most) { network_.wait(at_most); }
  int descriptor() const { return network_.descriptor(); }
  bool shares_process() const { return network_.shares_process(); }
  void abandon(const std::string& reason) { network_.abandon(reason); }

private:
  C network_;
  const neighbouring_relays* neighbours_;
};

} // namespace dovetail::app
