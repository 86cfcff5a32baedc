#include "io/ply_header.h"

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "clearway/base/parse_number.h"
#include "io/text_lines.h"

namespace clearway {
namespace {

using Words = std::vector<std::string_view>;

constexpr std::size_t kMaxWords = 5;               // of a line: "property list uchar int corners"
constexpr int kMaxElementsAndProperties = 10'000;  // elements are looked up one by one

class HeaderParser {
 public:
  HeaderParser(PlyReader& reader, PlyContent content) : reader_(reader), content_(content) {}

  PlyHeader Parse() {
    TakeFirstLine();
    while (reader_.NextLine()) {
      const Words words = reader_.TakeWords();
      if (!words.empty() && words[0] == "end_header") return End();
      TakeLine(words);
    }
    reader_.FailCutOff("the header does not end");
    return std::move(header_);
  }

 private:
  void TakeFirstLine() {
    if (reader_.rest().empty()) {
      reader_.FailWhole("the file is empty");
    } else if (!reader_.NextLine()) {
      reader_.FailCutOff("its first line does not end");
    } else if (reader_.TakeWords() != Words{"ply"}) {
      reader_.Fail("no PLY file: it does not begin with 'ply'");
    }
  }

  void TakeLine(const Words& words) {
    const std::string_view key = words.empty() ? std::string_view() : words[0];
    if (key == "comment" || key == "obj_info") return;
    if (key == "format") return TakeFormat(words);
    if (++lines_ > kMaxElementsAndProperties) {
      return reader_.FailExhausted(absl::StrCat(
          "the header has more than ", kMaxElementsAndProperties, " elements and properties"));
    }
    if (key == "element") return TakeElement(words);
    if (key == "property") return TakeProperty(words);
    reader_.Fail(absl::StrCat("'", PlyExcerpt(key), "' in the header"));
  }

  void TakeFormat(const Words& words) {
    if (has_format_) return reader_.Fail("a second format");
    constexpr std::pair<std::string_view, PlyFormat> kFormats[] = {
        {"ascii", PlyFormat::kAscii},
        {"binary_little_endian", PlyFormat::kLittleEndian},
        {"binary_big_endian", PlyFormat::kBigEndian}};
    for (const auto& [name, format] : kFormats) {
      if (words.size() != 3 || words[1] != name || words[2] != "1.0") continue;
      header_.format = format;
      has_format_ = true;
    }
    if (has_format_) return;
    reader_.Fail(absl::StrCat("format ", Second(words),
                              "; ascii, binary_little_endian and binary_big_endian 1.0 are read"));
  }

  void TakeElement(const Words& words) {
    const bool is_first = header_.elements.empty();
    if (content_ == PlyContent::kVertices &&
        (words.size() != 3 || words[1] != "vertex" || !is_first)) {
      return reader_.Fail(absl::StrCat("expected one element, vertex, not '", Second(words), "'"));
    }
    if (words.size() != 3) return reader_.Fail("expected 'element', its name and its number");
    if (std::ranges::find(header_.elements, words[1], &PlyElement::name) !=
        header_.elements.end()) {
      return reader_.Fail(absl::StrCat("a second element '", Second(words), "'"));
    }
    PlyElement element{.name = std::string(words[1]), .count = 0, .properties = {}};
    if (!ParseWhole(words[2], element.count)) {
      return reader_.Fail(absl::StrCat("'", PlyExcerpt(words[2]), "' is not a number of elements"));
    }
    header_.elements.push_back(std::move(element));
  }

  void TakeProperty(const Words& words) {
    if (header_.elements.empty()) return reader_.Fail("a property of no element");
    const bool is_list = content_ == PlyContent::kAny && words.size() == 5 && words[1] == "list";
    const auto scalar =
        words.size() == 3 || is_list ? PlyScalarNamed(words[words.size() - 2]) : std::nullopt;
    const auto count = is_list ? PlyScalarNamed(words[2]) : std::nullopt;
    if (!scalar || (is_list && !count)) {
      return reader_.Fail(absl::StrCat("expected a property that is one number",
                                       content_ == PlyContent::kAny ? " or a list of numbers" : "",
                                       ", not '", Second(words), "'"));
    }
    if (count && count->kind == 'f') {
      return reader_.Fail(absl::StrCat("the length of a list cannot be a ", PlyExcerpt(words[2])));
    }
    header_.elements.back().properties.push_back({std::string(words.back()), *scalar, count});
  }

  PlyHeader End() {
    if (!has_format_) reader_.Fail("no line 'format ascii 1.0', or of another format");
    if (std::ranges::find(header_.elements, "vertex", &PlyElement::name) ==
        header_.elements.end()) {
      reader_.Fail("no element vertex");
    }
    return std::move(header_);
  }

  static std::string Second(const Words& words) {
    return words.size() > 1 ? PlyExcerpt(words[1]) : "";
  }

  PlyReader& reader_;
  const PlyContent content_;
  PlyHeader header_;
  bool has_format_ = false;
  int lines_ = 0;  // of elements and properties
};

}  // namespace

bool PlyReader::NextLine() {
  const std::size_t end = rest_.find('\n');
  if (!status_.ok() || end == std::string_view::npos) return false;
  line_ = rest_.substr(0, end);
  if (line_.ends_with('\r')) line_.remove_suffix(1);
  rest_.remove_prefix(end + 1);
  ++line_number_;
  return true;
}

std::string_view PlyReader::NextWord() { return TakeWord(line_); }

std::vector<std::string_view> PlyReader::TakeWords() {
  Words words;
  while (words.size() <= kMaxWords) {
    const std::string_view word = NextWord();
    if (word.empty()) break;
    words.push_back(word);
  }
  return words;
}

std::string PlyReader::Place() const {
  return line_number_ == 0 ? name_ : absl::StrCat(name_, ", line ", line_number_);
}

void PlyReader::Fail(const std::string& why) { FailWith(absl::InvalidArgumentError(why)); }

void PlyReader::FailWhole(const std::string& why) {
  if (status_.ok()) status_ = absl::InvalidArgumentError(absl::StrCat(name_, ": ", why));
}

void PlyReader::FailExhausted(const std::string& why) {
  if (status_.ok()) status_ = absl::ResourceExhaustedError(absl::StrCat(name_, ": ", why));
}

void PlyReader::FailWith(const absl::Status& error) {
  if (!status_.ok() || error.ok()) return;
  status_ = absl::Status(error.code(), absl::StrCat(Place(), ": ", std::string(error.message())));
}

std::string PlyExcerpt(std::string_view text) {
  return std::string(text.substr(0, 40)) + (text.size() <= 40 ? "" : "...");
}

PlyHeader TakePlyHeader(PlyReader& reader, PlyContent content) {
  return HeaderParser(reader, content).Parse();
}

std::optional<std::size_t> PlyPropertyNamed(const std::string& name, const PlyElement& element,
                                            PlyReader& reader) {
  std::optional<std::size_t> found;
  std::vector<std::string> names;
  for (const PlyElement::Property& property : element.properties) {
    if (property.name == name && found) {
      reader.Fail(absl::StrCat("the header has property ", name, " twice"));
    }
    if (property.name == name) found = names.size();
    names.push_back(property.name);
  }
  if (!found) {
    reader.Fail(absl::StrCat("the header ends without a property ", name, "; it has ",
                             absl::StrJoin(names, " ")));
  }
  return found;
}

}  // namespace clearway
