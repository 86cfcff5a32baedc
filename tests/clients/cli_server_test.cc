// The tool against a real server that has seen a small simulated drive.
#include "clients/cli_server.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "support/temporary_folder.h"

namespace clearway {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

TEST_F(CliServer, Empty) {
  EXPECT_EQ(Ask({"objects"})["objects"], json::array());
  EXPECT_EQ(Ask({"status"})["frames_applied"], 0);
  EXPECT_THAT(Clearway({"objects"}).out, HasSubstr("0 objects"));
  const Finished slice = Clearway({"occupancy", "--slice", "0"});
  EXPECT_EQ(slice.exit_code, 1);
  EXPECT_THAT(slice.err, HasSubstr("clearway: the scene is empty"));
}

// What a user is to do about TLS, and none of gRPC's own lines.
TEST(CliTls, SaysWhoExpectsIt) {
  const TemporaryFolder folder;
  const std::string cert = (folder / "cert.pem").string(), key = (folder / "key.pem").string();
  const Finished made =
      RunProgram({"/usr/bin/env", "openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt",
                  "ec_paramgen_curve:P-256", "-nodes", "-days", "2", "-subj", "/CN=localhost",
                  "-addext", "subjectAltName=IP:127.0.0.1", "-keyout", key, "-out", cert});
  if (made.exit_code != 0) GTEST_SKIP() << "openssl is missing";
  const ServerProcess with_tls({"--tls-cert", cert, "--tls-key", key}), without;
  const std::vector<std::string> trusting = {"--tls-roots", cert};
  for (const auto& [server, flags, part] :
       std::vector<std::tuple<std::string, std::vector<std::string>, std::string>>{
           {with_tls.address(), {}, "it seems to expect TLS"},
           {without.address(), trusting, "it seems not to speak TLS"}}) {
    std::vector<std::string> arguments = {"status", "--server", server, "--timeout", "2"};
    arguments.insert(arguments.end(), flags.begin(), flags.end());
    const Finished dut = RunClearway(arguments);
    EXPECT_EQ(dut.exit_code, 1);
    EXPECT_THAT(dut.err, StartsWith("clearway: a server answers at " + server + ", but " + part));
    EXPECT_THAT(dut.err, HasSubstr("--tls-roots names the root certificates"));
    EXPECT_THAT(dut.err, Not(HasSubstr("no server answers")));
    EXPECT_THAT(dut.err, Not(HasSubstr(".cc:")));
  }
  const Finished good =
      RunClearway({"status", "--server", with_tls.address(), "--tls-roots", cert});
  EXPECT_EQ(good.exit_code, 0) << good.err;
}

TEST_F(CliServer, GivenObjectsComeAndGo) {
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "doors.json").string();
  std::ofstream(file) << R"({"objects": [
    {"id": 7, "shape": {"type": "sphere", "radius_m": 1}, "velocity_mps": [1, 0, 0]},
    {"id": 8, "shape": {"type": "box", "size_m": [1, 1, 1]}, "pose": {"position_m": [5, 0, 0]}}]})";
  const json added = Ask({"objects", "--add", file})["objects"];
  ASSERT_EQ(added.size(), 2u);
  EXPECT_EQ(added[0]["id"], 7);
  EXPECT_EQ(added[0]["given"], true);
  const Finished again = Clearway({"objects", "--add", file});
  EXPECT_EQ(again.exit_code, 1);
  EXPECT_THAT(again.err, HasSubstr("has an object 7 already"));
  const json left = Ask({"objects", "--remove", "7"})["objects"];
  ASSERT_EQ(left.size(), 1u);
  EXPECT_EQ(left[0]["id"], 8);
  EXPECT_EQ(Clearway({"objects", "--remove", "7"}).exit_code, 1);
}

TEST_F(CliServer, ListsObjects) {
  Replay();
  const json objects = Ask({"objects", "--time", "+1"})["objects"];
  ASSERT_FALSE(objects.empty());
  for (const json& object : objects) {
    EXPECT_GT(object["occupied_voxels"], 0);
    EXPECT_TRUE(object.contains("predicted"));
  }
  const std::string text = Clearway({"objects"}).out;
  for (const char* column : {"frames", "voxels", "size", "speed", "position", "last seen"}) {
    EXPECT_THAT(text, HasSubstr(column));
  }
}

TEST_F(CliServer, AnObjectOccupiesWhereItIsAndLeavesWithTime) {
  Replay();
  json object;
  const std::string point = PointInAnObject(&object);
  const json now = Ask({"occupancy", "--at", point})["points"][0];
  EXPECT_EQ(now["status"], "OCCUPIED");
  EXPECT_EQ(now["object_id"], object["id"]);
  EXPECT_THAT(Clearway({"occupancy", "--at", point}).out,
              HasSubstr("object " + object["id"].dump()));
  // Every point at every time.
  const json both =
      Ask({"occupancy", "--at", point, "--at", "0,0,0", "--time", "now", "--time", "+1"});
  ASSERT_EQ(both["points"].size(), 4u);
  EXPECT_EQ(both["points"][1]["time_ns"].get<std::int64_t>(),
            both["stamp_ns"].get<std::int64_t>() + 1'000'000'000);
}

TEST_F(CliServer, CountsTheCellsOfABox) {
  Replay();
  const json box = Ask({"occupancy", "--box", "0,-1,-1,2,1,1", "--time", "now", "--time", "+2"});
  ASSERT_EQ(box["times"].size(), 2u);
  std::uint64_t cells = 1, counted = 0;
  for (const json& count : box["cell_counts"]) cells *= count.get<std::uint64_t>();
  for (const char* status :
       {"free", "unknown_space", "beyond_horizon", "occupied", "out_of_bounds"}) {
    counted += box["times"][0][status].get<std::uint64_t>();
  }
  EXPECT_EQ(counted, cells);
}

TEST_F(CliServer, DrawsASlice) {
  Replay();
  json object;
  PointInAnObject(&object);
  const double z_m = (object["box_world"]["min_m"][2].get<double>() +
                      object["box_world"]["max_m"][2].get<double>()) /
                     2;
  const std::string id = object["id"].dump();
  const json slice = Ask({"occupancy", "--slice", std::to_string(z_m)});
  const json& rows = slice["times"][0]["rows_from_lowest_y"];
  ASSERT_EQ(rows.size(), slice["rows"].get<std::size_t>());
  EXPECT_THAT(rows.dump(), HasSubstr(id));
  const Finished picture = Clearway({"occupancy", "--slice", std::to_string(z_m)});
  EXPECT_THAT(picture.out, HasSubstr("# static"));
  EXPECT_THAT(picture.out.substr(picture.out.find("\n\n")), HasSubstr(id));
}

TEST_F(CliServer, ChecksStates) {
  Replay();
  json object;
  const std::string point = PointInAnObject(&object);
  const json hit = Ask({"check", "--robot", "sphere:0.2", "--state", point + ",0", "--state",
                        point + ",0,now", "--clearance", "1"});
  ASSERT_EQ(hit["states"].size(), 2u);
  EXPECT_EQ(hit["states"][0]["status"], "OCCUPIED");
  EXPECT_EQ(hit["states"][0]["object_id"], object["id"]);
  EXPECT_EQ(hit["states"][0]["clearance_m"], 0);
  EXPECT_EQ(hit["states"][0], hit["states"][1]);
  const json ignored = Ask({"check", "--robot", "sphere:0.2", "--state", point + ",0", "--unknown",
                            "free", "--ignore", object["id"].dump()});
  EXPECT_EQ(ignored["states"][0]["status"], "FREE");
  EXPECT_EQ(ignored["states"][0]["link"], nullptr);
}

TEST_F(CliServer, RequireFreeIsForScripts) {
  Replay();
  json object;
  const std::string point = PointInAnObject(&object);
  const Finished dut =
      Clearway({"check", "--robot", "sphere:0.2", "--state", point + ",0", "--require-free"});
  EXPECT_EQ(dut.exit_code, 1);
  EXPECT_THAT(dut.out, HasSubstr("occupied"));
  EXPECT_THAT(dut.err, HasSubstr("1 of 1 states not free"));
}

TEST_F(CliServer, ExportsMapsThatInfoReads) {
  Replay();
  const TemporaryFolder folder;
  const json status = Ask({"status"});
  for (const char* format : {"bt", "ot"}) {
    const std::string file = folder / (std::string("static.") + format);
    EXPECT_GT(Ask({"export", "--out", file})["bytes"], 0);
    const json info = json::parse(RunClearway({"info", file, "--json"}).out);
    EXPECT_EQ(info["occupied_voxels"], status["static_occupied_voxels"]);
    EXPECT_EQ(info["format"], format);
  }
}

TEST_F(CliServer, ExportsObjectsAndTheFuture) {
  Replay();
  json object;
  PointInAnObject(&object);
  const Finished ply = Clearway(
      {"export", "--what", "object:" + object["id"].dump(), "--format", "ply", "--out", "-"});
  EXPECT_EQ(ply.exit_code, 0) << ply.err;
  EXPECT_THAT(ply.out, StartsWith("ply\n"));
  EXPECT_THAT(ply.out, HasSubstr("element vertex " + object["occupied_voxels"].dump()));
  const TemporaryFolder folder;
  EXPECT_GT(Ask({"export", "--what", "scene@+0.5", "--out", folder / "scene.bt"})["bytes"], 0);
}

TEST_F(CliServer, ExportOfAnUnknownObjectLeavesNoFile) {
  const TemporaryFolder folder;
  const Finished dut = Clearway({"export", "--what", "object:99", "--out", folder / "o.ply"});
  EXPECT_EQ(dut.exit_code, 1);
  EXPECT_THAT(dut.err, HasSubstr("99"));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST_F(CliServer, ExportAndRecordReplaceFilesOnly) {
  const TemporaryFolder folder;
  const std::string pipe = folder / "map.bt", frames = folder / "pipe.cwr",
                    link = folder / "link.bt", far = folder / "far.bt";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  ASSERT_EQ(mkfifo(frames.c_str(), 0600), 0);
  const std::string why = " is a pipe, not a file";
  EXPECT_THAT(Clearway({"export", "--out", pipe}).err, HasSubstr(pipe + ":" + why));
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"record", "sim:small"}, {"simulate", "small"}}) {
    std::vector<std::string> arguments = command;
    arguments.insert(arguments.end(), {"--frames", "2", "--force", "--out", frames});
    const Finished dut = RunClearway(arguments);
    EXPECT_EQ(dut.exit_code, 1) << command[0];
    EXPECT_THAT(dut.err, HasSubstr(frames + ":" + why));
  }
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
  EXPECT_TRUE(std::filesystem::is_fifo(frames));

  folder.Write("far.bt", "old");
  std::filesystem::create_symlink(far, link);
  EXPECT_GT(Ask({"export", "--out", link})["bytes"], 0);
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_THAT(BytesOf(far), HasSubstr("Octomap"));
}

TEST_F(CliServer, APriorComesBack) {
  Replay();
  const TemporaryFolder folder;
  const std::string file = folder / "static.bt";
  Ask({"export", "--out", file});
  const json before = Ask({"status"});
  Ask({"reset"});
  EXPECT_EQ(Ask({"status"})["static_observed_voxels"], 0);
  Ask({"load-prior", file});
  EXPECT_EQ(Ask({"status"})["static_observed_voxels"], before["static_observed_voxels"]);
}

TEST_F(CliServer, ABrokenPriorIsNamed) {
  const TemporaryFolder folder;
  const std::string file = folder.Write("broken.bt", "no map");
  const Finished dut = Clearway({"load-prior", file});
  EXPECT_EQ(dut.exit_code, 1);
  EXPECT_THAT(dut.err, HasSubstr("broken.bt"));
}

TEST_F(CliServer, BenchLoadsWithPoints) {
  Replay();
  const json dut = Ask({"bench", "--points", "50", "--connections", "2", "--seconds", "0.1"});
  EXPECT_EQ(dut["connections"], 2);
  EXPECT_EQ(dut["batch"], 50);
  EXPECT_EQ(dut["box_world"], Ask({"status"})["static_box_world"]);
  EXPECT_GT(dut["calls"], 0);
  EXPECT_EQ(dut["points_per_s"], 50 * dut["calls_per_s"].get<double>());
  const json& latency = dut["latency_ms"];
  EXPECT_GT(latency["p50"], 0);
  EXPECT_LE(latency["p50"], latency["p90"]);
  EXPECT_LE(latency["p90"], latency["p99"]);
  EXPECT_LE(latency["p99"], latency["max"]);
}

TEST_F(CliServer, BenchLoadsWithStates) {
  const json dut = Ask({"bench", "--states", "5", "--robot", "sphere:0.2", "--unknown", "0.5",
                        "--bounds", "0,0,0,1,1,1", "--seconds", "0.1"});
  EXPECT_GT(dut["states_per_s"], 0);
  const Finished text = Clearway({"bench", "--points", "5", "--bounds", "0,0,0,1,1,1",
                                  "--time-step", "0", "--seconds", "0.1"});
  EXPECT_EQ(text.exit_code, 0) << text.err;
  EXPECT_THAT(text.out, StartsWith("1 connection, batches of 5 points, from (0.0, 0.0, 0.0) to "));
  EXPECT_THAT(text.out, HasSubstr("points/s\nlatency ms  p50 "));
}

TEST_F(CliServer, BenchSaysWhatIsWrong) {
  const Finished empty = Clearway({"bench"});
  EXPECT_EQ(empty.exit_code, 1);
  EXPECT_THAT(empty.err, HasSubstr("the scene is empty: replay something, or give --bounds"));
  const auto with = [this](const std::string& flag, const std::string& batch) {
    return Clearway(
        {"bench", flag, batch, "--bounds", "0,0,0,1,1,1", "--seconds", "0.1", "--time-step", "0"});
  };
  const Finished points = with("--points", "4000001"), states = with("--states", "20001");
  EXPECT_EQ(points.exit_code, 1);
  EXPECT_THAT(points.err, HasSubstr("--points 4000001: the server takes at most 4000000 at once"));
  EXPECT_EQ(states.exit_code, 1);
  EXPECT_THAT(states.err, HasSubstr("--states 20001: the server takes at most 20000 at once"));
  const Finished bytes = with("--points", "4000000");
  EXPECT_EQ(bytes.exit_code, 1);
  EXPECT_THAT(bytes.err, HasSubstr("--points 4000000: request: holds "));
}

TEST_F(CliServer, ShowsLimitsAndParameters) {
  const json info = Ask({"server-info"});
  EXPECT_GT(info["limits"]["max_points_per_frame"], 0);
  EXPECT_EQ(info["params"]["resolution_m"], 0.1);
  EXPECT_THAT(Clearway({"server-info"}).out, HasSubstr("max_points_per_frame"));
}

}  // namespace
}  // namespace clearway
