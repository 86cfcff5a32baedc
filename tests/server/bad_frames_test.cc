// Frames that are refused, and what else a client can do wrong with them.
#include "server/bad_input.h"

namespace clearway {
namespace {

TEST_F(BadInput, Empty) {
  v1::PushFrameRequest request;
  v1::PushFrameResponse response;
  Expect(Call(*ingest_, &v1::IngestService::Stub::PushFrame, request, &response),
         absl::StatusCode::kInvalidArgument, "frame");
}

TEST_F(BadInput, Frames) {
  using Code = absl::StatusCode;
  struct Case {
    const char* what;
    std::function<void(v1::Frame&)> spoil;
    Code code;
    const char* field;
  };
  const auto rotation = [](v1::Frame& f) {
    return f.mutable_world_from_sensor()->mutable_rotation();
  };
  const auto translation = [](v1::Frame& f) {
    return f.mutable_world_from_sensor()->mutable_translation_m();
  };
  const Case cases[] = {
      {"no pose", [](auto& f) { f.clear_world_from_sensor(); }, Code::kInvalidArgument,
       "frame.world_from_sensor"},
      {"NaN", [&](auto& f) { rotation(f)->set_x(kNan); }, Code::kInvalidArgument,
       "frame.world_from_sensor"},
      {"infinite", [&](auto& f) { translation(f)->set_y(kInfinity); }, Code::kInvalidArgument,
       "frame.world_from_sensor"},
      {"not unit", [&](auto& f) { rotation(f)->set_w(0.9); }, Code::kInvalidArgument,
       "frame.world_from_sensor.rotation"},
      {"zero", [&](auto& f) { rotation(f)->set_w(0); }, Code::kInvalidArgument,
       "frame.world_from_sensor.rotation"},
      {"far", [&](auto& f) { translation(f)->set_z(1e6); }, Code::kInvalidArgument,
       "frame.world_from_sensor.translation_m"},
      {"labels", [](auto& f) { f.add_labels(0); }, Code::kInvalidArgument, "frame.labels"},
      {"origins", [](auto& f) { f.mutable_origins_m()->Resize(6, 0); }, Code::kInvalidArgument,
       "frame.origins_m"},
      {"triple", [](auto& f) { f.add_points_m(0); }, Code::kInvalidArgument, "frame.points_m"},
      {"label", [](auto& f) { f.set_labels(0, -5); }, Code::kInvalidArgument, "frame.labels[0]"},
      {"stamp back",
       [](auto& f) {
         f.set_stamp_ns(9'000'000'000);
         f.clear_motions();
       },
       Code::kFailedPrecondition, "frame.stamp_ns"},
      {"no stamp", [](auto& f) { f.clear_stamp_ns(); }, Code::kInvalidArgument, "frame.stamp_ns"},
      {"no sequence", [](auto& f) { f.clear_sequence(); }, Code::kInvalidArgument,
       "frame.sequence"},
      {"no whole", [](auto& f) { f.add_parts()->set_object_id(1); }, Code::kInvalidArgument,
       "frame.parts[0].whole_id"},
      {"part of itself",
       [](auto& f) {
         f.add_parts()->set_object_id(1);
         f.mutable_parts(0)->set_whole_id(1);
       },
       Code::kInvalidArgument, "frame.parts[0].whole_id"},
      {"points", [](auto& f) { f.mutable_points_m()->Resize(303, 0); }, Code::kResourceExhausted,
       "frame.points_m"},
      {"objects",
       [](auto& f) {
         for (int i = 2; i < 8; ++i) {
           f.add_points_m(1), f.add_points_m(1), f.add_points_m(1), f.add_labels(i);
         }
       },
       Code::kResourceExhausted, "frame.labels"},
      {"blocks", [](auto& f) { f.set_points_m(0, 5'000); }, Code::kResourceExhausted,
       "frame.points_m"},
      {"blocks of rays",
       [](auto& f) {
         f.set_points_m(0, 9e4);
         f.set_points_m(1, 9e4);
       },
       Code::kResourceExhausted, "frame.points_m"},
      {"motion to nowhere",
       [](auto& f) {
         f.mutable_motions(0)->mutable_world_motion()->mutable_translation_m()->set_x(NAN);
       },
       Code::kInvalidArgument, "frame.motions[0].world_motion"},
      {"no motion", [](auto& f) { f.mutable_motions(0)->clear_world_motion(); },
       Code::kInvalidArgument, "frame.motions[0].world_motion"},
  };
  std::uint64_t sequence = 1000;
  for (const Case& bad : cases) {
    SCOPED_TRACE(bad.what);
    v1::Frame frame = Good();
    frame.set_sequence(++sequence);
    bad.spoil(frame);
    Expect(Push(frame), bad.code, bad.field);
  }
}

TEST_F(BadInput, AMessageThatIsTooLarge) {
  v1::Frame frame = Good();
  frame.mutable_points_m()->Resize(1 << 14, 0.f);  // 64 KiB, the limit, and some more
  Expect(Push(frame), absl::StatusCode::kResourceExhausted, "request");
  v1::CheckStatesRequest check = GoodCheck(0);
  check.mutable_times_ns()->Resize(1 << 16, 1);
  Expect(Check(check), absl::StatusCode::kResourceExhausted, "request");
  frame.mutable_points_m()->Resize(1 << 16, 0.f);
  // The transport refuses it before it is taken in: no details.
  const absl::Status refused = Push(frame);
  EXPECT_TRUE(absl::IsResourceExhausted(refused)) << refused;
}

TEST_F(BadInput, BytesThatAreNoMessage) {
  for (const char* method :
       {"/clearway.v1.IngestService/PushFrame", "/clearway.v1.CheckService/CheckStates"}) {
    const grpc::Slice garbage("\xff\xff\xff\xff\xff");
    const grpc::ByteBuffer bytes(&garbage, 1);
    grpc::ByteBuffer response;
    const grpc::Status status = testing_support::RawCall(*channel_, method, bytes, response);
    Expect(Explain(status), absl::StatusCode::kInvalidArgument, "request");
  }
}

TEST_F(BadInput, AStreamAnswersEachFrameAndLivesOn) {
  grpc::ClientContext context;
  const auto stream = ingest_->PushFrames(&context);
  v1::PushFramesRequest request;
  *request.mutable_frame() = Good();
  request.mutable_frame()->set_labels(0, -3);
  ASSERT_TRUE(stream->Write(request));
  request.set_wait_for(v1::ACK_LEVEL_DURABLE);
  ASSERT_TRUE(stream->Write(request));
  request.set_wait_for(static_cast<v1::AckLevel>(77));
  ASSERT_TRUE(stream->Write(request));
  stream->WritesDone();
  v1::PushFramesResponse response;
  ASSERT_TRUE(stream->Read(&response));
  Expect(FromProto(response.error()), absl::StatusCode::kInvalidArgument, "frame.labels[0]");
  ASSERT_TRUE(stream->Read(&response));
  EXPECT_EQ(ReasonOf(FromProto(response.error())), "NO_JOURNAL");
  ASSERT_TRUE(stream->Read(&response));
  Expect(FromProto(response.error()), absl::StatusCode::kInvalidArgument, "wait_for");
  EXPECT_FALSE(stream->Read(&response));
  EXPECT_TRUE(stream->Finish().ok());
}

TEST_F(BadInput, AMessageOfAStreamThatIsTooLarge) {
  grpc::ClientContext context;
  const auto stream = ingest_->PushFrames(&context);
  v1::PushFramesRequest request;
  *request.mutable_frame() = Good();
  request.mutable_frame()->mutable_points_m()->Resize(1 << 14, 0.f);
  ASSERT_TRUE(stream->Write(request));
  request.mutable_frame()->set_labels(0, -3);
  request.mutable_frame()->mutable_points_m()->Resize(3, 0.f);
  ASSERT_TRUE(stream->Write(request));
  stream->WritesDone();
  v1::PushFramesResponse response;
  ASSERT_TRUE(stream->Read(&response));
  Expect(FromProto(response.error()), absl::StatusCode::kResourceExhausted, "request");
  EXPECT_EQ(response.sequence(), request.frame().sequence());
  ASSERT_TRUE(stream->Read(&response));
  Expect(FromProto(response.error()), absl::StatusCode::kInvalidArgument, "frame.labels[0]");
  EXPECT_TRUE(stream->Finish().ok());
}

TEST_F(BadInput, BytesInAStreamThatAreNoMessage) {
  for (const char* method :
       {"/clearway.v1.IngestService/PushFrames", "/clearway.v1.MapService/LoadPrior"}) {
    for (const char* bytes : {"\xff\xff\xff\xff\xff", "\x0a", "\xf8\xff\xff\xff\x0f\x01\x0a\x05"}) {
      const grpc::Slice garbage(bytes);
      const grpc::Status status =
          testing_support::RawStream(*channel_, method, grpc::ByteBuffer(&garbage, 1));
      Expect(Explain(status), absl::StatusCode::kInvalidArgument, "request");
    }
  }
}

// An accepted frame's name stays with its answer; what was never accepted leaves its name free.
TEST_F(BadInput, ARepeatGetsTheFirstAnswerAndAnotherFrameOfItsNameIsRefused) {
  Frame frame = testing_support::FrameAt(10);  // as SetUp pushed it
  testing_support::AddPoint(frame, kStaticLabel, {3, 0, 0});
  testing_support::AddPoint(frame, 1, {5, 0, 0});
  v1::PushFrameRequest request;
  *request.mutable_frame() = ProtoOf(frame);
  v1::PushFrameResponse first, again;
  const auto push = [&](v1::PushFrameResponse* response) {
    return Call(*ingest_, &v1::IngestService::Stub::PushFrame, request, response);
  };
  ASSERT_TRUE(push(&first).ok());
  EXPECT_TRUE(first.repeated_answer());
  EXPECT_EQ(first.reached(), v1::ACK_LEVEL_APPLIED);
  request.set_wait_for(v1::ACK_LEVEL_ACCEPTED);
  ASSERT_TRUE(push(&again).ok());
  EXPECT_EQ(again.reached(), v1::ACK_LEVEL_APPLIED);
  EXPECT_EQ(again.scene().version(), first.scene().version());
  EXPECT_EQ(again.report().points_used(), first.report().points_used());

  request.mutable_frame()->set_points_m(0, 3.001F);
  const absl::Status other = push(&again);
  Expect(other, absl::StatusCode::kAlreadyExists, "");
  EXPECT_EQ(ReasonOf(other), "FRAME_NAME_TAKEN");
  request.mutable_frame()->clear_stamp_ns();  // malformed, whatever its name
  Expect(push(&again), absl::StatusCode::kInvalidArgument, "frame.stamp_ns");
  request.mutable_frame()->add_labels(-3);
  EXPECT_TRUE(absl::IsInvalidArgument(push(&again)));
  *request.mutable_frame() = ProtoOf(frame);
  EXPECT_TRUE(push(&again).ok());

  request.mutable_frame()->set_sequence(4711);  // malformed under a new name leaves it free
  request.mutable_frame()->add_labels(0);
  EXPECT_TRUE(absl::IsInvalidArgument(push(&again)));
  request.mutable_frame()->set_points_m(0, kNan);
  EXPECT_TRUE(absl::IsInvalidArgument(push(&again)));
}

TEST_F(BadInput, RefusedFramesAreCounted) {
  v1::Frame frame = Good();
  frame.set_labels(0, -3);
  EXPECT_FALSE(Push(frame).ok());
  EXPECT_EQ(server_.core().ingestor.counts().frames_refused, 1u);
}

TEST_F(BadInput, ClientsThatDieMidStreamLeaveNothingBehind) {
  for (int i = 0; i < 10; ++i) {
    grpc::ClientContext push_context, follow_context;
    const auto push = ingest_->PushFrames(&push_context);
    v1::PushFramesRequest request;
    *request.mutable_frame() = Good();
    request.mutable_frame()->set_labels(0, -3);
    push->Write(request);
    const auto follow = follow_->FollowScene(&follow_context, v1::FollowSceneRequest());
    v1::FollowSceneResponse response;
    EXPECT_TRUE(follow->Read(&response));
    push_context.TryCancel();
    follow_context.TryCancel();
    follow->Finish();
    push->Finish();
  }
  const ServerCore& core = server_.core();
  for (int i = 0; i < 500 && core.follow_streams.size() + core.push_streams.size() > 0; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_EQ(core.follow_streams.size(), 0u);
  EXPECT_EQ(core.push_streams.size(), 0u);
}

}  // namespace
}  // namespace clearway
