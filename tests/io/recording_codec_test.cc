#include "io/recording_codec.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zstd.h>

#include "absl/strings/escaping.h"

namespace clearway {
namespace {

using ::testing::HasSubstr;

// The worked example of docs/formats.md.
Frame DocumentedFrame() {
  Frame frame;
  frame.sensor_id = "front";
  frame.sequence = 7;
  frame.stamp = TimeFromNanoseconds(1'000'000'000);
  frame.T_W_S = Pose::Translation(1, 2, 0.5);
  frame.points_S = {{4, 0, 1}, {5, -0.5f, 1}};
  frame.labels = {kStaticLabel, 3};
  frame.motions.push_back({3, Pose::Translation(0.5, 0, 0), TimeFromNanoseconds(900'000'000)});
  return frame;
}

std::string Unpacked(const std::string& bytes) {
  std::string out(ZSTD_getFrameContentSize(bytes.data(), bytes.size()), '\0');
  EXPECT_EQ(ZSTD_decompress(out.data(), out.size(), bytes.data(), bytes.size()), out.size());
  return out;
}

std::string Packed(const std::string& bytes) {
  std::string out(ZSTD_compressBound(bytes.size()), '\0');
  out.resize(ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), 3));
  return out;
}

EncodedRow ExampleRow() { return *EncodeFrame(DocumentedFrame(), 0, 3); }

std::string ErrorOf(const EncodedRow& row) {
  const auto frame = DecodeFrame(ViewOf(row));
  EXPECT_EQ(frame.status().code(), absl::StatusCode::kDataLoss);
  return std::string(frame.status().message());
}

TEST(RecordingCodec, Empty) {
  const auto dut = EncodeFrame(Frame(), 0, 3);
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->point_count, 0);
  EXPECT_EQ(dut->arrays, 0);
  EXPECT_TRUE(DecodeFrame(ViewOf(*dut)).ok());
}

TEST(RecordingCodec, WritesTheDocumentedBytes) {
  const EncodedRow dut = ExampleRow();
  EXPECT_EQ(absl::BytesToHexString(dut.world_from_sensor),
            "00000000000000000000000000000000"
            "0000000000000000000000000000f03f"
            "000000000000f03f0000000000000040"
            "000000000000e03f");
  EXPECT_EQ(absl::BytesToHexString(dut.motions),
            "0300000000e9a4350000000000000000"
            "00000000000000000000000000000000"
            "00000000000000000000f03f00000000"
            "0000e03f000000000000000000000000"
            "00000000");
  EXPECT_EQ(dut.poses, "");
  EXPECT_EQ(absl::BytesToHexString(Unpacked(dut.points)),
            "000080400000a04000000000000000bf"
            "0000803f0000803f0000000003000000");
}

TEST(RecordingCodec, KeepsTheRunOfTheSensorBeforeTheParts) {
  Frame frame = DocumentedFrame();
  frame.sensor_run = 0x0102030405060708;
  frame.parts = {{3, 9}};
  const auto dut = EncodeFrame(frame, 0, 3);
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->arrays, 12);
  EXPECT_EQ(absl::BytesToHexString(Unpacked(dut->points)).substr(64),
            "0807060504030201"
            "0300000009000000");
  const auto back = DecodeFrame(ViewOf(*dut));
  ASSERT_TRUE(back.ok()) << back.status();
  EXPECT_EQ(back->sensor_run, frame.sensor_run);
  EXPECT_EQ(back->parts, frame.parts);
  frame.parts.clear();
  EXPECT_EQ(DecodeFrame(ViewOf(*EncodeFrame(frame, 0, 3)))->sensor_run, frame.sensor_run);
}

TEST(RecordingCodec, RefusesARunThatIsCutOff) {
  EncodedRow row = ExampleRow();
  row.arrays = 8;
  EXPECT_THAT(ErrorOf(row), HasSubstr("not 40 bytes"));
}

TEST(RecordingCodec, ChecksumCoversEveryColumn) {
  const EncodedRow row = ExampleRow();
  const std::int64_t checksum = ChecksumOf(ViewOf(row));
  EXPECT_EQ(ChecksumOf(ViewOf(row)), checksum);
  EncodedRow other = row;
  other.number = 1;
  EXPECT_NE(ChecksumOf(ViewOf(other)), checksum);
  other = row;
  std::swap(other.motions, other.poses);  // the same bytes in the neighbouring column
  EXPECT_NE(ChecksumOf(ViewOf(other)), checksum);
}

// A hostile file's checksum fits.
TEST(RecordingCodec, RefusesRowsThatNoFrameMakes) {
  EncodedRow row = ExampleRow();
  row.point_count = -1;
  EXPECT_THAT(ErrorOf(row), HasSubstr("point_count: -1"));
  row.point_count = std::int64_t{1} << 40;
  EXPECT_THAT(ErrorOf(row), HasSubstr("must lie between 0 and 20000000"));
  row.point_count = 3;
  EXPECT_THAT(ErrorOf(row), HasSubstr("points: not 48 bytes"));
  row = ExampleRow();
  row.arrays = 16;
  EXPECT_THAT(ErrorOf(row), HasSubstr("arrays: unknown bits in 16"));
  row.arrays = 1;
  EXPECT_THAT(ErrorOf(row), HasSubstr("points: not 34 bytes"));
  row = ExampleRow();
  row.world_from_sensor.pop_back();
  EXPECT_THAT(ErrorOf(row), HasSubstr("world_from_sensor: 55 bytes instead of 56"));
  row = ExampleRow();
  row.motions.pop_back();
  EXPECT_THAT(ErrorOf(row), HasSubstr("motions: 67 bytes are not a multiple of 68"));
  row = ExampleRow();
  row.poses = "x";
  EXPECT_THAT(ErrorOf(row), HasSubstr("poses: 1 bytes are not a multiple of 60"));
}

TEST(RecordingCodec, PartsStandBehindThePoints) {
  Frame frame = DocumentedFrame();
  frame.no_return = {0, 1};
  frame.parts = {{3, 2}, {5, 0}};
  const auto dut = EncodeFrame(frame, 0, 3);
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->arrays, 5);
  EXPECT_EQ(absl::BytesToHexString(Unpacked(dut->points)).substr(2 * 34),
            "03000000020000000500000000000000");
  const auto back = DecodeFrame(ViewOf(*dut));
  ASSERT_TRUE(back.ok()) << back.status();
  EXPECT_EQ(back->parts, frame.parts);
  EXPECT_EQ(back->no_return, frame.no_return);
}

TEST(RecordingCodec, RefusesTooManyOrBrokenParts) {
  Frame frame = DocumentedFrame();
  frame.parts.resize(kMaxRecordedParts + 1);
  EXPECT_EQ(EncodeFrame(frame, 0, 3).status().code(), absl::StatusCode::kResourceExhausted);
  EncodedRow row = ExampleRow();
  row.arrays = 4;
  row.points = Packed(std::string(32 + 7, '\0'));
  EXPECT_THAT(ErrorOf(row), HasSubstr("points: not 32 bytes and those of parts"));
  row.points = Packed(std::string(32 + 8 * (kMaxRecordedParts + 1), '\0'));
  EXPECT_THAT(ErrorOf(row), HasSubstr("points: not 32 bytes and those of parts"));
  row.points = Packed(std::string(24, '\0'));
  EXPECT_THAT(ErrorOf(row), HasSubstr("points: not 32 bytes and those of parts"));
}

TEST(RecordingCodec, RefusesPointsThatDoNotUnpack) {
  EncodedRow row = ExampleRow();
  row.points = "not zstd";
  EXPECT_THAT(ErrorOf(row), HasSubstr("points: not 32 bytes compressed by zstd"));
  row.points = "";
  EXPECT_THAT(ErrorOf(row), HasSubstr("points"));
  row = ExampleRow();
  row.points.pop_back();
  EXPECT_THAT(ErrorOf(row), HasSubstr("points: zstd"));
  row.points = Packed(std::string(1'000'000, '\0'));  // a small file that claims to be large
  EXPECT_THAT(ErrorOf(row), HasSubstr("points: not 32 bytes"));
}

}  // namespace
}  // namespace clearway
