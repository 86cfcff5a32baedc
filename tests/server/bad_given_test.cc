// What clients get wrong about given objects and futures.
#include "server/bad_input.h"

namespace clearway {
namespace {

using Code = absl::StatusCode;

class BadGiven : public BadInput {
 protected:
  // Objects that would be added.
  static v1::AddObjectsRequest GoodObjects(int count = 1) {
    v1::AddObjectsRequest request;
    for (int i = 0; i < count; ++i) {
      v1::GivenObject* object = request.add_objects();
      object->set_object_id(10 + i);
      object->mutable_shape()->mutable_sphere()->set_radius_m(0.5);
      Write(Pose{}, object->mutable_world_from_object());
      object->set_stamp_ns(0);
    }
    return request;
  }
  absl::Status Add(const v1::AddObjectsRequest& request) {
    v1::AddObjectsResponse response;
    return Call(*objects_, &v1::ObjectService::Stub::AddObjects, request, &response);
  }
  absl::Status Remove(std::initializer_list<ObjectId> ids) {
    v1::RemoveObjectsRequest request;
    request.mutable_object_ids()->Add(ids.begin(), ids.end());
    v1::RemoveObjectsResponse response;
    return Call(*objects_, &v1::ObjectService::Stub::RemoveObjects, request, &response);
  }
  // Of object 1, whose newest pose is at 10 s.
  static v1::SetFuturesRequest GoodFuture() {
    v1::SetFuturesRequest request;
    v1::ObjectFuture* future = request.add_futures();
    future->set_object_id(1);
    for (std::int64_t seconds : {11, 12}) {
      future->mutable_future()->add_stamps_ns(seconds * 1'000'000'000);
      Append(Pose{}, future->mutable_future()->mutable_world_from_object());
    }
    return request;
  }
  absl::Status Set(const v1::SetFuturesRequest& request) {
    v1::SetFuturesResponse response;
    return Call(*objects_, &v1::ObjectService::Stub::SetFutures, request, &response);
  }
};

TEST_F(BadGiven, GoodOnesComeAndGo) {
  ASSERT_TRUE(Add(GoodObjects(2)).ok());
  EXPECT_NE(server_.Newest()->Hash(), hash_);
  Expect(Add(GoodObjects()), Code::kAlreadyExists, "objects[0].object_id");
  EXPECT_TRUE(Remove({10, 11}).ok());
  ASSERT_TRUE(Set(GoodFuture()).ok());
  EXPECT_NE(server_.Newest()->Hash(), hash_);
  v1::SetFuturesRequest none;
  none.add_futures()->set_object_id(1);
  EXPECT_TRUE(Set(none).ok());
}

TEST_F(BadGiven, Objects) {
  const auto refuse = [this](const std::function<void(v1::GivenObject&)>& spoil,
                             const std::string& field, Code code = Code::kInvalidArgument) {
    v1::AddObjectsRequest request = GoodObjects(2);  // the first of which is good
    spoil(*request.mutable_objects(1));
    Expect(Add(request), code, field.empty() ? "" : "objects[1]." + field);
  };
  refuse([](auto& o) { o.clear_shape(); }, "shape.shape");
  refuse([](auto& o) { o.mutable_shape()->mutable_sphere()->set_radius_m(kNan); },
         "shape.sphere.radius_m");
  refuse([](auto& o) { o.mutable_shape()->mutable_box(); }, "shape.box.size_m");
  refuse([](auto& o) { o.mutable_shape()->mutable_convex(); }, "shape.convex");
  refuse([](auto& o) { o.mutable_shape()->mutable_convex()->add_vertices_m(1); },
         "shape.convex.vertices_m");
  refuse([](auto& o) { o.set_object_id(0); }, "object_id");
  refuse([](auto& o) { o.set_object_id(10); }, "object_id", Code::kAlreadyExists);
  refuse([](auto& o) { o.set_object_id(1); }, "object_id", Code::kAlreadyExists);
  refuse([](auto& o) { o.clear_stamp_ns(); }, "stamp_ns");
  refuse([](auto& o) { o.set_stamp_ns(std::numeric_limits<std::int64_t>::min()); }, "stamp_ns");
  refuse([](auto& o) { o.clear_world_from_object(); }, "world_from_object");
  refuse([](auto& o) { o.mutable_world_from_object()->mutable_rotation()->set_w(0); },
         "world_from_object.rotation");
  refuse([](auto& o) { o.mutable_world_from_object()->mutable_translation_m()->set_x(1e9); },
         "world_from_object.translation_m");
  refuse([](auto& o) { o.mutable_velocity_object(); }, "velocity_object.angular_radps");
  refuse([](auto& o) { o.mutable_future()->add_stamps_ns(5); },
         "future.world_from_object.rotations_xyzw");
  Expect(Add(GoodObjects(4)), Code::kResourceExhausted, "objects[3].object_id");
  Expect(Add(GoodObjects(5)), Code::kResourceExhausted, "objects");
}

TEST_F(BadGiven, Removals) {
  Expect(Remove({99}), Code::kNotFound, "object_ids[0]");
  ASSERT_TRUE(Add(GoodObjects()).ok());
  Expect(Remove({10, 1}), Code::kNotFound, "object_ids[1]");
  Expect(Remove({10, 10}), Code::kNotFound, "object_ids[1]");
  Expect(Remove({1, 2, 3, 4, 5}), Code::kResourceExhausted, "object_ids");
  EXPECT_TRUE(Remove({10}).ok());
}

TEST_F(BadGiven, Futures) {
  const auto refuse = [this](const std::function<void(v1::ObjectFuture&)>& spoil,
                             const std::string& field, Code code = Code::kInvalidArgument) {
    v1::SetFuturesRequest request = GoodFuture();
    *request.add_futures() = request.futures(0);
    spoil(*request.mutable_futures(1));
    Expect(Set(request), code, "futures[1]." + field);
  };
  refuse([](auto& f) { f.set_object_id(77); }, "object_id", Code::kNotFound);
  refuse([](auto& f) { f.mutable_future()->set_stamps_ns(0, 0); }, "future.stamps_ns[0]");
  refuse([](auto& f) { f.mutable_future()->set_stamps_ns(1, 11'000'000'000); },
         "future.stamps_ns[1]");
  refuse([](auto& f) { f.mutable_future()->add_stamps_ns(13'000'000'000); },
         "future.world_from_object.rotations_xyzw");
  refuse(
      [](auto& f) {
        f.mutable_future()->mutable_world_from_object()->set_translations_m(2, kInfinity);
      },
      "future.world_from_object[0]");
  v1::SetFuturesRequest many;
  for (int i = 0; i < 5; ++i) many.add_futures()->set_object_id(1);
  Expect(Set(many), Code::kResourceExhausted, "futures");
}

}  // namespace
}  // namespace clearway
