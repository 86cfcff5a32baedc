#include "server/config.h"

#include <gmock/gmock.h>

#include <tuple>

#include "absl/strings/str_cat.h"
#include "support/temporary_folder.h"

namespace clearway {
namespace {

using ::testing::EndsWith;

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

// Each number's range is checked where it is read, whatever type holds it afterwards.
TEST(ServerConfig, RefusesNumbersOutOfRangeNamingKeyValueAndRange) {
  const TemporaryFolder folder;
  const std::tuple<std::string, std::string, std::string> cases[] = {
      {"limits.max_calls", "2147483647", "1 and 65536"},
      {"limits.max_calls", "4294967295", "1 and 65536"},
      {"limits.max_calls", "0", "1 and 65536"},
      {"limits.max_calls", "-1", "1 and 65536"},
      {"limits.max_calls", "99999999999999999999999999", "1 and 65536"},
      {"limits.max_plans", "18446744073709551615", "1 and 65536"},
      {"limits.max_message_bytes", "1073741825", "1 and 1073741824"},
      {"limits.max_blocks", "18446744073709551615", "1 and 1e+09"},
      {"limits.max_coordinate_m", "1000001", "0.001 and 1e+06"},
      {"limits.max_coordinate_m", "inf", "0.001 and 1e+06"},
      {"limits.max_lease_ttl_s", "1e300", "0.001 and 1e+06"},
      {"limits.max_planning_s", "-1", "0.001 and 1e+06"},
      {"limits.late_window_s", "10.1", "0 and 10"},
      {"limits.max_stamp_jump_s", "0", "0.001 and 1e+09"},
      {"threads", "4294967297", "0 and 256"},
      {"threads", "257", "0 and 256"},
      {"kept_versions", "10001", "0 and 10000"},
      {"scene.horizon_s", "86401", "0 and 86400"},
      {"scene.history_s", "1e12", "0 and 86400"},
      {"scene.object_resolution_m", "101", "0.001 and 100"},
      {"scene.sensor_pose_error_rad", "1.5", "0 and 1"},
  };
  for (const auto& [key, value, range] : cases) {
    SCOPED_TRACE(absl::StrCat(key, " = ", value));
    const Setting* setting = nullptr;
    for (const Setting& candidate : Settings()) {
      if (candidate.key == key) setting = &candidate;
    }
    ASSERT_NE(setting, nullptr);
    const std::string expected = absl::StrCat(key, ": is ", value, "; it must lie between ", range);
    EXPECT_EQ(Refusal({absl::StrCat(setting->FlagName(), "=", value)}), expected);
    EXPECT_EQ(Refusal({}, {absl::StrCat(setting->EnvironmentName(), "=", value)}),
              absl::StrCat(expected, " (set by ", setting->EnvironmentName(), ")"));
    const std::size_t dot = key.find('.');
    const std::string section =
        dot == std::string::npos ? "" : absl::StrCat("[", key.substr(0, dot), "]\n");
    const std::string name = dot == std::string::npos ? key : key.substr(dot + 1);
    const auto file = folder.Write("c.toml", absl::StrCat(section, name, " = \"", value, "\"\n"));
    EXPECT_EQ(Refusal({"--config", file.string()}),
              absl::StrCat(expected, " (set by ", file.string(), ")"));
  }
}

TEST(ServerConfig, TheEndsOfARangeAreAccepted) {
  const ServerConfig dut = Read({"--limits-max-calls", "65536", "--limits-late-window-s", "0",
                                 "--limits-max-stamp-jump-s", "1e9", "--threads", "256"});
  EXPECT_EQ(dut.limits.max_calls, 65'536u);
  EXPECT_EQ(dut.limits.late_window_s, 0);
  EXPECT_EQ(dut.threads, 256);
}

TEST(ServerConfig, AConfigurationThatIsNotReadIsCheckedToo) {
  ServerConfig config;
  config.limits.max_calls = 4'294'967'295;
  EXPECT_EQ(Validate(config).message(),
            "limits.max_calls: is 4294967295; it must lie between 1 and 65536");
}

TEST(ServerConfig, RefusesBoxesThatAreNone) {
  for (const char* box : {"0 0 0 1 1 nan", "0 0 0 1 1 inf", "0 0 2 1 1 1"}) {
    EXPECT_EQ(Refusal({"--scene-bounds-m", box}).rfind("scene.bounds_m: \"", 0), 0u);
    EXPECT_EQ(Refusal({"--scene-keep-out-m", box}).rfind("scene.keep_out_m: \"", 0), 0u);
  }
}

TEST(ServerConfig, ProbabilitiesExcludeTheirLimits) {
  EXPECT_EQ(Refusal({"--scene-probability-hit", "0.5"}),
            "scene.probability_hit: is 0.5; it must be above 0.5 and below 0.9996");
  EXPECT_EQ(Refusal({"--scene-probability-miss", "0.5"}),
            "scene.probability_miss: is 0.5; it must be above 4e-04 and below 0.5");
  EXPECT_TRUE(ReadCommandLine({"--scene-probability-hit", "0.51"}, {}).ok());
}

TEST(ServerConfig, RefusesAFileThatIsNotToml) {
  const TemporaryFolder folder;
  EXPECT_NE(Refusal({"--config", folder.Write("c.toml", "a = [").string()}).find("c.toml"),
            std::string::npos);
  const auto missing = ReadCommandLine({"--config", (folder / "missing.toml").string()}, {});
  EXPECT_THAT(std::string(missing.status().message()), EndsWith("missing.toml: no such file"));
  EXPECT_THAT(Refusal({"--config", (folder / "").string()}), EndsWith("is a folder"));
}

TEST(ServerConfig, AFilesBadValuesAreRefusedNamingIt) {
  const TemporaryFolder folder;
  for (const auto& [text, message] : std::vector<std::pair<std::string, std::string>>{
           {"[scene]\nkeep_out_m = [[0,0,0,1,1],[1,2,2,2,3,3,3]]\n",
            "scene.keep_out_m[0]: has 5 numbers; a box is a list of six: minimum, maximum"},
           {"[scene]\nkeep_out_m = [[0,0,0,1,1,1],2]\n",
            "scene.keep_out_m[1]: is no list; a box is a list of six: minimum, maximum"},
           {"[limit]\n", "limit is not a key of the configuration"},
           {"[scene]\nresolution = 1\n", "scene.resolution is not a key of the configuration"},
           {"threads = -1\n", "threads: is -1; it must lie between 0 and 256"}}) {
    const std::string file = folder.Write("c.toml", text).string();
    EXPECT_EQ(Refusal({"--config", file}), message + " (set by " + file + ")");
  }
  const std::string file = folder.Write("c.toml", "threads = -1\n").string();
  EXPECT_THAT(Refusal({"--config", file, "--threads", "-2"}), EndsWith(" and 256"));
}

TEST(ServerConfig, AFilesNumbersMayBeWrittenAsTomlAllows) {
  const TemporaryFolder folder;
  const std::string file = folder
                               .Write("c.toml",
                                      "threads = 0b11\n[limits]\nmax_calls = 0x20\n"
                                      "max_robots = 0o17\nmax_points_per_frame = 1_000\n")
                               .string();
  const ServerConfig dut = Read({"--config", file});
  EXPECT_EQ(dut.threads, 3);
  EXPECT_EQ(dut.limits.max_calls, 32u);
  EXPECT_EQ(dut.limits.max_robots, 15u);
  EXPECT_EQ(dut.limits.max_points_per_frame, 1000u);
}

TEST(ServerConfig, AddressesThatOthersReachNeedTls) {
  for (const char* local :
       {"127.0.0.1:0", "ipv4:127.0.0.2:0", "localhost:1", "[::1]:5", "unix:/tmp/x"}) {
    EXPECT_TRUE(ReadCommandLine({"--listen", local}, {}).ok()) << local;
  }
  EXPECT_THAT(Refusal({"--listen", "nobody.invalid:1"}),
              testing::StartsWith("listen: cannot resolve host nobody.invalid: "));
  for (const char* open :
       {"0.0.0.0:1", "[::]:1", "127.example.org:1", "10.0.0.1:1", "example.org:1"}) {
    EXPECT_EQ(Refusal({"--listen", open}).rfind("listen", 0), 0u) << open;
    EXPECT_TRUE(ReadCommandLine({"--listen", open, "--tls-cert", "c", "--tls-key", "k"}, {}).ok());
  }
}

}  // namespace
}  // namespace clearway
