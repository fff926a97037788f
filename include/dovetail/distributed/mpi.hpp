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
  explicit mpi(const boost::mpi::communicator& world = {}, std::size_t chunk_bytes = std::size_t{1} << 28)
      : world_(world, boost::mpi::comm_duplicate), chunk_bytes_(std::max(chunk_bytes, sizeof(header))) {}

  mpi(mpi&&) = default;
  mpi& operator=(mpi&&) = default;
  ~mpi() {
    if (reason_.empty())
      finish_sending();
    if (!sent_.empty())                         // nobody receives them; MPI still has the bytes
      new std::list<pending>(std::move(sent_)); // NOLINT
    if (coming_ && !has_come())
      new incoming(*std::move(coming_)); // NOLINT
  }

  int rank() const { return world_.rank(); }
  int size() const { return world_.size(); }
  void send(int to, std::int32_t tag, const byte_buffer& bytes) {
    require_all();
    post(to, tag, bytes);
    drop_sent();
  }

  std::optional<rank_message> receive() {
    require_all();
    drop_sent();
    while (is_coming() && comes_soon()) {
      const int from = coming_->from;
      const byte_buffer chunk = std::move(coming_->chunk);
      coming_.reset();
      header head;
      std::memcpy(&head, chunk.data(), sizeof head);
      byte_buffer& bytes = incomplete_[from];
      bytes.insert(bytes.end(), chunk.begin() + sizeof head, chunk.end());
      if (bytes.size() < head.size)
        continue;
      rank_message whole{from, head.tag, std::exchange(bytes, {})};
      if (whole.tag != abandoned)
        return whole;
      reason_ = "rank " + std::to_string(from) + ": " + byte_reader(whole.bytes).text();
      require_all();
    }
    return std::nullopt;
  }

  void wait(std::chrono::milliseconds at_most) {
    using clock = std::chrono::steady_clock;
    const auto end = clock::now() + at_most;
    auto pause = std::chrono::microseconds(20);
    while (clock::now() < end && !(is_coming() && has_come())) {
      require_all();
      drop_sent();
      std::this_thread::sleep_for(pause);
      pause = std::min(2 * pause, std::chrono::microseconds(1000));
    }
  }
  int descriptor() const { return -1; }
  bool shares_process() const { return false; }

  /// Tells the others, and waits until they were told, at most two seconds.
  void abandon(const std::string& reason) {
    byte_writer text;
    text.text(reason);
    const byte_buffer bytes = text.take();
    for (int r = 0; r < size(); ++r)
      if (r != rank())
        post(r, abandoned, bytes);
    finish_sending();
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
  };
  /// A chunk on its way. Who waited for it would never return when its sender dies before it has all.
  struct incoming {
    int from;
    byte_buffer chunk;
    boost::mpi::request request;
    bool has_come = false;
  };
  static constexpr int mpi_tag = 1;
  static constexpr std::int32_t abandoned = -1;

  bool is_coming() {
    if (coming_)
      return true;
    const auto found = world_.iprobe(boost::mpi::any_source, mpi_tag);
    if (!found)
      return false;
    coming_.emplace(incoming{
        found->source(), byte_buffer(static_cast<std::size_t>(found->count<char>().value_or(0))), {}});
    coming_->request = world_.irecv(coming_->from, mpi_tag, reinterpret_cast<char*>(coming_->chunk.data()),
                                    static_cast<int>(coming_->chunk.size()));
    return true;
  }
  bool has_come() {
    coming_->has_come = coming_->has_come || coming_->request.test().has_value();
    return coming_->has_come;
  }
  /// A long chunk moves only while MPI is asked about it.
  bool comes_soon() {
    const auto until = std::chrono::steady_clock::now() + std::chrono::milliseconds(2);
    while (!has_come() && std::chrono::steady_clock::now() < until)
      std::this_thread::yield();
    return coming_->has_come;
  }

  void post(int to, std::int32_t tag, const byte_buffer& bytes) {
    std::size_t at = 0;
    do {
      const std::size_t part = std::min(bytes.size() - at, chunk_bytes_);
      const header head{tag, bytes.size()};
      pending& next = sent_.emplace_back();
      next.bytes.resize(sizeof head + part);
      std::memcpy(next.bytes.data(), &head, sizeof head);
      if (part > 0)
        std::memcpy(next.bytes.data() + sizeof head, bytes.data() + at, part);
      next.request = world_.isend(to, mpi_tag, reinterpret_cast<const char*>(next.bytes.data()),
                                  static_cast<int>(next.bytes.size()));
      at += part;
    } while (at < bytes.size());
  }
  /// Waits until the others have what was sent, at most two seconds: asking MPI may take long on a busy
  /// machine.
  void finish_sending() {
    const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(2);
    drop_sent();
    while (!sent_.empty() && std::chrono::steady_clock::now() < until) {
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
  std::list<pending> sent_;
  std::optional<incoming> coming_;
  std::map<int, byte_buffer> incomplete_; ///< by sender
  std::string reason_;                    ///< why there is nobody to go on with
};
static_assert(communicator<mpi>);

} // namespace dovetail::parallel
