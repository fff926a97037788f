/// @file
/// What `error_codec.hpp` declares.
#pragma once

#include "dovetail/core/bytes.hpp"
#include "dovetail/core/error.hpp"
#include "dovetail/core/linkage.hpp"
#include "dovetail/geometry/error_of_faces.hpp"
#include "dovetail/parallel/error_codec.hpp"

#include <cstdint>
#include <exception>
#include <new>
#include <string>
#include <tuple>
#include <vector>

namespace dovetail::detail {

/// Derived ones before their bases. A new error of the library is one more entry.
using known_errors =
    std::tuple<input_error, geometry_error, sizing_error, intersection_error, partition_error,
               time_limit_error, mesher_error, mesh_error, io_error, usage_error, communication_error>;

inline constexpr std::uint8_t other_error = 200;
inline constexpr std::uint8_t no_memory = 201;
inline constexpr std::uint8_t stopped = 202;

template <std::size_t K = 0>
std::uint8_t kind_of_error(const std::exception& problem) {
  if constexpr (K == std::tuple_size_v<known_errors>)
    return other_error;
  else
    return dynamic_cast<const std::tuple_element_t<K, known_errors>*>(&problem) != nullptr
               ? static_cast<std::uint8_t>(K)
               : kind_of_error<K + 1>(problem);
}

/// `faces`: those to blame, if any.
template <std::size_t K = 0>
[[noreturn]] void throw_kind(std::uint8_t kind, const std::string& text, const std::vector<local_id>& faces) {
  if constexpr (K == std::tuple_size_v<known_errors>) {
    throw error(text);
  } else {
    using known = std::tuple_element_t<K, known_errors>;
    if (kind == K && !faces.empty())
      throw error_of_faces<known>(text, faces);
    if (kind == K)
      throw known(text);
    throw_kind<K + 1>(kind, text, faces);
  }
}

} // namespace dovetail::detail

namespace dovetail {

DOVETAIL_INLINE byte_buffer encode_error(const std::exception_ptr& failure) {
  const auto encoded = [](std::uint8_t kind, const std::string& text,
                          const std::vector<local_id>& faces = {}) {
    byte_writer to;
    to.value(kind);
    to.text(text);
    to.array(faces);
    return to.take();
  };
  try {
    std::rethrow_exception(failure);
  } catch (const cancelled& problem) {
    return encoded(detail::stopped, problem.what());
  } catch (const std::bad_alloc& problem) {
    return encoded(detail::no_memory, problem.what());
  } catch (const std::exception& problem) {
    const auto* blamed = dynamic_cast<const blames_faces*>(&problem);
    return encoded(detail::kind_of_error(problem), problem.what(),
                   blamed ? blamed->faces() : std::vector<local_id>{});
  } catch (...) {
    return encoded(detail::other_error, "an exception that is not a std::exception");
  }
}

DOVETAIL_INLINE void throw_error(const byte_buffer& encoded) {
  byte_reader from(encoded);
  const auto kind = from.value<std::uint8_t>();
  const std::string text = from.text();
  const auto faces = from.array<local_id>();
  if (kind == detail::stopped)
    throw cancelled();
  if (kind == detail::no_memory)
    throw std::bad_alloc();
  detail::throw_kind(kind, text, faces);
}

} // namespace dovetail
