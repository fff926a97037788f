/// @file
/// Errors as bytes, so that one rank's error is thrown on all ranks with its type.
#pragma once

#include "dovetail/core/bytes.hpp"

#include <exception>

namespace dovetail {

/// An error in flight; what is none of the library's types loses its own.
byte_buffer encode_error(const std::exception_ptr& failure);

/// Throws what was encoded.
[[noreturn]] void throw_error(const byte_buffer& encoded);

} // namespace dovetail

#ifndef DOVETAIL_COMPILED
#include "dovetail/parallel/error_codec.ipp"
#endif
