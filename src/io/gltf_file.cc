#include "io/gltf_file.h"

#include <cstdint>
#include <cstring>
#include <set>
#include <vector>

#include "absl/strings/str_cat.h"
#include "io/mesh_lines.h"

namespace clearway {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kHeaderBytes = 12, kChunkHeaderBytes = 8, kAlignment = 4;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;

// Parsers differ in which value of a key that stands twice they keep.
absl::StatusOr<Json> ParseOnce(std::string_view text) {
  std::vector<std::set<std::string>> objects;
  std::string twice;
  const auto see = [&](int, Json::parse_event_t event, const Json& parsed) {
    if (event == Json::parse_event_t::object_start) objects.emplace_back();
    if (event == Json::parse_event_t::object_end) objects.pop_back();
    if (event == Json::parse_event_t::key && twice.empty() &&
        !objects.back().insert(parsed.get<std::string>()).second) {
      twice = parsed.get<std::string>();
    }
    return true;
  };
  try {
    Json json = Json::parse(text, see);
    if (!twice.empty()) {
      return absl::InvalidArgumentError(absl::StrCat(Quoted(twice), " is given twice"));
    }
    if (json.is_object()) return json;
    return absl::InvalidArgumentError("the outermost JSON value is not an object");
  } catch (const Json::exception& error) {
    // "[json.exception.parse_error.101] parse error at line 3, column 5: ..."
    const std::string_view what = error.what();
    const std::size_t end = what.find("] ");
    return absl::InvalidArgumentError(
        std::string(end == std::string_view::npos ? what : what.substr(end + 2)));
  }
}

// In the order of bytes of the machines that we run on, little endian, as the file's.
std::uint32_t NumberAt(std::string_view bytes, std::size_t offset) {
  std::uint32_t number = 0;
  std::memcpy(&number, bytes.data() + offset, sizeof number);
  return number;
}

void Append(std::string& bytes, std::uint32_t number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

void AppendChunk(std::string& bytes, std::uint32_t type, std::string chunk, char padding) {
  chunk.resize((chunk.size() + kAlignment - 1) / kAlignment * kAlignment, padding);
  Append(bytes, static_cast<std::uint32_t>(chunk.size()));
  Append(bytes, type);
  bytes += chunk;
}

// Takes the chunk off the front of the rest; it must be of the type, if one is given.
absl::StatusOr<std::string_view> TakeChunk(std::string_view& rest,
                                           std::optional<std::uint32_t> type,
                                           const std::string& name) {
  if (rest.size() < kChunkHeaderBytes) {
    return absl::InvalidArgumentError(absl::StrCat("no ", name, " chunk: the file is cut off"));
  }
  const std::uint32_t size = NumberAt(rest, 0);
  if (type && NumberAt(rest, 4) != *type) {
    return absl::InvalidArgumentError(absl::StrCat("expected a ", name, " chunk"));
  }
  rest.remove_prefix(kChunkHeaderBytes);
  if (size > rest.size() || size % kAlignment != 0) {
    return absl::InvalidArgumentError(absl::StrCat("the ", name, " chunk states ", size,
                                                   " bytes, a multiple of ", kAlignment,
                                                   " is needed and ", rest.size(), " are left"));
  }
  const std::string_view chunk = rest.substr(0, size);
  rest.remove_prefix(size);
  return chunk;
}

}  // namespace

absl::StatusOr<GltfFile> ReadGltf(std::string_view bytes) {
  absl::StatusOr<Json> json = ParseOnce(bytes);
  if (!json.ok()) return json.status();
  return GltfFile{*std::move(json), std::nullopt, false};
}

absl::StatusOr<GltfFile> ReadGlb(std::string_view bytes) {
  if (bytes.size() < kHeaderBytes || !bytes.starts_with("glTF")) {
    return absl::InvalidArgumentError("not a .glb file: it does not begin with 'glTF'");
  }
  if (NumberAt(bytes, 4) != 2) {
    return absl::InvalidArgumentError(
        absl::StrCat("it is version ", NumberAt(bytes, 4), " of glTF; only version 2 is read"));
  }
  if (NumberAt(bytes, 8) != bytes.size()) {
    return absl::InvalidArgumentError(
        absl::StrCat("it states ", NumberAt(bytes, 8), " bytes and has ", bytes.size()));
  }
  std::string_view rest = bytes.substr(kHeaderBytes);
  const auto text = TakeChunk(rest, kJsonChunk, "JSON");
  if (!text.ok()) return text.status();
  absl::StatusOr<GltfFile> file = ReadGltf(*text);
  if (!file.ok()) return file.status();
  file->is_glb = true;
  if (rest.empty()) return file;
  const auto buffer = TakeChunk(rest, kBinaryChunk, "BIN");
  if (!buffer.ok()) return buffer.status();
  file->buffer = std::string(*buffer);
  while (!rest.empty()) {  // of extensions: to be ignored
    const auto other = TakeChunk(rest, std::nullopt, "third");
    if (!other.ok()) return other.status();
  }
  return file;
}

std::string GltfBytes(const GltfFile& file) {
  if (!file.is_glb) return file.json.dump();
  std::string chunks;
  AppendChunk(chunks, kJsonChunk, file.json.dump(), ' ');
  if (file.buffer) AppendChunk(chunks, kBinaryChunk, *file.buffer, '\0');
  std::string bytes = "glTF";
  Append(bytes, 2);
  Append(bytes, static_cast<std::uint32_t>(kHeaderBytes + chunks.size()));
  return bytes + chunks;
}

}  // namespace clearway
