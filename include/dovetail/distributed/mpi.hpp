/// @file
/// The communicator over MPI, by Boost.MPI. The only header that includes it.
#pragma once

#include "dovetail/core/bytes.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/parallel/communicator.hpp"

#include <boost/mpi/communicator.hpp>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <list>
#include <map>
#include <optional>
#include <string>
#include <thread>
#include <utility>

namespace dovetail::parallel {

/// A model of `communicator`. Messages are byte arrays, in chunks far below the 2 GiB at which counts of MPI
/// end, two-sided, each received from a sender that is known by then. Who waits sleeps, at most a millisecond
/// at a time. MPI must be initialised before and finalised after. Made, and destroyed, on all ranks of
/// `world` together, when nothing is under way: best once in a program.
class mpi {
public:
  /// `patience`: the longest wait, in `abandon` and in the destructor, for others to take what was sent.
  explicit mpi(const boost::mpi::communicator& world = {}, std::size_t chunk_bytes = std::size_t{1} << 28,
               std::chrono::milliseconds patience = std::chrono::seconds(2))
      : world_(world, boost::mpi::comm_duplicate), chunk_bytes_(std::max(chunk_bytes, sizeof(header))),
        patience_(patience) {}

  mpi(mpi&&) = default;
  mpi& operator=(mpi&&) = default;
  ~mpi() {
    if (reason_.empty() && !has_abandoned_)
      await_sent([](const pending&) { return true; });
    if (!sent_.empty())                         // nobody receives them; MPI still has the bytes
      new std::list<pending>(std::move(sent_)); // NOLINT
    for (std::optional<incoming>* coming : {&coming_, &farewell_})
      if (*coming && !has_come(**coming))
        new incoming(std::move(**coming)); // NOLINT
  }

  int rank() const { return world_.rank(); }
  int size() const { return world_.size(); }
  void send(int to, std::int32_t tag, const byte_buffer& bytes) {
    require_all();
    post(to, tag, bytes);
    drop_sent();
  }

  std::optional<rank_message> receive() {
    hear_farewell();
    require_all();
    drop_sent();
    while (is_coming(coming_, message_tag) && comes_soon()) {
      const int from = coming_->from;
      const byte_buffer chunk = std::move(coming_->chunk);
      coming_.reset();
      header head;
      std::memcpy(&head, chunk.data(), sizeof head);
      byte_buffer& bytes = incomplete_[from];
      bytes.insert(bytes.end(), chunk.begin() + sizeof head, chunk.end());
      if (bytes.size() < head.size)
        continue;
      return rank_message{from, head.tag, std::exchange(bytes, {})};
    }
    return std::nullopt;
  }

  void wait(std::chrono::milliseconds at_most) {
    using clock = std::chrono::steady_clock;
    const auto end = clock::now() + at_most;
    auto pause = std::chrono::microseconds(20);
    while (clock::now() < end && !(is_coming(coming_, message_tag) && has_come(*coming_))) {
      hear_farewell();
      require_all();
      drop_sent();
      std::this_thread::sleep_for(pause);
      pause = std::min(2 * pause, std::chrono::microseconds(1000));
    }
  }
  int descriptor() const { return -1; }
  bool shares_process() const { return false; }

  /// Tells the others, once, and waits until they were told. Who knows it takes no other message any more.
  void abandon(const std::string& reason) {
    if (std::exchange(has_abandoned_, true))
      return;
    byte_writer text;
    text.text(reason);
    const byte_buffer bytes = text.take();
    for (int r = 0; r < size(); ++r)
      if (r != rank())
        start(r, farewell_tag, bytes);
    await_sent([](const pending& one) { return one.is_farewell; });
  }

private:
  /// Before each chunk.
  struct header {
    std::int32_t tag;
    std::uint64_t size; ///< of the whole message
  };
  struct pending {
    byte_buffer bytes;
    boost::mpi::request request;
    bool is_farewell;
  };
  /// A chunk on its way. Who waited for it would never return when its sender dies before it has all.
  struct incoming {
    int from;
    byte_buffer chunk;
    boost::mpi::request request;
    bool has_come = false;
  };
  static constexpr int message_tag = 1;
  static constexpr int farewell_tag = 2; ///< which overtakes what is long on its way

  /// Into a place that is free, or already taken by what came before.
  bool is_coming(std::optional<incoming>& place, int mpi_tag) {
    if (place)
      return true;
    const auto found = world_.iprobe(boost::mpi::any_source, mpi_tag);
    if (!found)
      return false;
    place.emplace(incoming{
        found->source(), byte_buffer(static_cast<std::size_t>(found->count<char>().value_or(0))), {}});
    place->request = world_.irecv(place->from, mpi_tag, reinterpret_cast<char*>(place->chunk.data()),
                                  static_cast<int>(place->chunk.size()));
    return true;
  }
  static bool has_come(incoming& message) {
    message.has_come = message.has_come || message.request.test().has_value();
    return message.has_come;
  }
  void hear_farewell() {
    if (reason_.empty() && is_coming(farewell_, farewell_tag) && has_come(*farewell_))
      reason_ = "rank " + std::to_string(farewell_->from) + ": " + byte_reader(farewell_->chunk).text();
  }
  /// A long chunk moves only while MPI is asked about it.
  bool comes_soon() {
    const auto until = std::chrono::steady_clock::now() + std::chrono::milliseconds(2);
    while (!has_come(*coming_) && std::chrono::steady_clock::now() < until)
      std::this_thread::yield();
    return coming_->has_come;
  }

  void post(int to, std::int32_t tag, const byte_buffer& bytes) {
    std::size_t at = 0;
    do {
      const std::size_t part = std::min(bytes.size() - at, chunk_bytes_);
      const header head{tag, bytes.size()};
      byte_buffer chunk(sizeof head + part);
      std::memcpy(chunk.data(), &head, sizeof head);
      if (part > 0)
        std::memcpy(chunk.data() + sizeof head, bytes.data() + at, part);
      start(to, message_tag, std::move(chunk));
      at += part;
    } while (at < bytes.size());
  }
  void start(int to, int mpi_tag, byte_buffer bytes) {
    pending& next = sent_.emplace_back(pending{std::move(bytes), {}, mpi_tag == farewell_tag});
    next.request = world_.isend(to, mpi_tag, reinterpret_cast<const char*>(next.bytes.data()),
                                static_cast<int>(next.bytes.size()));
  }
  /// Waits until the others have what is `awaited`: asking MPI may take long on a busy machine.
  template <class Awaited>
  void await_sent(const Awaited& awaited) {
    const auto until = std::chrono::steady_clock::now() + patience_;
    drop_sent();
    while (std::any_of(sent_.begin(), sent_.end(), awaited) && std::chrono::steady_clock::now() < until) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      drop_sent();
    }
  }
  void drop_sent() {
    sent_.remove_if([](pending& one) { return one.request.test().has_value(); });
  }
  void require_all() const {
    if (!reason_.empty())
      throw communication_error(reason_);
  }

  boost::mpi::communicator world_;
  std::size_t chunk_bytes_;
  std::chrono::milliseconds patience_;
  bool has_abandoned_ = false;
  std::list<pending> sent_;
  std::optional<incoming> coming_;
  std::optional<incoming> farewell_;
  std::map<int, byte_buffer> incomplete_; ///< by sender
  std::string reason_;                    ///< why there is nobody to go on with
};
static_assert(communicator<mpi>);

} // namespace dovetail::parallel
