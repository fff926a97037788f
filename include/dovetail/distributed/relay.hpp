/// @file
/// The process that speaks to the other ranks for one that computes.
#pragma once

#include "dovetail/core/bytes.hpp"
#include "dovetail/distributed/relayed.hpp"
#include "dovetail/distributed/socket_frames.hpp"
#include "dovetail/parallel/communicator.hpp"

#include <cstdint>
#include <string>
#include <utility>

namespace dovetail::parallel {

/// Passes messages between a network and a computing process's `relayed`, which it made before it knew the
/// network. Its owner calls `step` and sleeps in between.
template <communicator C>
class relay {
public:
  /// The socket stays its owner's.
  relay(C& network, int socket) : network_(network), frames_(socket) {
    byte_writer hello;
    hello.value(static_cast<std::int32_t>(network_.rank()));
    hello.value(static_cast<std::int32_t>(network_.size()));
    frames_.send(network_.rank(), relay_tags::hello, hello.take());
  }

  /// Passes what is there, both ways; returns whether there was anything. Throws `communication_error` when
  /// another rank goes no further: the owner tells the computing process, or ends it.
  bool step() {
    bool any = false;
    while (auto out = frames_.receive()) {
      any = true;
      if (out->tag == relay_tags::abandoned)
        network_.abandon(byte_reader(out->bytes).text());
      else
        network_.send(out->peer, out->tag, std::move(out->bytes));
    }
    while (auto in = network_.receive()) {
      any = true;
      frames_.send(in->peer, in->tag, std::move(in->bytes));
    }
    frames_.flush();
    return any;
  }

  /// The computing process's next look for a message throws `communication_error`.
  void tell_abandoned(const std::string& reason) {
    byte_writer text;
    text.text(reason);
    frames_.send(network_.rank(), relay_tags::abandoned, text.take());
  }

private:
  C& network_;
  detail::socket_frames frames_;
};

} // namespace dovetail::parallel
