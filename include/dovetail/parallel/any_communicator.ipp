/// @file
/// What `any_communicator.hpp` declares.
#pragma once

#include "dovetail/core/bytes.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/parallel/any_communicator.hpp"
#include "dovetail/parallel/communicator.hpp"
#include "dovetail/parallel/error_codec.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

DOVETAIL_INLINE void any_communicator::send(int to, std::int32_t tag, byte_buffer bytes) {
  if (to < 0 || to >= size() || to == rank())
    throw usage_error("rank " + std::to_string(rank()) + " cannot send to rank " + std::to_string(to) +
                      " of " + std::to_string(size()));
  state_->link->send(to, tag, std::move(bytes));
}

DOVETAIL_INLINE std::optional<rank_message> any_communicator::receive(std::int32_t tag) {
  while (auto arrived = state_->link->receive()) {
    std::deque<rank_message>& queue = state_->waiting[arrived->tag];
    queue.push_back(*std::move(arrived));
  }
  const auto found = state_->waiting.find(tag);
  if (found == state_->waiting.end())
    return std::nullopt;
  rank_message next = std::move(found->second.front());
  found->second.pop_front();
  if (found->second.empty())
    state_->waiting.erase(found);
  return next;
}

DOVETAIL_INLINE rank_message any_communicator::await(std::int32_t tag) {
  for (;;) {
    if (auto next = receive(tag))
      return *std::move(next);
    wait(std::chrono::milliseconds(100));
  }
}

DOVETAIL_INLINE byte_buffer any_communicator::broadcast(byte_buffer bytes, int root) {
  const std::int32_t tag = next_tag();
  const int from_root = (rank() - root + size()) % size();
  int reach = 1;
  for (; reach < size() && (from_root & reach) == 0; reach *= 2) {
  }
  if (from_root != 0)
    bytes = await(tag).bytes;
  for (reach /= 2; reach > 0; reach /= 2)
    if (from_root + reach < size())
      send((from_root + reach + root) % size(), tag, bytes);
  return bytes;
}

DOVETAIL_INLINE std::vector<byte_buffer> any_communicator::gather(byte_buffer bytes, int root) {
  const std::int32_t tag = next_tag();
  if (rank() != root) {
    send(root, tag, std::move(bytes));
    return {};
  }
  std::vector<byte_buffer> all(static_cast<std::size_t>(size()));
  all[root] = std::move(bytes);
  for (int others = 1; others < size(); ++others) {
    rank_message next = await(tag);
    all[next.peer] = std::move(next.bytes);
  }
  return all;
}

DOVETAIL_INLINE std::vector<byte_buffer> any_communicator::all_gather(byte_buffer bytes) {
  byte_writer joined;
  for (const byte_buffer& part : gather(std::move(bytes)))
    joined.array(part);
  const byte_buffer whole = broadcast(joined.take());
  std::vector<byte_buffer> all;
  for (byte_reader from(whole); !from.at_end();)
    all.push_back(from.array<std::byte>());
  return all;
}

DOVETAIL_INLINE any_communicator::scan any_communicator::exclusive_scan(std::int64_t value) {
  scan sums;
  int from = 0;
  for (const std::int64_t theirs : all_gather(value)) {
    sums.before += from++ < rank() ? theirs : 0;
    sums.in_all += theirs;
  }
  return sums;
}

DOVETAIL_INLINE std::vector<rank_message> any_communicator::exchange(std::vector<rank_message> out) {
  std::vector<std::int32_t> to;
  for (const rank_message& message : out)
    to.push_back(static_cast<std::int32_t>(message.peer));
  const auto receivers = all_gather(to);
  const std::int32_t tag = next_tag();
  std::vector<rank_message> in;
  for (rank_message& message : out)
    if (message.peer == rank())
      in.push_back(std::move(message));
    else
      send(message.peer, tag, std::move(message.bytes));
  std::size_t coming = 0;
  for (const auto& theirs : receivers)
    coming += static_cast<std::size_t>(std::count(theirs.begin(), theirs.end(), rank()));
  while (in.size() < coming)
    in.push_back(await(tag));
  std::sort(in.begin(), in.end(), [](const auto& a, const auto& b) { return a.peer < b.peer; });
  return in;
}

DOVETAIL_INLINE byte_buffer any_communicator::once(const std::function<byte_buffer()>& work) {
  if (size() == 1)
    return work();
  byte_buffer made; // and behind it whether it is an error
  std::exception_ptr failure;
  if (leads()) {
    try {
      made = work();
    } catch (...) {
      failure = std::current_exception();
      made = encode_error(failure);
    }
    made.push_back(std::byte{failure != nullptr});
  }
  made = broadcast(std::move(made));
  if (failure) // with its own type
    std::rethrow_exception(failure);
  const bool failed = made.back() != std::byte{0};
  made.pop_back();
  if (failed)
    throw_error(made);
  return made;
}

DOVETAIL_INLINE void any_communicator::agree(const std::exception_ptr& failure) {
  for (const byte_buffer& theirs : all_gather(failure ? encode_error(failure) : byte_buffer{}))
    if (!theirs.empty())
      throw_error(theirs);
}

} // namespace dovetail
