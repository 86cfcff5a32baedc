#include "server/config.h"

#include <gtest/gtest.h>

#include "support/temporary_folder.h"

namespace clearway {
namespace {

ServerConfig Read(const std::vector<std::string>& arguments,
                  const std::vector<std::string>& environment = {}) {
  const auto dut = ReadCommandLine(arguments, environment);
  EXPECT_TRUE(dut.ok()) << dut.status();
  return dut.ok() ? dut->config : ServerConfig{};
}

std::string Refusal(const std::vector<std::string>& arguments,
                    const std::vector<std::string>& environment = {}) {
  const auto dut = ReadCommandLine(arguments, environment);
  EXPECT_TRUE(absl::IsInvalidArgument(dut.status())) << dut.status();
  return std::string(dut.status().message());
}

TEST(ServerConfig, Empty) {
  const ServerConfig dut = Read({});
  EXPECT_EQ(dut.listen, "127.0.0.1:50151");
  EXPECT_EQ(dut.scene, SceneParams());
  EXPECT_EQ(dut.limits, ServerLimits());
}

TEST(ServerConfig, FlagsBeatEnvironmentBeatsFileBeatsDefaults) {
  const TemporaryFolder folder;
  const std::string file =
      folder.Write("c.toml", "threads = 3\n[scene]\nresolution_m = 0.3\nhorizon_s = 3\n").string();
  const std::vector<std::string> environment = {"CLEARWAY_SCENE_RESOLUTION_M=0.2",
                                                "CLEARWAY_SCENE_HORIZON_S=2", "HOME=/"};
  const ServerConfig dut = Read({"--config", file, "--scene-resolution-m", "0.15"}, environment);
  EXPECT_EQ(dut.scene.resolution_m, 0.15);
  EXPECT_EQ(dut.scene.horizon, std::chrono::seconds(2));
  EXPECT_EQ(dut.threads, 3);
  EXPECT_EQ(dut.scene.object_resolution_m, 0.1);
}

TEST(ServerConfig, TheFileCanComeFromTheEnvironment) {
  const TemporaryFolder folder;
  const std::string file = folder.Write("c.toml", "threads = 5\n").string();
  EXPECT_EQ(Read({}, {"CLEARWAY_CONFIG=" + file}).threads, 5);
}

TEST(ServerConfig, PrintedAsTomlItReadsBackTheSame) {
  ServerConfig config =
      Read({"--listen", "unix:/tmp/a b\"c", "--scene-resolution-m", "0.1234567",
            "--limits-max-robots", "7", "--scene-solid", "completed_hull", "--scene-motion",
            "track", "--scene-discretize", "true", "--scene-self-filter-m",
            "-1 -1 -1 1 1 1 2 2 2 3 3 3", "--scene-bounds-m", "-9,-9,-9,9,9,9"});
  EXPECT_EQ(config.scene.self_filter_S.size(), 2u);
  const TemporaryFolder folder;
  const std::string file = folder.Write("c.toml", ToToml(config)).string();
  const ServerConfig dut = Read({"--config", file});
  EXPECT_EQ(dut.listen, config.listen);
  EXPECT_EQ(dut.scene, config.scene);
  EXPECT_EQ(dut.limits, config.limits);
}

TEST(ServerConfig, EverySettingReadsBackFromItsOwnText) {
  const ServerConfig defaults;
  for (const Setting& setting : Settings()) {
    ServerConfig dut;
    std::string text = setting.get(defaults);
    if (text.front() == '"') text = text.substr(1, text.size() - 2);
    EXPECT_TRUE(setting.set(dut, text).ok()) << setting.key << " = " << text;
    EXPECT_EQ(setting.get(dut), setting.get(defaults)) << setting.key;
  }
}

TEST(ServerConfig, HelpNamesEverySettingAndAnExample) {
  const auto dut = ReadCommandLine({"--help"}, {});
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_NE(dut->help.find("Example:"), std::string::npos);
  for (const Setting& setting : Settings()) {
    EXPECT_NE(dut->help.find(setting.FlagName()), std::string::npos) << setting.key;
  }
}

TEST(ServerConfig, HelpListsWhatASettingMayBe) {
  const std::string help = ReadCommandLine({"--help"}, {})->help;
  for (const char* values : {"last or track: extrapolate", "convex_hull, completed_hull or voxels",
                             "trace, debug, info, warning, error or off"}) {
    EXPECT_NE(help.find(values), std::string::npos) << values;
  }
}

TEST(ServerConfig, PrintConfigIsAskedFor) {
  EXPECT_TRUE(ReadCommandLine({"--print-config"}, {})->print_config);
}

TEST(ServerConfig, RefusesUnknownFlagsAndKeysOfTheFile) {
  const TemporaryFolder folder;
  const std::string file = folder.Write("c.toml", "[scene]\nresolution = 0.1\n").string();
  EXPECT_NE(Refusal({"--config", file}).find("scene.resolution"), std::string::npos);
  EXPECT_NE(Refusal({"--scene-resolution", "1"}).find("--scene-resolution"), std::string::npos);
}

TEST(ServerConfig, RefusesBadValuesNamingTheKey) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"--scene-resolution-m", "x"}, "scene.resolution_m"},
      {{"--scene-resolution-m", "0"}, "scene.resolution_m"},
      {{"--scene-resolution-m", "nan"}, "scene.resolution_m"},
      {{"--scene-clamp-min", "0.7"}, "scene."},
      {{"--scene-horizon-s", "-1"}, "scene.horizon_s"},
      {{"--scene-solid", "jelly"}, "scene.solid"},
      {{"--scene-motion", "first"}, "scene.motion"},
      {{"--scene-bounds-m", "1 2 3"}, "scene.bounds_m"},
      {{"--threads", "-1"}, "threads"},
      {{"--writer-niceness", "20"}, "writer_niceness"},
      {{"--keepalive-time-s", "0.5"}, "keepalive.time_s"},
      {{"--keepalive-time-s", "3601"}, "keepalive.time_s"},
      {{"--keepalive-timeout-s", "0"}, "keepalive.timeout_s"},
      {{"--keepalive-timeout-s", "601"}, "keepalive.timeout_s"},
      {{"--keepalive-min-client-ping-s", "0.05"}, "keepalive.min_client_ping_s"},
      {{"--keepalive-min-client-ping-s", "nan"}, "keepalive.min_client_ping_s"},
      {{"--limits-max-robots", "0"}, "limits.max_robots"},
      {{"--limits-max-robots", "-1"}, "limits.max_robots"},
      {{"--limits-max-message-bytes", "5000000000"}, "limits.max_message_bytes"},
      {{"--log-level", "loud"}, "log_level"},
      {{"--listen", ""}, "listen"},
      {{"--listen", "nonsense"}, "listen"},
      {{"--listen", "localhost:70000"}, "listen"},
      {{"--tls-cert", "a.pem"}, "tls_key"},
  };
  for (const auto& [arguments, key] : cases) {
    const std::string message = Refusal(arguments);
    EXPECT_EQ(message.rfind(key, 0), 0u) << message;
  }
}

TEST(ServerConfig, RefusesAFileThatIsNotToml) {
  const TemporaryFolder folder;
  EXPECT_NE(Refusal({"--config", folder.Write("c.toml", "a = [").string()}).find("c.toml"),
            std::string::npos);
  EXPECT_FALSE(Refusal({"--config", (folder / "missing.toml").string()}).empty());
  EXPECT_FALSE(Refusal({"--config", (folder / "").string()}).empty());
}

TEST(ServerConfig, AddressesThatOthersReachNeedTls) {
  for (const char* local :
       {"127.0.0.1:0", "ipv4:127.0.0.2:0", "localhost:1", "[::1]:5", "unix:/tmp/x"}) {
    EXPECT_TRUE(ReadCommandLine({"--listen", local}, {}).ok()) << local;
  }
  for (const char* open :
       {"0.0.0.0:1", "[::]:1", "127.example.org:1", "10.0.0.1:1", "example.org:1"}) {
    EXPECT_EQ(Refusal({"--listen", open}).rfind("listen", 0), 0u) << open;
    EXPECT_TRUE(ReadCommandLine({"--listen", open, "--tls-cert", "c", "--tls-key", "k"}, {}).ok());
  }
}

}  // namespace
}  // namespace clearway
