#include "png.hpp"

#include "support/jittered_meshes.hpp"

#include <doctest/doctest.h>
#include <png.h>

#include <vector>

namespace dovetail::app {
namespace {

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
  const auto file = encode_png(image);
  png_image head{};
  head.version = PNG_IMAGE_VERSION;
  REQUIRE(png_image_begin_read_from_memory(&head, file.data(), file.size()) != 0);
  CHECK(head.format == PNG_FORMAT_RGB);
  REQUIRE(head.width == 61);
  REQUIRE(head.height == 43);
  std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(head));
  REQUIRE(png_image_finish_read(&head, nullptr, pixels.data(), 0, nullptr) != 0);
  for (int y = 0; y < 43; ++y)
    for (int x = 0; x < 61; ++x) {
      const auto* p = &pixels[3 * static_cast<std::size_t>(61 * y + x)];
      REQUIRE(image.at(x, y) == rgb{p[0], p[1], p[2]});
    }
}

TEST_CASE("a picture of one colour is a small file") {
  CHECK(encode_png(raster_image(1000, 1000)).size() < 10'000);
}

} // namespace
} // namespace dovetail::app
