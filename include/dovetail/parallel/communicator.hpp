/// @file
/// What a distributed run asks of the network between its ranks.
#pragma once

#include "dovetail/core/bytes.hpp"

#include <chrono>
#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace dovetail {

/// Bytes between two ranks. Who sends and who receives agree on the tag, which is 0 or more.
struct rank_message {
  int peer = 0;           ///< who sent it
  std::int32_t tag = 0;   ///< which sender and receiver agree on
  byte_buffer bytes = {}; ///< what is sent
};

/// The role `communicator`: messages between the ranks of a run. What ranks do together (broadcast, gather,
/// agree) is made of them by `any_communicator`, the same for every model.
///
/// Valid expressions for `C& c`:
///
/// - `c.rank()`, `c.size()`: this rank, from 0, and how many there are: int
/// - `c.send(to, tag, bytes)`: to another rank; returns when the bytes are no longer needed here
/// - `c.receive()`: std::optional<rank_message>, the next that has arrived; nothing when there is none
/// - `c.wait(at_most)`: waits until something may have arrived, or so many milliseconds
/// - `c.descriptor()`: a file descriptor that can be read when something may have arrived, or -1: an int
/// - `c.shares_process()`: whether the ranks are threads of one process
/// - `c.abandon(reason)`: this rank goes no further
///
/// Semantics: messages from one rank to another arrive in order. Waiting leaves the processor to others. A
/// message has any size. Each rank uses its own communicator, from one thread.
///
/// Complexity: `send` and `receive` copy the bytes once or twice; neither waits for another rank.
///
/// Failure: once a rank has abandoned the run or died, `send`, `receive` and `wait` of the others throw
/// `communication_error`, at the latest when they wait for something that will not come.
///
/// Models: self, in_process, mpi, relayed.
template <class C>
concept communicator = requires(C& c, int to, std::int32_t tag, byte_buffer bytes,
                                std::chrono::milliseconds at_most, const std::string& reason) {
  { c.rank() } -> std::same_as<int>;
  { c.size() } -> std::same_as<int>;
  c.send(to, tag, std::move(bytes));
  { c.receive() } -> std::same_as<std::optional<rank_message>>;
  c.wait(at_most);
  { c.descriptor() } -> std::same_as<int>;
  { c.shares_process() } -> std::convertible_to<bool>;
  c.abandon(reason);
}
&&std::movable<C>;

} // namespace dovetail
