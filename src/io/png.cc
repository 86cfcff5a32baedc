#include "io/png.h"

#include <png.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <string>
#include <string_view>

#include "absl/strings/str_cat.h"
#include "clearway/base/file.h"

namespace clearway {
namespace {

constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 27;
constexpr std::uint64_t kMaxPixels = 20'000'000;
constexpr png_uint_32 kMaxSide = 65'535;
constexpr png_alloc_size_t kMaxChunkBytes = 1 << 20;  // of text and the like

// What libpng's callbacks see. No callback holds anything that a jump out of it would leak.
struct Source {
  std::string_view bytes;
  std::size_t at = 0;
  std::array<char, 128> error = {};
};

[[noreturn]] void OnError(png_structp png, png_const_charp message) {
  auto* const source = static_cast<Source*>(png_get_error_ptr(png));
  std::snprintf(source->error.data(), source->error.size(), "%s", message);
  png_longjmp(png, 1);
}

void OnWarning(png_structp, png_const_charp) {}

void OnRead(png_structp png, png_bytep out, std::size_t count) {
  auto* const source = static_cast<Source*>(png_get_io_ptr(png));
  if (count > source->bytes.size() - source->at) png_error(png, "the file is cut off");
  std::memcpy(out, source->bytes.data() + source->at, count);
  source->at += count;
}

// libpng's two structs. Errors of libpng jump to the functions that say setjmp, which therefore
// keep no objects.
class Decoder {
 public:
  explicit Decoder(std::string_view bytes) : source_{.bytes = bytes} {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, &source_, OnError, OnWarning);
    if (png_ != nullptr) info_ = png_create_info_struct(png_);
  }
  ~Decoder() { png_destroy_read_struct(&png_, &info_, nullptr); }
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;

  // Each is true if it succeeds; else error() says why.
  bool ReadHeader() {
    if (info_ == nullptr) return false;
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_set_read_fn(png_, &source_, OnRead);
    png_set_user_limits(png_, kMaxSide, kMaxSide);
    png_set_chunk_malloc_max(png_, kMaxChunkBytes);
    png_read_info(png_, info_);
    return true;
  }
  // A byte a pixel, or two.
  bool PrepareRows() {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_set_packing(png_);
    png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    return true;
  }
  bool ReadRows(png_bytepp rows) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_read_image(png_, rows);
    png_read_end(png_, nullptr);
    return true;
  }

  const char* error() const { return source_.error[0] == 0 ? "no memory" : source_.error.data(); }
  std::uint32_t width() const { return png_get_image_width(png_, info_); }
  std::uint32_t height() const { return png_get_image_height(png_, info_); }
  int bits() const { return png_get_bit_depth(png_, info_); }
  int color_type() const { return png_get_color_type(png_, info_); }
  std::size_t row_bytes() const { return png_get_rowbytes(png_, info_); }

 private:
  Source source_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
};

std::string KindOf(int color_type) {
  if (color_type == PNG_COLOR_TYPE_GRAY_ALPHA) return "grey with alpha";
  return color_type == PNG_COLOR_TYPE_RGB_ALPHA ? "colours with alpha" : "colours";
}

// An empty text if it can be read.
std::string WhyNot(const Decoder& png) {
  const int kind = png.color_type();
  if (kind != PNG_COLOR_TYPE_GRAY && kind != PNG_COLOR_TYPE_PALETTE) {
    return absl::StrCat("an image of ", KindOf(kind), ", expected a grey one or one of a palette");
  }
  const std::uint64_t pixels = std::uint64_t{png.width()} * png.height();
  if (pixels > kMaxPixels) {
    return absl::StrCat(png.width(), " x ", png.height(), " pixels; the limit is ", kMaxPixels);
  }
  return "";
}

}  // namespace

absl::StatusOr<GrayImage> ReadGrayPng(const std::filesystem::path& path) {
  const absl::StatusOr<std::string> bytes = ReadWholeFile(path, kMaxBytes);
  if (!bytes.ok()) return bytes.status();
  const auto fail = [&](const std::string& why) {
    return absl::InvalidArgumentError(absl::StrCat(path.string(), ": ", why));
  };
  Decoder png(*bytes);
  if (!png.ReadHeader()) return fail(absl::StrCat("no PNG image: ", png.error()));
  if (const std::string why = WhyNot(png); !why.empty()) return fail(why);
  GrayImage image{png.width(), png.height(), png.bits(), {}};
  if (!png.PrepareRows()) return fail(absl::StrCat("damaged: ", png.error()));
  std::vector<png_byte> stored(png.row_bytes() * image.height);
  std::vector<png_bytep> rows(image.height);
  for (std::size_t y = 0; y < rows.size(); ++y) rows[y] = stored.data() + y * png.row_bytes();
  if (!png.ReadRows(rows.data())) return fail(absl::StrCat("damaged: ", png.error()));
  image.pixels.resize(std::size_t{image.width} * image.height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    image.pixels[i] = image.bits == 16 ? stored[2 * i] << 8 | stored[2 * i + 1] : stored[i];
  }
  return image;
}

}  // namespace clearway
