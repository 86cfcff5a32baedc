#include "wire/status.h"

#include <gtest/gtest.h>

#include "google/rpc/error_details.pb.h"

namespace clearway {
namespace {

TEST(WireStatus, Empty) {
  const google::rpc::Status dut = ToProto(absl::OkStatus());
  EXPECT_EQ(dut.code(), 0);
  EXPECT_EQ(dut.details_size(), 0);
  EXPECT_TRUE(FromProto(dut).ok());
}

TEST(WireStatus, EveryErrorSaysWhyInTheDomain) {
  for (int code = 1; code <= 16; ++code) {
    const google::rpc::Status dut =
        ToProto(absl::Status(static_cast<absl::StatusCode>(code), "Something went wrong"));
    google::rpc::ErrorInfo info;
    for (const google::protobuf::Any& detail : dut.details()) {
      if (detail.Is<google::rpc::ErrorInfo>()) detail.UnpackTo(&info);
    }
    EXPECT_EQ(info.domain(), "clearway") << code;
    EXPECT_FALSE(info.reason().empty());
  }
}

TEST(WireStatus, ABadFieldIsNamed) {
  const absl::Status dut = FromProto(ToProto(FieldError("frame.motions[2].world_motion", "bad")));
  EXPECT_EQ(dut.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(BadFieldOf(dut), "frame.motions[2].world_motion");
  EXPECT_EQ(ReasonOf(dut), "BAD_FIELD");
  EXPECT_FALSE(RetryDelayOf(dut).has_value());
}

TEST(WireStatus, FieldsAreFoundInBothStylesOfMessage) {
  EXPECT_EQ(FieldOf(absl::InvalidArgumentError("links[0].shapes is empty")), "links[0].shapes");
  EXPECT_EQ(FieldOf(absl::InvalidArgumentError("stamp_ns: is missing")), "stamp_ns");
  EXPECT_EQ(FieldOf(absl::InvalidArgumentError("Something is wrong")), "");
  EXPECT_EQ(FieldOf(absl::InvalidArgumentError("")), "");
}

TEST(WireStatus, APrefixGoesBeforeTheFieldAndKeepsDetails) {
  const absl::Status dut =
      WithFieldPrefix("frame.", WithReason(FieldError("stamp_ns", "goes back"), "STAMP"));
  EXPECT_EQ(FieldOf(dut), "frame.stamp_ns");
  EXPECT_EQ(ReasonOf(dut), "STAMP");
}

TEST(WireStatus, OverloadSaysWhenToTryAgain) {
  for (const absl::Status& status :
       {absl::UnavailableError("draining"), LimitError("labels", 5, 4)}) {
    const absl::Status dut = FromProto(ToProto(status));
    ASSERT_TRUE(RetryDelayOf(dut).has_value());
    EXPECT_GT(*RetryDelayOf(dut), Duration::zero());
  }
}

TEST(WireStatus, ReasonsTravel) {
  const absl::Status dut =
      FromProto(ToProto(WithReason(absl::NotFoundError("no such robot"), "UNKNOWN_ROBOT")));
  EXPECT_TRUE(absl::IsNotFound(dut));
  EXPECT_EQ(ReasonOf(dut), "UNKNOWN_ROBOT");
  EXPECT_EQ(dut.message(), "no such robot");
}

TEST(WireStatus, CodesThatDoNotExistAreUnknown) {
  google::rpc::Status proto;
  for (int code : {-1, 17, 1000}) {
    proto.set_code(code);
    EXPECT_TRUE(absl::IsUnknown(FromProto(proto))) << code;
  }
}

TEST(WireStatus, DamagedDetailsAreIgnored) {
  google::rpc::Status proto;
  proto.set_code(3);
  proto.add_details()->set_type_url("type.googleapis.com/google.rpc.BadRequest");
  proto.mutable_details(0)->set_value("\xff\xff\xff");
  EXPECT_EQ(BadFieldOf(FromProto(proto)), "");
}

}  // namespace
}  // namespace clearway
