// What the pictures show, read back from the files.
#include <cairo/cairo.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <memory>

#include "clearway/report/object_sheet.h"
#include "clearway/report/top_view.h"
#include "report/color.h"
#include "report/name_painter.h"
#include "report/test_scene.h"

namespace clearway {
namespace {

namespace palette = report::palette;

class Picture {
 public:
  explicit Picture(const std::string& file)
      : surface_(cairo_image_surface_create_from_png(file.c_str()), cairo_surface_destroy) {}

  bool ok() const { return cairo_surface_status(surface_.get()) == CAIRO_STATUS_SUCCESS; }
  int width() const { return cairo_image_surface_get_width(surface_.get()); }
  int height() const { return cairo_image_surface_get_height(surface_.get()); }

  std::uint32_t At(int x, int y) const {
    const auto* row = reinterpret_cast<const std::uint32_t*>(
        cairo_image_surface_get_data(surface_.get()) +
        static_cast<std::ptrdiff_t>(y) * cairo_image_surface_get_stride(surface_.get()));
    return row[x] | 0xff000000u;
  }

 private:
  std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface_;
};

// Whether no channel differs by more than `tolerance`.
bool Near(std::uint32_t a, std::uint32_t b, int tolerance) {
  for (int shift = 0; shift < 24; shift += 8) {
    const int difference = static_cast<int>(a >> shift & 255) - static_cast<int>(b >> shift & 255);
    if (std::abs(difference) > tolerance) return false;
  }
  return true;
}

// Tests may run at once: each has files of its own.
std::string FileFor(const char* name) {
  const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
  return (std::filesystem::path(testing::TempDir()) / (test + "_" + name)).string();
}

// The picture of an area of 10 x 10 m, and where its map lies in it.
constexpr int kWidthPx = 1396;  // the map is 1000 px wide
constexpr double kLeftPx = 32, kTopPx = 92;

Picture TopViewOf(const SceneSnapshot& scene, TopViewOptions options) {
  options.width_px = kWidthPx;
  options.area_W = Aabb{{-4, -5, 0}, {6, 5, 0}};
  const std::string file = FileFor("top.png");
  EXPECT_TRUE(WriteTopView(scene, options, file).ok());
  return Picture(file);
}

std::uint32_t PixelAt(const Picture& picture, double x_m, double y_m) {
  return picture.At(static_cast<int>(kLeftPx + (x_m + 4) * 100),
                    static_cast<int>(kTopPx + (5 - y_m) * 100));
}

TEST(TopView, Empty) {
  const Picture dut = TopViewOf(SceneSnapshot::Empty(SceneParams{}), {});
  ASSERT_TRUE(dut.ok());
  EXPECT_EQ(dut.width(), kWidthPx);
  EXPECT_EQ(PixelAt(dut, 0.05, 0.05), palette::kUnknown.Rgb24());
}

TEST(TopView, ShowsGroundWallUnknownAndObjectInTheirPlaces) {
  const Picture dut = TopViewOf(TestScene(), {});
  EXPECT_EQ(PixelAt(dut, 0.05, 0.05), report::HeightColor(0, 3).Rgb24());
  EXPECT_EQ(PixelAt(dut, 2.05, 2.05), report::HeightColor(1.9, 3).Rgb24());
  EXPECT_EQ(PixelAt(dut, 5.55, 0.05), palette::kUnknown.Rgb24());
  EXPECT_TRUE(Near(PixelAt(dut, -2.6, 0.05),
                   Mix(report::HeightColor(0, 3), palette::kResting, 0.9).Rgb24(), 3));
}

TEST(TopView, AMovingObjectHasItsOwnColour) {
  SceneSnapshot scene = TestScene();
  MovingObject object = *scene.objects[0];
  const Picture before = TopViewOf(scene, {});
  object.velocity_O = Twist{Eigen::Vector3d::Zero(), {2, 0, 0}};
  scene.objects[0] = std::make_shared<MovingObject>(object);
  const Picture dut = TopViewOf(scene, {});
  EXPECT_NE(PixelAt(before, -2.6, 0.05), PixelAt(dut, -2.6, 0.05));
}

TEST(TopView, DynamicSpaceHasAColourOfItsOwn) {
  SceneSnapshot scene = TestScene();
  const VoxelKey key = scene.static_map_W.grid().KeyOf({0.05, 0.05, 0.05});
  scene.static_map_W.Set(key, 4000);
  scene.dynamic_W = DynamicSpace({{key, scene.stamp, scene.stamp}});
  const Picture dut = TopViewOf(scene, {});
  EXPECT_EQ(PixelAt(dut, 0.05, 0.05), palette::kDynamic.Rgb24());
  EXPECT_EQ(PixelAt(dut, 0.25, 0.05), report::HeightColor(0, 3).Rgb24());
}

TEST(TopView, PredictionsAndPathsShareTheColourOfTheirTime) {
  SceneSnapshot scene = TestScene();
  MovingObject object = *scene.objects[0];
  object.velocity_O = Twist{Eigen::Vector3d::Zero(), {1, 0, 0}};
  scene.objects[0] = std::make_shared<MovingObject>(object);
  TopViewOptions options;
  options.predicted_after = {FromSeconds(2)};
  options.paths.push_back({"plan",
                           {{scene.stamp, Pose::Translation(-3, 3, 0)},
                            {scene.stamp + FromSeconds(4), Pose::Translation(1, 3, 0)}}});
  const Picture dut = TopViewOf(scene, options);
  EXPECT_TRUE(Near(PixelAt(dut, -1.0, 3), report::TimeColor(0.5).Rgb24(), 6));
  // The predicted box, 2 s on, spans x from -1 to 1: its right edge is at x = 1.
  EXPECT_TRUE(Near(PixelAt(dut, 1.0, 0.05), report::TimeColor(0.5).Rgb24(), 70));
  EXPECT_EQ(PixelAt(dut, 1.3, 0.05), report::HeightColor(0, 3).Rgb24());
}

TEST(TopView, RefusesAFileItCannotWrite) {
  const absl::Status status = WriteTopView(TestScene(), {}, "/nonexistent/top.png");
  EXPECT_EQ(status.code(), absl::StatusCode::kInternal);
  EXPECT_NE(std::string(status.message()).find("/nonexistent/top.png"), std::string::npos);
}

// The names of what lies at a map's middle, 20 pixels wide, with or without much above and below.
Picture NamesAmongOthers(bool among_others) {
  report::Canvas canvas(400, 400);
  const report::MapView view(Aabb{{0, 0, 0}, {4, 4, 0}}, {0, 0}, 400);
  const auto rect = [](double x0, double y0, double x1, double y1) -> Polygon {
    return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
  };
  std::vector<report::NamedOutline> outlines{{rect(190, 190, 210, 210), "named"}};
  if (among_others) {
    outlines.push_back({rect(100, 140, 300, 188), ""});
    outlines.push_back({rect(100, 212, 300, 260), ""});
  }
  report::DrawNames(canvas, view, outlines);
  const std::string file = FileFor(among_others ? "among.png" : "alone.png");
  EXPECT_TRUE(canvas.WritePng(file).ok());
  return Picture(file);
}

TEST(TopView, ALineLeadsFromANameThatIsNotBesideWhatItNames) {
  EXPECT_EQ(NamesAmongOthers(false).At(200, 196), palette::kPaper.Rgb24());
  EXPECT_TRUE(Near(NamesAmongOthers(true).At(200, 160), palette::kInk.Rgb24(), 90));
}

TEST(ObjectSheet, Empty) {
  const std::string file = FileFor("empty_sheet.png");
  ASSERT_TRUE(WriteObjectSheet(SceneSnapshot::Empty(SceneParams{}), {}, file).ok());
  EXPECT_TRUE(Picture(file).ok());
}

TEST(ObjectSheet, GrowsByARowForEachObject) {
  SceneSnapshot scene = TestScene();
  const std::string file = FileFor("sheet.png");
  ASSERT_TRUE(WriteObjectSheet(scene, {}, file).ok());
  const int one = Picture(file).height();
  scene.objects.push_back(BoxObject(9, {2, 1, 1}, Pose{}, scene.stamp));
  ASSERT_TRUE(WriteObjectSheet(scene, {}, file).ok());
  EXPECT_GT(Picture(file).height(), one + 100);
}

TEST(ObjectSheet, OfVeryManyObjectsShowsAsManyAsFit) {
  SceneSnapshot scene = TestScene();
  scene.objects.clear();
  for (ObjectId id = 1; id <= 150; ++id) {
    scene.objects.push_back(BoxObject(id, {2, 1, 1}, Pose{}, scene.stamp));
  }
  const std::string file = FileFor("many.png");
  ASSERT_TRUE(WriteObjectSheet(scene, {}, file).ok());
  EXPECT_GT(Picture(file).height(), 20000);
}

TEST(ObjectSheet, AnObjectWithoutVoxelsIsARowOfTextAlone) {
  SceneSnapshot scene = TestScene();
  MovingObject empty;
  empty.id = 8;
  empty.history = {{scene.stamp, Pose{}}};
  scene.objects = {std::make_shared<MovingObject>(WithMap(std::move(empty), VoxelMap(0.1)))};
  EXPECT_TRUE(WriteObjectSheet(scene, {}, FileFor("row.png")).ok());
}

TEST(ObjectSheet, AGivenObjectIsDrawnAsItsHull) {
  SceneSnapshot scene = TestScene();
  MovingObject given;
  given.id = 8;
  given.history = {{scene.stamp, Pose{}}};
  given.given_shape = std::make_shared<const Shape>(Cylinder{0.3, 1.8});
  given.solid = SolidOf(*given.given_shape);
  scene.objects = {std::make_shared<MovingObject>(std::move(given))};
  const std::string file = FileFor("given.png");
  ASSERT_TRUE(WriteObjectSheet(scene, {}, file).ok());
  EXPECT_GT(Picture(file).height(), 200);
}

// A ball of certain voxels among some that one scan hit; and all of those alone.
TEST(ObjectSheet, WhatFewScansHitIsPale) {
  const auto pale_in = [](bool has_certain) {
    SceneSnapshot scene = TestScene();
    MovingObject object;
    object.id = 8;
    object.history = {{scene.stamp, Pose{}}};
    VoxelMap map_O(0.1);
    const OccupancyModel& model = map_O.model();
    for (int i = 0; i < 1000; ++i) {
      const VoxelKey key{i % 10, i / 10 % 10, i / 100};
      map_O.Set(key, has_certain && key.x < 5 ? model.clamp_max : model.hit);
    }
    scene.objects = {std::make_shared<MovingObject>(WithMap(std::move(object), map_O))};
    const std::string file = FileFor("pale.png");
    EXPECT_TRUE(WriteObjectSheet(scene, {}, file).ok());
    const Picture picture(file);
    int count = 0;
    for (int y = 0; y < picture.height(); ++y) {
      for (int x = 0; x < picture.width(); ++x) count += Near(picture.At(x, y), 0xe4f0ee, 1);
    }
    return count;
  };
  EXPECT_GT(pale_in(true), 10'000);
  EXPECT_LT(pale_in(false), 100);
}

TEST(ObjectSheet, RefusesAnUnknownObject) {
  ObjectSheetOptions options;
  options.objects = {7, 8};
  const absl::Status status = WriteObjectSheet(TestScene(), options, FileFor("none.png"));
  EXPECT_EQ(status.code(), absl::StatusCode::kNotFound);
}

}  // namespace
}  // namespace clearway
