#include "server/content_hash.h"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/io/zero_copy_stream.h>
#include <xxhash.h>

#include <memory>
#include <vector>

namespace clearway {
namespace {

// Takes bytes piece by piece.
class HashingStream : public google::protobuf::io::ZeroCopyOutputStream {
 public:
  HashingStream() : state_(XXH3_createState(), &XXH3_freeState), piece_(kPieceBytes) {
    XXH3_64bits_reset(state_.get());
  }

  bool Next(void** data, int* size) override {
    TakePiece();
    *data = piece_.data();
    *size = static_cast<int>(used_ = kPieceBytes);
    return true;
  }
  void BackUp(int count) override { used_ -= static_cast<std::size_t>(count); }
  std::int64_t ByteCount() const override {
    return static_cast<std::int64_t>(hashed_bytes_ + used_);
  }

  std::uint64_t Hash() {
    TakePiece();
    return XXH3_64bits_digest(state_.get());
  }

 private:
  static constexpr std::size_t kPieceBytes = 64 << 10;

  void TakePiece() {
    XXH3_64bits_update(state_.get(), piece_.data(), used_);
    hashed_bytes_ += used_;
    used_ = 0;
  }

  std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state_;
  std::vector<char> piece_;
  std::size_t used_ = 0, hashed_bytes_ = 0;
};

}  // namespace

std::uint64_t ContentHash(const google::protobuf::MessageLite& message) {
  HashingStream stream;
  {
    google::protobuf::io::CodedOutputStream out(&stream);
    out.SetSerializationDeterministic(true);
    message.SerializePartialToCodedStream(&out);
  }
  return stream.Hash();
}

}  // namespace clearway
