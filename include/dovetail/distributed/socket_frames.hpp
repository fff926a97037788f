/// @file
/// Messages of a communicator over a socket between two processes of one machine. Linux.
#pragma once

#include "dovetail/core/error.hpp"
#include "dovetail/parallel/communicator.hpp"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <deque>
#include <optional>
#include <utility>

#include <sys/socket.h>

namespace dovetail::detail {

/// One end of a stream socket. Nothing blocks: what the other end does not take yet waits here.
class socket_frames {
public:
  explicit socket_frames(int socket) : socket_(socket) {}
  int socket() const { return socket_; }

  void send(int peer, std::int32_t tag, byte_buffer bytes) {
    const header head{peer, tag, bytes.size()};
    byte_buffer first(sizeof head);
    std::memcpy(first.data(), &head, sizeof head);
    out_.push_back(std::move(first));
    if (!bytes.empty())
      out_.push_back(std::move(bytes));
    flush();
  }
  /// Sends what can be sent now. Returns whether nothing is left.
  bool flush() {
    while (!out_.empty() && !closed_) {
      const byte_buffer& next = out_.front();
      const ssize_t sent =
          ::send(socket_, next.data() + sent_, next.size() - sent_, MSG_NOSIGNAL | MSG_DONTWAIT);
      if (sent < 0 && errno == EINTR)
        continue;
      if (sent < 0 && (errno == EAGAIN || errno == EWOULDBLOCK))
        return false;
      if (sent < 0)
        closed_ = true;
      sent_ += sent > 0 ? static_cast<std::size_t>(sent) : 0;
      if (sent_ == next.size()) {
        out_.pop_front();
        sent_ = 0;
      }
    }
    return true;
  }

  /// The next message that has come completely.
  std::optional<rank_message> receive() {
    while (!closed_) {
      if (got_ < sizeof head_) {
        if (!read(reinterpret_cast<std::byte*>(&head_) + got_, sizeof head_ - got_))
          return std::nullopt;
        if (got_ == sizeof head_)
          bytes_.resize(static_cast<std::size_t>(head_.size));
      }
      if (got_ < sizeof head_)
        continue;
      const std::size_t at = got_ - sizeof head_;
      if (at < bytes_.size() && !read(bytes_.data() + at, bytes_.size() - at))
        return std::nullopt;
      if (got_ - sizeof head_ < bytes_.size())
        continue;
      got_ = 0;
      return rank_message{head_.peer, head_.tag, std::exchange(bytes_, {})};
    }
    return std::nullopt;
  }

  /// Whether the other end is gone.
  bool closed() const { return closed_; }

private:
  struct header {
    std::int32_t peer;
    std::int32_t tag;
    std::uint64_t size;
  };

  /// False when nothing is there.
  bool read(std::byte* to, std::size_t size) {
    ssize_t got = 0;
    do
      got = ::recv(socket_, to, size, MSG_DONTWAIT);
    while (got < 0 && errno == EINTR);
    if (got < 0 && (errno == EAGAIN || errno == EWOULDBLOCK))
      return false;
    closed_ = got <= 0;
    got_ += closed_ ? 0 : static_cast<std::size_t>(got);
    return !closed_;
  }

  int socket_;
  std::deque<byte_buffer> out_;
  std::size_t sent_ = 0; ///< of the first of them
  header head_{};
  byte_buffer bytes_;
  std::size_t got_ = 0; ///< of the header and the bytes
  bool closed_ = false;
};

} // namespace dovetail::detail
