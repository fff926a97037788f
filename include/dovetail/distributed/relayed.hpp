/// @file
/// The communicator of a process that must stay free of a network's threads: another one speaks for it.
#pragma once

#include "dovetail/core/bytes.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/distributed/socket_frames.hpp"
#include "dovetail/parallel/communicator.hpp"

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <poll.h>
#include <string>
#include <utility>

namespace dovetail::parallel {

/// What the two ends say to each other beside messages between ranks, whose tags are 0 and more.
struct relay_tags {
  static constexpr std::int32_t hello = -1;     ///< to the computing process: rank and size
  static constexpr std::int32_t abandoned = -2; ///< both ways: a rank goes no further; the reason
};

/// A model of `communicator`: the computing process's end of a socket to a `relay`, which alone speaks MPI.
/// MPI starts threads, and a process with threads cannot fork workers.
class relayed {
public:
  /// Waits until the relay knows the network. The socket stays its owner's.
  explicit relayed(int socket) : frames_(std::make_unique<detail::socket_frames>(socket)) {
    std::optional<rank_message> first;
    while (!(first = take()))
      wait(std::chrono::milliseconds(100));
    byte_reader from(first->bytes);
    rank_ = from.value<std::int32_t>();
    size_ = from.value<std::int32_t>();
  }

  int rank() const { return rank_; }
  int size() const { return size_; }
  /// The relay takes everything at once, so that nothing waits here while this process computes.
  void send(int to, std::int32_t tag, byte_buffer bytes) {
    frames_->send(to, tag, std::move(bytes));
    flush();
    require_relay();
  }
  std::optional<rank_message> receive() { return take(); }
  void wait(std::chrono::milliseconds at_most) {
    require_relay();
    pollfd watched{frames_->socket(), POLLIN, 0};
    ::poll(&watched, 1, static_cast<int>(at_most.count()));
  }
  int descriptor() const { return frames_->socket(); }
  bool shares_process() const { return false; }
  void abandon(const std::string& reason) {
    byte_writer text;
    text.text(reason);
    frames_->send(rank_, relay_tags::abandoned, text.take());
    flush();
  }

private:
  void flush() {
    while (!frames_->flush() && !frames_->closed()) {
      pollfd watched{frames_->socket(), POLLOUT, 0};
      ::poll(&watched, 1, 100);
    }
  }
  std::optional<rank_message> take() {
    auto next = frames_->receive();
    if (next && next->tag == relay_tags::abandoned)
      throw communication_error(byte_reader(next->bytes).text());
    if (!next)
      require_relay();
    return next;
  }
  void require_relay() const {
    if (frames_->closed())
      throw communication_error("the process that speaks to the other ranks is gone");
  }

  std::unique_ptr<detail::socket_frames> frames_;
  int rank_ = 0;
  int size_ = 1;
};
static_assert(communicator<relayed>);

} // namespace dovetail::parallel
