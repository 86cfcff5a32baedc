#include "cli/svg_plot.h"

#include <gmock/gmock.h>

#include <cmath>
#include <pugixml.hpp>
#include <sstream>

namespace clearway::cli {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

pugi::xml_document Parsed(const Plot& plot) {
  pugi::xml_document document;
  const auto result = document.load_string(SvgOf(plot).c_str());
  EXPECT_TRUE(result) << result.description();
  return document;
}

std::vector<std::pair<double, double>> PointsOf(const pugi::xml_node& polyline) {
  std::vector<std::pair<double, double>> points;
  std::istringstream in(polyline.attribute("points").value());
  double x, y;
  char comma;
  while (in >> x >> comma >> y) points.emplace_back(x, y);
  return points;
}

TEST(SvgPlot, LinesGoFromTheOriginToTheCorner) {
  const auto document = Parsed({"t", "x", "y", {{"line", {{0, 0}, {2, 5}, {4, 10}}}}});
  const auto points = PointsOf(document.child("svg").child("polyline"));
  ASSERT_EQ(points.size(), 3u);
  EXPECT_LT(points[0].first, points[2].first);
  EXPECT_GT(points[0].second, points[2].second);  // y goes down
  EXPECT_NEAR(points[1].first, (points[0].first + points[2].first) / 2, 0.1);
  EXPECT_NEAR(points[1].second, (points[0].second + points[2].second) / 2, 0.1);
}

TEST(SvgPlot, TicksAreRound) {
  std::vector<std::string> texts;
  for (const auto& text : Parsed({"t", "x", "y", {{"line", {{0, 0}, {1, 23}}}}}).child("svg")) {
    if (text.attribute("text-anchor").value() == std::string("end")) {
      texts.push_back(text.child_value());
    }
  }
  EXPECT_THAT(texts, ElementsAre("0", "5", "10", "15", "20", "25"));
}

TEST(SvgPlot, OfNothingIsEmptyAxes) {
  EXPECT_TRUE(Parsed({"t", "x", "y", {}}).child("svg"));
  EXPECT_TRUE(Parsed({"t", "x", "y", {{"none", {}}, {"zero", {{0, 0}}}}}).child("svg"));
  EXPECT_THAT(SvgOf({"t", "x", "y", {}}), Not(HasSubstr("nan")));
}

TEST(SvgPlot, NamesMayHoldAnything) {
  const auto document = Parsed({"a < b & 'c'", "x", "y", {{"\"<i>\"", {{1, 1}}}}});
  EXPECT_STREQ(document.child("svg").child("text").child_value(), "a < b & 'c'");
}

}  // namespace
}  // namespace clearway::cli
