// PLY files up to the end of their headers.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "io/ply_scalar.h"

namespace clearway {

enum class PlyFormat { kAscii, kLittleEndian, kBigEndian };

struct PlyElement {
  struct Property {
    std::string name;
    PlyScalar scalar;
    std::optional<PlyScalar> count;  // of a list: its length; none for a single number
  };

  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::kAscii;
  std::vector<PlyElement> elements;  // no two of one name
};

// A PLY file while it is read. The first error is kept. One thread.
class PlyReader {
 public:
  // `name` is that of the file in messages. The bytes must outlive this.
  PlyReader(std::string name, std::string_view bytes) : name_(std::move(name)), rest_(bytes) {}

  bool ok() const { return status_.ok(); }
  const absl::Status& status() const { return status_; }
  // What has not been read.
  std::string_view rest() const { return rest_; }

  // Takes the next line. False after an error, at the end, and if the line does not end.
  bool NextLine();
  // Takes the next word of the line; empty if there is none.
  std::string_view NextWord();
  // Takes the words of a line of the header: no more than one too many for any of them.
  std::vector<std::string_view> TakeWords();

  // What follows is binary: messages name no line from here on.
  void EndLines() { line_number_ = 0; }
  // Takes the next bytes, of which there must be as many.
  void Skip(std::size_t bytes) { rest_.remove_prefix(bytes); }

  // Keep an error: "<name>, line 3: <why>", or "<name>: <why>" for the file as a whole.
  void Fail(const std::string& why);
  void FailWhole(const std::string& why);
  void FailCutOff(const std::string& why) { FailWhole(why + "; the file is cut off"); }
  void FailExhausted(const std::string& why);
  // Keeps an error that names neither file nor line.
  void FailWith(const absl::Status& error);

 private:
  std::string Place() const;

  std::string name_;
  std::string_view rest_, line_;
  int line_number_ = 0;
  absl::Status status_;
};

// What of a bad line is worth showing.
std::string PlyExcerpt(std::string_view text);

// Which elements and properties a header may have.
enum class PlyContent {
  kVertices,  // the one element "vertex", whose properties are single numbers
  kAny,
};

// Reads up to end_header. Unless the reader has an error then, there is an element "vertex".
PlyHeader TakePlyHeader(PlyReader& reader, PlyContent content);

// Which of the element's properties has the name. None, and an error of the reader, unless it is
// one.
std::optional<std::size_t> PlyPropertyNamed(const std::string& name, const PlyElement& element,
                                            PlyReader& reader);

}  // namespace clearway
