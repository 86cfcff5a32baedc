#include "io/gltf_accessors.h"

#include <algorithm>
#include <charconv>

#include "absl/strings/escaping.h"
#include "absl/strings/match.h"

namespace clearway {
namespace {

using Json = nlohmann::json;

std::uint64_t BytesOf(std::uint64_t component_type) {
  const bool is_byte = component_type == 5120 || component_type == 5121;
  const bool is_short = component_type == 5122 || component_type == 5123;
  return is_byte ? 1 : is_short ? 2 : 4;
}

std::uint64_t ComponentsOf(const Json& type) {
  return type == "SCALAR" ? 1
         : type == "VEC2" ? 2
         : type == "VEC3" ? 3
         : type == "MAT3" ? 9
         : type == "MAT4" ? 16
                          : 4;
}

// "a%20b.bin" is "a b.bin".
std::string WithoutEscapes(const std::string& uri) {
  std::string path;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    unsigned char byte = 0;
    const char* const end = uri.data() + std::min(i + 3, uri.size());
    if (uri[i] == '%' &&
        std::from_chars(uri.data() + i + 1, end, byte, 16).ptr == uri.data() + i + 3) {
      path.push_back(static_cast<char>(byte));
      i += 2;
    } else {
      path.push_back(uri[i]);
    }
  }
  return path;
}

std::string PlaceOf(const char* list, std::uint64_t index) {
  return absl::StrCat(list, "[", index, "]");
}

}  // namespace

const GltfAccessors::Kind& GltfAccessors::Positions() {
  static const Kind* const kind = new Kind{"VEC3", {5126}, 3, true};
  return *kind;
}

const GltfAccessors::Kind& GltfAccessors::Indices() {
  static const Kind* const kind = new Kind{"SCALAR", {5121, 5123, 5125}, 1, false};
  return *kind;
}

GltfAccessors::GltfAccessors(const GltfFile& file, FirstError& error, Json& reduced)
    : file_(file), error_(error), members_(file.json, error), reduced_(reduced) {
  for (const char* const list : {"accessors", "bufferViews", "buffers"}) {
    reduced_[list] = Json::array();
    for (std::size_t i = 0; i < members_.List(file.json, "", list).size(); ++i) {
      reduced_[list].push_back(Json::object());
    }
  }
  marked_.resize(reduced_["accessors"].size());
}

std::uint64_t GltfAccessors::Use(std::uint64_t accessor, const Kind& kind) {
  const std::string place = PlaceOf("accessors", accessor);
  const Json& given = members_.Element(accessor, "accessors");
  const std::uint64_t type = members_.Whole(given, place, "componentType");
  const std::uint64_t count = members_.Whole(given, place, "count");
  const std::uint64_t offset = members_.WholeOr(given, place, "byteOffset", 0);
  if (given.contains("sparse")) error_.Set(place, "sparse accessors are not supported");
  if (!given.contains("bufferView")) error_.Set(place, "bufferView is missing");
  const Json& shape = GltfMembers::Get(given, "type");
  if (shape != kind.type ||
      std::ranges::find(kind.component_types, type) == kind.component_types.end()) {
    error_.Set(place,
               absl::StrCat("type ", shape.dump().substr(0, 40), " with componentType ", type,
                            " cannot be read here: positions are VEC3 of 5126 (float), "
                            "indices SCALAR of 5121, 5123 or 5125 (unsigned)"));
  }
  if (given.contains("normalized") && given["normalized"] != false) {
    error_.Set(place, "normalized numbers are not supported");
  }
  if (count == 0) error_.Set(place, "count is 0; it must be above 0");
  if (!error_.ok()) return 0;
  marked_[accessor] = true;
  const std::uint64_t view = members_.Index(given["bufferView"], place, "bufferViews");
  const std::uint64_t size = kind.components * BytesOf(type);
  const std::uint64_t stride = members_.WholeOr(members_.Element(view, "bufferViews"),
                                                PlaceOf("bufferViews", view), "byteStride", size);
  if (stride < size || (stride != size && !kind.has_stride) || stride % BytesOf(type) != 0 ||
      offset % BytesOf(type) != 0) {
    error_.Set(place, absl::StrCat("elements of ", size, " bytes cannot stand at offset ", offset,
                                   " and ", stride, " bytes apart"));
  }
  const std::uint64_t end = offset + stride * (count - 1) + size;
  UseView(view, end, kind, place);
  const std::uint64_t length = members_.Whole(members_.Element(view, "bufferViews"),
                                              PlaceOf("bufferViews", view), "byteLength");
  if (offset + stride * count > length) {  // which assimp demands
    error_.Set(place, absl::StrCat("its last element must be followed by what is missing of its ",
                                   stride, " bytes: make ", PlaceOf("bufferViews", view), " ",
                                   offset + stride * count - length, " bytes longer"));
  }
  reduced_["accessors"][accessor] = {{"bufferView", view},
                                     {"byteOffset", offset},
                                     {"componentType", type},
                                     {"count", count},
                                     {"type", kind.type}};
  return error_.ok() ? count : 0;
}

void GltfAccessors::UseView(std::uint64_t view, std::uint64_t end, const Kind& kind,
                            const std::string& place) {
  const std::string own_place = PlaceOf("bufferViews", view);
  const Json& given = members_.Element(view, "bufferViews");
  const std::uint64_t offset = members_.WholeOr(given, own_place, "byteOffset", 0);
  const std::uint64_t length = members_.Whole(given, own_place, "byteLength");
  if (end > length) {
    error_.Set(place, absl::StrCat("it ends at byte ", end, " of ", own_place, ", which has ",
                                   length, " bytes"));
  }
  if (!given.contains("buffer")) error_.Set(own_place, "buffer is missing");
  if (!error_.ok()) return;
  const std::uint64_t buffer = members_.Index(given["buffer"], own_place, "buffers");
  UseBuffer(buffer, offset + length, own_place);
  Json reduced = {{"buffer", buffer}, {"byteOffset", offset}, {"byteLength", length}};
  if (kind.has_stride && given.contains("byteStride")) reduced["byteStride"] = given["byteStride"];
  reduced_["bufferViews"][view] = std::move(reduced);
}

void GltfAccessors::UseBuffer(std::uint64_t buffer, std::uint64_t end, const std::string& place) {
  const std::string own_place = PlaceOf("buffers", buffer);
  const Json& given = members_.Element(buffer, "buffers");
  const std::uint64_t length = members_.Whole(given, own_place, "byteLength");
  if (end > length) {
    error_.Set(place, absl::StrCat("it ends at byte ", end, " of ", own_place, ", which has ",
                                   length, " bytes"));
  }
  if (!error_.ok() || !reduced_["buffers"][buffer].empty()) return;
  Json reduced = {{"byteLength", length}};
  if (!file_.is_glb) {
    reduced["uri"] = Uri(given, length, own_place);
  } else if (given.contains("uri") || buffer != 0) {
    error_.Set(own_place, "a .glb file's buffer must be in the file itself");
  } else if (file_.buffer.value_or("").size() < length) {
    error_.Set(own_place, absl::StrCat("it states ", length, " bytes, and the BIN chunk has ",
                                       file_.buffer.value_or("").size()));
  }
  reduced_["buffers"][buffer] = std::move(reduced);
}

// A file's name, or the bytes themselves, which must be as many.
std::string GltfAccessors::Uri(const Json& buffer, std::uint64_t bytes, const std::string& place) {
  const Json& given = GltfMembers::Get(buffer, "uri");
  if (!given.is_string() || given.get<std::string>().empty()) {
    error_.Set(place, "uri is missing");
    return "";
  }
  const std::string uri = given.get<std::string>();
  if (!absl::StartsWithIgnoreCase(uri, "data:")) {
    files_.push_back(WithoutEscapes(uri));
    return files_.back();
  }
  const std::size_t comma = std::min(uri.find(','), uri.size());
  std::string data;
  if (!absl::EndsWithIgnoreCase(uri.substr(0, comma), ";base64") ||
      !absl::Base64Unescape(uri.substr(std::min(comma + 1, uri.size())), &data)) {
    error_.Set(place, "the data of its uri are not base64");
  } else if (data.size() != bytes) {
    error_.Set(place, absl::StrCat("it states ", bytes, " bytes and has ", data.size()));
  }
  return "data:application/octet-stream;base64," + absl::Base64Escape(data);
}

std::uint64_t GltfAccessors::EndOf(const Json& accessor, std::uint64_t stride) const {
  const std::uint64_t count = members_.WholeOr(accessor, "", "count", 0);
  const std::uint64_t size = BytesOf(members_.WholeOr(accessor, "", "componentType", 0)) *
                             ComponentsOf(GltfMembers::Get(accessor, "type"));
  if (count == 0) return 0;
  return members_.WholeOr(accessor, "", "byteOffset", 0) +
         (stride == 0 ? size : stride) * (count - 1) + size;
}

void GltfAccessors::CheckViewsCovered() {
  constexpr std::uint64_t kAlignment = 4;
  const Json& views = reduced_["bufferViews"];
  for (std::size_t v = 0; v < views.size(); ++v) {
    if (views[v].empty()) continue;
    const Json& view = members_.Element(v, "bufferViews");
    const std::uint64_t stride = members_.WholeOr(view, PlaceOf("bufferViews", v), "byteStride", 0);
    std::uint64_t end = 0;
    for (const Json& accessor : members_.List(file_.json, "", "accessors")) {
      if (GltfMembers::Get(accessor, "bufferView") == v)
        end = std::max(end, EndOf(accessor, stride));
    }
    const std::uint64_t length = views[v]["byteLength"].get<std::uint64_t>();
    if (length < end + std::max(kAlignment, stride)) continue;
    error_.Set(PlaceOf("bufferViews", v),
               absl::StrCat("its last ", length - end,
                            " bytes are in no accessor: a part seems to be missing "
                            "(if not, shorten it)"));
  }
}

void GltfAccessors::Mark(const Json& number) {
  if (number.is_number_unsigned() && number.get<std::uint64_t>() < marked_.size()) {
    marked_[number.get<std::uint64_t>()] = true;
  }
}

void GltfAccessors::CheckAllMarked() {
  const auto first = std::ranges::find(marked_, false);
  if (first == marked_.end()) return;
  error_.Set(absl::StrCat("accessors[", first - marked_.begin(), "]"),
             "nothing refers to it: a part seems to be missing (if not, remove it)");
}

}  // namespace clearway
