/// @file
/// The communicator of a run that has one rank.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/parallel/communicator.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <thread>

namespace dovetail::parallel {

/// A model of `communicator` with nobody else. Throws `usage_error` when something is sent.
struct self {
  int rank() const { return 0; }
  int size() const { return 1; }
  void send(int to, std::int32_t, const byte_buffer&) const {
    throw usage_error("there is no rank " + std::to_string(to) + " to send to: this run has one rank");
  }
  std::optional<rank_message> receive() const { return std::nullopt; }
  void wait(std::chrono::milliseconds at_most) const { std::this_thread::sleep_for(at_most); }
  int descriptor() const { return -1; }
  bool shares_process() const { return false; }
  void abandon(const std::string&) const {}
};
static_assert(communicator<self>);

} // namespace dovetail::parallel
