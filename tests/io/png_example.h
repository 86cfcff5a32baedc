// PNG files as other programs write them.
#pragma once

#include <png.h>

#include <string>
#include <vector>

namespace clearway {

struct PngKind {
  int bits = 16;
  int color_type = PNG_COLOR_TYPE_GRAY;
  bool interlaced = false;
};

// Of one value per pixel and channel, row by row.
inline std::string PngBytes(unsigned width, unsigned height, const std::vector<int>& values,
                            const PngKind& kind = {}) {
  std::string bytes;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(
      png, &bytes,
      [](png_structp p, png_bytep data, std::size_t count) {
        static_cast<std::string*>(png_get_io_ptr(p))->append(reinterpret_cast<char*>(data), count);
      },
      [](png_structp) {});
  png_set_IHDR(png, info, width, height, kind.bits, kind.color_type,
               kind.interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  const std::vector<png_color> palette(1 << std::min(kind.bits, 8), png_color{7, 7, 7});
  if (kind.color_type == PNG_COLOR_TYPE_PALETTE) {
    png_set_PLTE(png, info, palette.data(), static_cast<int>(palette.size()));
  }
  png_write_info(png, info);
  png_set_packing(png);
  std::vector<png_byte> stored;
  for (const int value : values) {
    if (kind.bits == 16) stored.push_back(static_cast<png_byte>(value >> 8));
    stored.push_back(static_cast<png_byte>(value));
  }
  std::vector<png_bytep> rows;
  for (unsigned y = 0; y < height; ++y) {
    rows.push_back(stored.data() + y * (stored.size() / height));
  }
  png_write_image(png, rows.data());
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return bytes;
}

}  // namespace clearway
