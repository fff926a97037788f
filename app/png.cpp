#include "png.hpp"

#include <png.h>

namespace dovetail::app {

static_assert(sizeof(rgb) == 3, "pixels are handed over as bytes");

std::vector<std::uint8_t> encode_png(const raster_image& image) {
  png_image head{};
  head.version = PNG_IMAGE_VERSION;
  head.width = static_cast<png_uint_32>(image.width());
  head.height = static_cast<png_uint_32>(image.height());
  head.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(head);
  std::vector<std::uint8_t> file(size);
  if (png_image_write_to_memory(&head, file.data(), &size, 0, image.data(), 0, nullptr) == 0)
    throw io_error(std::string("a picture cannot be made a PNG file: ") + head.message);
  file.resize(size);
  return file;
}

} // namespace dovetail::app
