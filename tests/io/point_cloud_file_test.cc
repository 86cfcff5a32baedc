#include "clearway/io/point_cloud_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <octomap/ScanGraph.h>

#include <sstream>

#include "support/bzip2.h"
#include "support/data_folder.h"
#include "support/temporary_folder.h"

namespace clearway {
namespace {

using ::testing::HasSubstr;

std::string GraphOfTwoScans() {
  octomap::ScanGraph graph;
  auto* const first = new octomap::Pointcloud();
  first->push_back(1, 2, 3);
  first->push_back(-4, 5.5f, 6);
  auto* const second = new octomap::Pointcloud();
  second->push_back(7, 8, 9);
  graph.addNode(first, octomap::pose6d(1, 0, -0.5, 0, 0, 0.25));
  graph.addNode(second, octomap::pose6d(0, 2, 0, 0.5, 0, 0));
  graph.connectPrevious();
  std::ostringstream out;
  graph.writeBinary(out);
  return out.str();
}

TEST(PointCloudFile, Empty) {
  EXPECT_TRUE(ParseTextCloud("c.dat", "")->points_S.empty());
  EXPECT_TRUE(ParseScanGraph("c.graph", std::string(8, '\0'))->empty());
}

TEST(PointCloudFile, ReadsText) {
  const auto dut = ParseTextCloud("c.dat", "# a comment\n1 2 3\n\n  -4.5\t5e-1 6 \r\n");
  ASSERT_TRUE(dut.ok()) << dut.status();
  ASSERT_EQ(dut->points_S.size(), 2u);
  EXPECT_EQ(dut->points_S[1], Eigen::Vector3f(-4.5f, 0.5f, 6));
}

TEST(PointCloudFile, ReadsScanGraphsOfOctomap) {
  const auto dut = ParseScanGraph("c.graph", GraphOfTwoScans());
  ASSERT_TRUE(dut.ok()) << dut.status();
  ASSERT_EQ(dut->size(), 2u);
  EXPECT_EQ((*dut)[0].points_S[1], Eigen::Vector3f(-4, 5.5f, 6));
  EXPECT_EQ((*dut)[0].T_W_S.translation, Eigen::Vector3d(1, 0, -0.5));
  // A yaw of 0.25.
  EXPECT_NEAR((*dut)[0].T_W_S.rotation.z(), std::sin(0.125), 1e-6);
  EXPECT_NEAR((*dut)[1].T_W_S.rotation.x(), std::sin(0.25), 1e-6);
}

TEST(PointCloudFile, RefusesBadTextNamingTheLine) {
  for (const char* line : {"1 2\n", "1 2 3 4\n", "1 2 x\n", "1 2 nan\n", "1 2 3x\n"}) {
    const auto dut = ParseTextCloud("c.dat", std::string("0 0 0\n") + line);
    EXPECT_THAT(std::string(dut.status().message()), HasSubstr("c.dat, line 2: three finite"))
        << line;
  }
  EXPECT_THAT(std::string(ParseTextCloud("c.dat", "1 2 3").status().message()),
              HasSubstr("line 1: the line does not end"));
}

TEST(PointCloudFile, RefusesScanGraphsCutOffAtAnyByte) {
  const std::string whole = GraphOfTwoScans();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const auto dut = ParseScanGraph("c.graph", whole.substr(0, size));
    EXPECT_THAT(std::string(dut.status().message()), HasSubstr("c.graph, byte ")) << size;
  }
  EXPECT_FALSE(ParseScanGraph("c.graph", whole + "x").ok());
}

TEST(PointCloudFile, RefusesWhatIsNoScanGraph) {
  EXPECT_FALSE(ParseScanGraph("c.graph", std::string(400, '\xff')).ok());
  EXPECT_FALSE(ParseScanGraph("c.graph", "these are 4-digit words, and no graph of any kind").ok());
}

TEST(PointCloudFile, ReadsTheRealScanGraph) {
  const auto path = DataPath("octomap/spherical_scan.graph");
  if (!path) GTEST_SKIP() << "no recorded data";
  const auto dut = ReadPointClouds(*path);
  ASSERT_TRUE(dut.ok()) << dut.status();
  octomap::ScanGraph graph;
  ASSERT_TRUE(graph.readBinary(path->string()));
  ASSERT_EQ(dut->size(), graph.size());
  const octomap::Pointcloud& expected = *(*graph.begin())->scan;
  ASSERT_EQ(dut->front().points_S.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const octomap::point3d& p = expected[static_cast<unsigned>(i)];
    ASSERT_EQ(dut->front().points_S[i], Eigen::Vector3f(p.x(), p.y(), p.z()));
  }
}

TEST(PointCloudFile, ReadsTheRealScan) {
  const auto path = DataPath("octomap/scan.dat.bz2");
  if (!path) GTEST_SKIP() << "no recorded data";
  const auto text = Bunzip2(*path);
  ASSERT_TRUE(text.has_value());
  const auto dut = ParseTextCloud("scan.dat", *text);
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->points_S.size(), 88'206u);
}

}  // namespace
}  // namespace clearway
