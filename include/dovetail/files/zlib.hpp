/// @file
/// Adapter: compressed arrays of VTK files, with zlib.
#pragma once

#include "dovetail/core/error.hpp"

#include <zlib.h>

#include <cstdint>
#include <span>

namespace dovetail::io {

/// Expands a zlib stream that gives exactly as many bytes as there is room for; what a `vtk_expander` is.
/// Throws `input_error` (without a file name) when the stream is damaged or gives another number of bytes.
inline void zlib_expand(std::span<const std::uint8_t> data, std::span<std::uint8_t> out) {
  auto size = static_cast<uLongf>(out.size());
  std::uint8_t nothing = 0; // zlib wants an address of no bytes too
  const int status =
      uncompress(out.empty() ? &nothing : out.data(), &size, data.data(), static_cast<uLong>(data.size()));
  if (status == Z_MEM_ERROR)
    throw input_error("compressed data need more memory than there is");
  if (status != Z_OK || size != out.size())
    throw input_error("compressed data are damaged, cut off, or of another size than announced");
}

} // namespace dovetail::io
