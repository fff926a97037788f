#include "dovetail/io/png_output.hpp"

#include "support/jittered_meshes.hpp"

#include <doctest/doctest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace dovetail::io {
namespace {

std::vector<std::uint8_t> round_trip(const std::vector<std::uint8_t>& data) {
  return inflate_zlib(deflate_zlib(data), data.size());
}

std::uint32_t big_endian(const std::vector<std::uint8_t>& bytes, std::size_t at) {
  return static_cast<std::uint32_t>(bytes[at]) << 24 | static_cast<std::uint32_t>(bytes[at + 1]) << 16 |
         static_cast<std::uint32_t>(bytes[at + 2]) << 8 | bytes[at + 3];
}

/// A decoder of what the encoder may write: one IDAT chunk, filters 0 to 2.
raster_image decoded(const std::vector<std::uint8_t>& file) {
  REQUIRE(file.size() > 57);
  REQUIRE(std::string(file.begin() + 1, file.begin() + 4) == "PNG");
  REQUIRE(std::string(file.begin() + 12, file.begin() + 16) == "IHDR");
  const auto width = static_cast<int>(big_endian(file, 16));
  const auto height = static_cast<int>(big_endian(file, 20));
  REQUIRE(std::string(file.begin() + 37, file.begin() + 41) == "IDAT");
  const std::size_t length = big_endian(file, 33);
  const std::size_t row = 3 * static_cast<std::size_t>(width);
  auto bytes =
      inflate_zlib(std::span(file).subspan(41, length), (row + 1) * static_cast<std::size_t>(height));
  raster_image image(width, height);
  for (int y = 0; y < height; ++y) {
    const std::size_t begin = (row + 1) * static_cast<std::size_t>(y);
    const auto filter = bytes[begin];
    REQUIRE(filter <= 2);
    for (std::size_t k = 1; k <= row; ++k) {
      if (filter == 1 && k > 3)
        bytes[begin + k] = static_cast<std::uint8_t>(bytes[begin + k] + bytes[begin + k - 3]);
      if (filter == 2 && y > 0)
        bytes[begin + k] = static_cast<std::uint8_t>(bytes[begin + k] + bytes[begin + k - row - 1]);
    }
    for (int x = 0; x < width; ++x) {
      const std::size_t at = begin + 1 + 3 * static_cast<std::size_t>(x);
      image.at(x, y) = {bytes[at], bytes[at + 1], bytes[at + 2]};
    }
  }
  return image;
}

TEST_CASE("compressed bytes expand to what they were") {
  dovetail_test::random_numbers random(7);
  CHECK(round_trip({}).empty());
  for (const std::size_t size : {1U, 2U, 3U, 4U, 257U, 258U, 259U, 262U, 40000U, 100000U}) {
    std::vector<std::uint8_t> flat(size, 200);
    CHECK(round_trip(flat) == flat);
    std::vector<std::uint8_t> noise(size);
    for (auto& byte : noise)
      byte = static_cast<std::uint8_t>(random.bits());
    CHECK(round_trip(noise) == noise);
  }
}

TEST_CASE("every length and every class of distances of repetitions is coded right") {
  dovetail_test::random_numbers random(11);
  for (std::size_t length = 3; length <= 270; ++length) {
    std::vector<std::uint8_t> data(length);
    for (auto& byte : data)
      byte = static_cast<std::uint8_t>(random.bits());
    const std::size_t gap = std::size_t{1} << (length % 16);
    const std::vector<std::uint8_t> first = data;
    for (std::size_t k = 0; k < gap; ++k)
      data.push_back(static_cast<std::uint8_t>(random.bits()));
    data.insert(data.end(), first.begin(), first.end());
    REQUIRE(round_trip(data) == data);
  }
}

TEST_CASE("repeated bytes become short") {
  const std::vector<std::uint8_t> flat(100000, 17);
  CHECK(deflate_zlib(flat).size() < 1000);
  std::vector<std::uint8_t> periodic;
  for (int k = 0; k < 100000; ++k)
    periodic.push_back(static_cast<std::uint8_t>(k % 200));
  CHECK(deflate_zlib(periodic).size() < 2000);
}

TEST_CASE("a PNG file has the picture's pixels") {
  dovetail_test::random_numbers random(3);
  raster_image image(61, 43, {10, 200, 30});
  for (int y = 5; y < 20; ++y)
    for (int x = 7; x < 50; ++x)
      image.at(x, y) = {static_cast<std::uint8_t>(x), static_cast<std::uint8_t>(3 * y), 77};
  for (int y = 25; y < 30; ++y)
    for (int x = 0; x < 61; ++x)
      image.at(x, y) = {static_cast<std::uint8_t>(random.bits()), static_cast<std::uint8_t>(random.bits()),
                        static_cast<std::uint8_t>(random.bits())};
  const raster_image back = decoded(encode_png(image));
  REQUIRE(back.width() == 61);
  REQUIRE(back.height() == 43);
  for (int y = 0; y < 43; ++y)
    for (int x = 0; x < 61; ++x)
      REQUIRE(back.at(x, y) == image.at(x, y));
}

TEST_CASE("the checksum is PNG's") {
  const std::string text = "IEND";
  CHECK(detail::crc32(std::vector<std::uint8_t>(text.begin(), text.end())) == 0xae426082);
}

TEST_CASE("a file is written under its name only when it is complete") {
  const auto path = std::filesystem::temp_directory_path() / "dovetail_test_png_output.png";
  write_png(raster_image(4, 3), path);
  std::ifstream file(path, std::ios::binary);
  const std::vector<std::uint8_t> bytes((std::istreambuf_iterator<char>(file)), {});
  CHECK(bytes == encode_png(raster_image(4, 3)));
  std::filesystem::remove(path);
  CHECK_THROWS_AS(write_png(raster_image(4, 3), path / "no_folder" / "a.png"), io_error);
}

} // namespace
} // namespace dovetail::io
