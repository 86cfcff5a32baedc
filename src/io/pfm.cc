#include "io/pfm.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <string>
#include <string_view>

#include "absl/strings/str_cat.h"
#include "clearway/base/file.h"
#include "clearway/base/number_text.h"
#include "clearway/base/parse_number.h"

namespace clearway {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::uint64_t kMaxPixels = 20'000'000;

// Takes a word and the one blank behind it.
std::string_view TakeHeaderWord(std::string_view& rest) {
  constexpr std::string_view kBlank = " \t\r\n";
  rest.remove_prefix(std::min(rest.find_first_not_of(kBlank), rest.size()));
  const std::string_view word =
      rest.substr(0, std::min<std::size_t>(rest.find_first_of(kBlank), 20));
  rest.remove_prefix(std::min(word.size() + 1, rest.size()));
  return word;
}

}  // namespace

absl::StatusOr<FloatImage> ReadPfm(const std::filesystem::path& path) {
  const auto bytes = ReadWholeFile(path, sizeof(float) * kMaxPixels + 100);
  if (!bytes.ok()) return bytes.status();
  const auto fail = [&](const std::string& why) {
    return absl::InvalidArgumentError(absl::StrCat(path.string(), ": ", why));
  };
  std::string_view rest = *bytes;
  const std::string_view kind = TakeHeaderWord(rest);
  if (kind == "PF") return fail("a colour image; depth images are grey (Pf)");
  if (kind != "Pf") return fail("not a PFM file (it does not begin with Pf)");
  FloatImage image;
  double scale = 0;
  if (!ParseWhole(TakeHeaderWord(rest), image.width) ||
      !ParseWhole(TakeHeaderWord(rest), image.height) || !ParseWhole(TakeHeaderWord(rest), scale)) {
    return fail("no width, height and scale behind Pf");
  }
  if (scale != 1 && scale != -1) {
    return fail(absl::StrCat("a scale of ", NumberText(scale), "; expected 1 or -1 (metres)"));
  }
  const std::uint64_t row_bytes = sizeof(float) * std::uint64_t{image.width};
  const std::uint64_t expected = row_bytes * image.height;
  if (image.height != 0 && expected / image.height != row_bytes) return fail("too many pixels");
  if (rest.size() != expected) {
    return fail(absl::StrCat(rest.size(), " bytes of pixels; ", image.width, " x ", image.height,
                             " pixels need ", expected));
  }
  image.pixels.resize(expected / sizeof(float));
  for (std::uint32_t row = 0; row < image.height; ++row) {
    // Rows go from the bottom to the top.
    std::memcpy(image.pixels.data() + std::size_t{row} * image.width,
                rest.data() + (image.height - 1 - row) * row_bytes, row_bytes);
  }
  if (scale < 0) return image;  // little endian
  for (float& pixel : image.pixels) {
    auto* const begin = reinterpret_cast<char*>(&pixel);
    std::reverse(begin, begin + sizeof pixel);
  }
  return image;
}

}  // namespace clearway
