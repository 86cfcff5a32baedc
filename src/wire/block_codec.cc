#include "wire/block_codec.h"

#include <zstd.h>

#include "absl/strings/str_cat.h"
#include "clearway/v1/delta.pb.h"
#include "wire/status.h"

namespace clearway {
namespace {

constexpr int kCompressionLevel = 1;  // the network is local, the writer's time is not free
constexpr int kWords = 8;             // of a block mask

void AppendBlock(const BlockDelta& block, v1::BlockDeltas* proto) {
  proto->add_keys(block.key.x);
  proto->add_keys(block.key.y);
  proto->add_keys(block.key.z);
  proto->mutable_changed()->Add(block.changed.words.begin(), block.changed.words.end());
  proto->mutable_observed()->Add(block.observed.words.begin(), block.observed.words.end());
  proto->mutable_log_odds()->Add(block.log_odds.begin(), block.log_odds.end());
}

absl::StatusOr<MapDelta> ReadBlocks(const std::string& field, const v1::BlockDeltas& proto,
                                    std::size_t max_blocks) {
  const std::size_t count = proto.keys_size() / 3;
  if (count > max_blocks) return FieldError(field, absl::StrCat("holds ", count, " blocks"));
  if (proto.keys_size() % 3 != 0 ||
      static_cast<std::size_t>(proto.changed_size()) != kWords * count ||
      static_cast<std::size_t>(proto.observed_size()) != kWords * count) {
    return FieldError(field, "keys and masks disagree in length");
  }
  MapDelta blocks(count);
  int value = 0;
  for (std::size_t b = 0; b < count; ++b) {
    BlockDelta& block = blocks[b];
    const int at = static_cast<int>(b);
    block.key = {proto.keys(3 * at), proto.keys(3 * at + 1), proto.keys(3 * at + 2)};
    for (int w = 0; w < kWords; ++w) {
      block.changed.words[w] = proto.changed(kWords * at + w);
      block.observed.words[w] = proto.observed(kWords * at + w);
    }
    const int voxels = block.observed.Count();
    if (voxels > proto.log_odds_size() - value) return FieldError(field, "has too few log-odds");
    for (int end = value + voxels; value < end; ++value) {
      const std::int32_t log_odds = proto.log_odds(value);
      if (log_odds != static_cast<LogOdds>(log_odds)) {
        return FieldError(field, absl::StrCat("log-odds of ", log_odds, " do not fit 16 bits"));
      }
      block.log_odds.push_back(static_cast<LogOdds>(log_odds));
    }
  }
  if (value != proto.log_odds_size()) return FieldError(field, "has too many log-odds");
  return blocks;
}

}  // namespace

std::string CompressBlocks(std::span<const BlockDelta> blocks) {
  v1::BlockDeltas proto;
  for (const BlockDelta& block : blocks) AppendBlock(block, &proto);
  const std::string raw = proto.SerializeAsString();
  std::string bytes(ZSTD_compressBound(raw.size()), '\0');
  // Cannot fail: the output has room for the worst case.
  bytes.resize(
      ZSTD_compress(bytes.data(), bytes.size(), raw.data(), raw.size(), kCompressionLevel));
  return bytes;
}

absl::StatusOr<MapDelta> DecompressBlocks(const std::string& field, const std::string& bytes,
                                          std::size_t max_blocks, std::size_t max_bytes) {
  const unsigned long long size = ZSTD_getFrameContentSize(bytes.data(), bytes.size());
  if (size == ZSTD_CONTENTSIZE_ERROR || size == ZSTD_CONTENTSIZE_UNKNOWN) {
    return FieldError(field, "is not a Zstandard frame that states its size");
  }
  if (size > max_bytes) {
    return FieldError(field, absl::StrCat("would take ", size, " bytes; the limit is ", max_bytes));
  }
  std::string raw(size, '\0');
  const std::size_t written = ZSTD_decompress(raw.data(), raw.size(), bytes.data(), bytes.size());
  if (ZSTD_isError(written) != 0 || written != raw.size()) {
    return FieldError(field, "is a damaged Zstandard frame");
  }
  v1::BlockDeltas proto;
  if (!proto.ParseFromString(raw)) return FieldError(field, "does not hold BlockDeltas");
  return ReadBlocks(field, proto, max_blocks);
}

}  // namespace clearway
