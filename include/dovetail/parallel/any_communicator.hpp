/// @file
/// Any communicator behind one type, and what ranks do together, made of its messages.
#pragma once

#include "dovetail/core/bytes.hpp"
#include "dovetail/core/encoding.hpp"
#include "dovetail/parallel/communicator.hpp"

#include <chrono>
#include <concepts>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dovetail {

/// Holds any communicator; copies share it. The functions of the second half are collective: all ranks call
/// the same ones in the same order. They throw `communication_error` when another rank goes no further.
class any_communicator {
public:
  template <class C>
    requires(!std::same_as<C, any_communicator> && communicator<C>)
  any_communicator(C policy) // NOLINT: converts, as std::function does
      : state_(std::make_shared<state>(std::make_unique<model<C>>(std::move(policy)))) {}

  int rank() const { return state_->link->rank(); } ///< the number of this rank
  int size() const { return state_->link->size(); }
  bool leads() const { return rank() == 0; } ///< whether this is rank 0
  /// Whether other ranks are threads of this process.
  bool shares_process() const { return state_->link->shares_process(); }
  /// What to wait at for messages, a file descriptor; -1 without one.
  int descriptor() const { return state_->link->descriptor(); }
  /// Tells all other ranks that this one goes no further, and why.
  void abandon(const std::string& reason) { state_->link->abandon(reason); }
  /// Waits until a message comes, or so long.
  void wait(std::chrono::milliseconds at_most) { state_->link->wait(at_most); }

  /// Sends bytes to another rank. Throws `usage_error` when there is no such rank, or it is this one.
  void send(int to, std::int32_t tag, byte_buffer bytes);
  /// The next message with this tag that has arrived.
  std::optional<rank_message> receive(std::int32_t tag);
  /// The same, once there is one.
  rank_message await(std::int32_t tag);

  /// A tag of a conversation that is to come, which nothing else has. Collective.
  std::int32_t next_tag() {
    state_->tag = (state_->tag + 1) & 0x3fffffff;
    return state_->tag;
  }

  /// What the root has, on all ranks. Over a binomial tree: O(log size) messages on each rank.
  byte_buffer broadcast(byte_buffer bytes, int root = 0);

  /// What each rank has, on the root, by rank; nothing on the others.
  std::vector<byte_buffer> gather(byte_buffer bytes, int root = 0);

  /// What each rank has, on all ranks, by rank.
  std::vector<byte_buffer> all_gather(byte_buffer bytes);

  /// The same of values.
  template <encodable T>
    requires(!std::same_as<T, byte_buffer>)
  std::vector<T> all_gather(const T& value) { return values_of<T>(all_gather(encoded(value))); }
  template <encodable T>
    requires(!std::same_as<T, byte_buffer>)
  std::vector<T> gather(const T& value, int root = 0) { return values_of<T>(gather(encoded(value), root)); }

  /// The sum of the values of all lower ranks, and of all ranks.
  struct scan {
    std::int64_t before = 0; ///< of all lower ranks
    std::int64_t in_all = 0; ///< of all ranks
  };
  /// Sums by rank. Collective.
  scan exclusive_scan(std::int64_t value);

  /// To some ranks (`peer` of each message), none twice, the own one allowed; returns what has come, by rank.
  /// Nobody needs to know from whom something comes. Tags are not looked at.
  std::vector<rank_message> exchange(std::vector<rank_message> out);

  /// What `work()` returns on rank 0, on all ranks; an error of it is thrown on all.
  byte_buffer once(const std::function<byte_buffer()>& work);

  /// The same of a value, which where there is one rank need not become bytes.
  template <class Work>
  auto once(const Work& work) requires(!std::same_as<decltype(work()), byte_buffer>) {
    using value = decltype(work());
    return size() == 1
               ? work()
               : decoded<value>(once(std::function<byte_buffer()>([&] { return encoded<value>(work()); })));
  }

  /// Returns when all ranks have come here. Where one comes with an error, all throw it: that of the lowest
  /// rank, of the same type.
  void agree(const std::exception_ptr& failure = nullptr);

private:
  template <class T>
  static std::vector<T> values_of(const std::vector<byte_buffer>& all) {
    std::vector<T> values;
    for (const byte_buffer& bytes : all)
      values.push_back(decoded<T>(bytes));
    return values;
  }

  struct link {
    virtual ~link() = default;
    virtual int rank() = 0;
    virtual int size() = 0;
    virtual void send(int to, std::int32_t tag, byte_buffer bytes) = 0;
    virtual std::optional<rank_message> receive() = 0;
    virtual void wait(std::chrono::milliseconds at_most) = 0;
    virtual int descriptor() = 0;
    virtual bool shares_process() = 0;
    virtual void abandon(const std::string& reason) = 0;
  };
  template <class C>
  struct model final : link {
    explicit model(C policy) : held(std::move(policy)) {}
    int rank() override { return held.rank(); }
    int size() override { return held.size(); }
    void send(int to, std::int32_t tag, byte_buffer bytes) override { held.send(to, tag, std::move(bytes)); }
    std::optional<rank_message> receive() override { return held.receive(); }
    void wait(std::chrono::milliseconds at_most) override { held.wait(at_most); }
    int descriptor() override { return held.descriptor(); }
    bool shares_process() override { return held.shares_process(); }
    void abandon(const std::string& reason) override { held.abandon(reason); }
    C held;
  };
  struct state {
    explicit state(std::unique_ptr<any_communicator::link> made) : link(std::move(made)) {}
    std::unique_ptr<any_communicator::link> link;
    std::map<std::int32_t, std::deque<rank_message>> waiting; ///< by tag: came before they were asked for
    std::int32_t tag = 0;
  };
  std::shared_ptr<state> state_;
};

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/parallel/any_communicator.ipp"
#endif
