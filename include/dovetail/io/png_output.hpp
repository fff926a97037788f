/// @file
/// Pictures as PNG files: 8-bit RGB, no interlacing.
#pragma once

#include "dovetail/core/output_file.hpp"
#include "dovetail/io/deflate.hpp"
#include "dovetail/io/raster_image.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace dovetail::io {

namespace detail {

/// The checksum of a PNG chunk (CRC-32), bit by bit.
inline std::uint32_t crc32(std::span<const std::uint8_t> data) {
  std::uint32_t crc = 0xffffffff;
  for (const std::uint8_t byte : data) {
    crc ^= byte;
    for (int k = 0; k < 8; ++k)
      crc = (crc & 1U) != 0 ? crc >> 1 ^ 0xedb88320U : crc >> 1;
  }
  return ~crc;
}

inline void put_big_endian(std::vector<std::uint8_t>& out, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8)
    out.push_back(static_cast<std::uint8_t>(value >> shift & 255U));
}

inline void put_chunk(std::vector<std::uint8_t>& out, std::string_view kind,
                      std::span<const std::uint8_t> content) {
  put_big_endian(out, static_cast<std::uint32_t>(content.size()));
  const std::size_t begin = out.size();
  out.insert(out.end(), kind.begin(), kind.end());
  out.insert(out.end(), content.begin(), content.end());
  put_big_endian(out, crc32(std::span(out).subspan(begin)));
}

/// The rows of a picture, each as differences to the left, to the row above, or as it is: whichever has the
/// smallest sum of differences, which tends to compress best.
inline std::vector<std::uint8_t> filtered_rows(const raster_image& image) {
  const std::size_t length = 3 * static_cast<std::size_t>(image.width());
  std::vector<std::uint8_t> above(length, 0);
  std::vector<std::uint8_t> row(length);
  std::array<std::vector<std::uint8_t>, 3> filtered; // PNG's filters 0, 1 and 2
  std::vector<std::uint8_t> all;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const rgb pixel = image.at(x, y);
      const auto at = 3 * static_cast<std::size_t>(x);
      row[at] = pixel.red;
      row[at + 1] = pixel.green;
      row[at + 2] = pixel.blue;
    }
    filtered.fill(row);
    for (std::size_t k = 0; k < length; ++k) {
      filtered[1][k] = static_cast<std::uint8_t>(row[k] - (k < 3 ? 0 : row[k - 3]));
      filtered[2][k] = static_cast<std::uint8_t>(row[k] - above[k]);
    }
    std::array<std::int64_t, 3> sums{};
    for (std::size_t filter = 0; filter < 3; ++filter)
      for (const std::uint8_t difference : filtered[filter])
        sums[filter] += std::abs(static_cast<int>(static_cast<std::int8_t>(difference)));
    const auto best = static_cast<std::size_t>(std::min_element(sums.begin(), sums.end()) - sums.begin());
    all.push_back(static_cast<std::uint8_t>(best));
    all.insert(all.end(), filtered[best].begin(), filtered[best].end());
    std::swap(above, row);
  }
  return all;
}

} // namespace detail

/// The bytes of a PNG file.
inline std::vector<std::uint8_t> encode_png(const raster_image& image) {
  std::vector<std::uint8_t> file{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  std::vector<std::uint8_t> header;
  detail::put_big_endian(header, static_cast<std::uint32_t>(image.width()));
  detail::put_big_endian(header, static_cast<std::uint32_t>(image.height()));
  header.insert(header.end(), {8, 2, 0, 0, 0}); // 8 bits, RGB, deflate, adaptive filters, no interlacing
  detail::put_chunk(file, "IHDR", header);
  detail::put_chunk(file, "IDAT", deflate_zlib(detail::filtered_rows(image)));
  detail::put_chunk(file, "IEND", {});
  return file;
}

/// Writes a PNG file; throws `io_error` naming it. Nothing half-written is left under its name.
inline void write_png(const raster_image& image, const std::filesystem::path& path) {
  const auto content = encode_png(image);
  output_file file(path);
  file.bytes(content.data(), content.size());
  file.commit();
}

} // namespace dovetail::io
