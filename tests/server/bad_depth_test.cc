// Depth images that are refused.
#include "clearway/scene/depth_image.h"
#include "server/bad_input.h"

namespace clearway {
namespace {

// A frame that would be applied: 10 x 8 pixels, of which 80 points would be; the limit is 100.
v1::Frame GoodImage() {
  DepthImage image;
  image.width = 10;
  image.height = 8;
  image.depth.assign(80, 2000);
  image.fx = image.fy = 10;
  image.instance_mask.assign(80, 1);
  image.mask_labels = {0, 1};
  v1::Frame proto;
  Write(testing_support::FrameAt(12), image, &proto);
  return proto;
}

TEST_F(BadInput, DepthImages) {
  using Code = absl::StatusCode;
  struct Case {
    const char* what;
    std::function<void(v1::DepthImage&)> spoil;
    Code code;
    const char* field;
  };
  const Case cases[] = {
      {"empty", [](auto& i) { i.Clear(); }, Code::kInvalidArgument,
       "frame.depth_image.depth_unit_m"},
      {"no fx", [](auto& i) { i.clear_fx(); }, Code::kInvalidArgument, "frame.depth_image.fx"},
      {"no width", [](auto& i) { i.clear_width(); }, Code::kInvalidArgument,
       "frame.depth_image.width"},
      {"absurd height", [](auto& i) { i.set_height(4'000'000'000); }, Code::kInvalidArgument,
       "frame.depth_image.height"},
      {"NaN", [](auto& i) { i.set_cx(kNan); }, Code::kInvalidArgument, "frame.depth_image.cx"},
      {"infinite", [](auto& i) { i.set_fy(kInfinity); }, Code::kInvalidArgument,
       "frame.depth_image.fy"},
      {"unit 0", [](auto& i) { i.set_depth_unit_m(0); }, Code::kInvalidArgument,
       "frame.depth_image.depth_unit_m"},
      {"depth cut off", [](auto& i) { i.mutable_depth()->pop_back(); }, Code::kInvalidArgument,
       "frame.depth_image.depth"},
      {"depths in two units", [](auto& i) { i.set_depth_m(std::string(320, 1)); },
       Code::kInvalidArgument, "frame.depth_image.depth_unit_m"},
      {"metres cut off",
       [](auto& i) {
         i.clear_depth();
         i.clear_depth_unit_m();
         i.set_depth_m(std::string(319, 1));
       },
       Code::kInvalidArgument, "frame.depth_image.depth_m"},
      {"mask cut off", [](auto& i) { i.mutable_instance_mask()->pop_back(); },
       Code::kInvalidArgument, "frame.depth_image.instance_mask"},
      {"mask's value", [](auto& i) { i.mutable_instance_mask()->back() = 2; },
       Code::kInvalidArgument, "frame.depth_image.instance_mask"},
      {"label", [](auto& i) { i.set_mask_labels(1, -2); }, Code::kInvalidArgument,
       "frame.depth_image.mask_labels[1]"},
      {"pixels",
       [](auto& i) {
         i.set_height(11);
         i.set_depth(std::string(220, 1));
         i.set_instance_mask(std::string(110, 1));
       },
       Code::kResourceExhausted, "frame.depth_image"},
      // Nothing of such a size is taken in to find out.
      {"pixels that are not there",
       [](auto& i) {
         i.set_width(65'535);
         i.set_height(65'535);
       },
       Code::kResourceExhausted, "frame.depth_image"},
      {"objects",
       [](auto& i) {
         for (int label = 2; label < 8; ++label) i.add_mask_labels(label);
         for (int k = 0; k < 80; ++k) (*i.mutable_instance_mask())[k] = static_cast<char>(k % 8);
       },
       Code::kResourceExhausted, "frame.labels"},
  };
  std::uint64_t sequence = 2000;
  for (const Case& bad : cases) {
    SCOPED_TRACE(bad.what);
    v1::Frame frame = GoodImage();
    frame.set_sequence(++sequence);
    bad.spoil(*frame.mutable_depth_image());
    Expect(Push(frame), bad.code, bad.field);
  }
}

TEST_F(BadInput, AFrameWithPointsAndADepthImage) {
  v1::Frame frame = GoodImage();
  frame.mutable_points_m()->Resize(3, 1);
  frame.add_labels(0);
  Expect(Push(frame), absl::StatusCode::kInvalidArgument, "frame.depth_image");
}

}  // namespace
}  // namespace clearway
