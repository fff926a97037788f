/// @file
/// Errors of a task that no other attempt mends: they travel from the worker in place of its result, and are
/// thrown again by the process that started it.
#pragma once

#include "dovetail/core/bytes.hpp"
#include "dovetail/core/error.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

namespace dovetail::detail {

enum class reply_kind : std::uint8_t { result, cannot_store, bad_size, bad_use };

/// What kind a reply is stands behind its bytes, so that those of a result are not moved.
inline byte_buffer marked(byte_buffer bytes, reply_kind kind) {
  bytes.push_back(static_cast<std::byte>(kind));
  return bytes;
}
inline byte_buffer marked(const std::string& text, reply_kind kind) {
  const auto* first = reinterpret_cast<const std::byte*>(text.data());
  return marked(byte_buffer(first, first + text.size()), kind);
}

/// In a worker: what `work()` returns, or its `io_error`, `sizing_error` or `usage_error`. Others are the
/// task's failure.
template <class Work>
byte_buffer with_final_errors(const Work& work) {
  try {
    return marked(work(), reply_kind::result);
  } catch (const io_error& e) {
    return marked(e.what(), reply_kind::cannot_store);
  } catch (const sizing_error& e) {
    return marked(e.what(), reply_kind::bad_size);
  } catch (const usage_error& e) {
    return marked(e.what(), reply_kind::bad_use);
  }
}

/// What the work returned; throws what it threw.
inline byte_buffer without_final_errors(byte_buffer reply) {
  const auto kind = static_cast<reply_kind>(reply.back());
  reply.pop_back();
  const auto text = [&] { return std::string(reinterpret_cast<const char*>(reply.data()), reply.size()); };
  if (kind == reply_kind::cannot_store)
    throw io_error(text());
  if (kind == reply_kind::bad_size)
    throw sizing_error(text());
  if (kind == reply_kind::bad_use)
    throw usage_error(text());
  return reply;
}

} // namespace dovetail::detail
