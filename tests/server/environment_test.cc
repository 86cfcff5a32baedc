#include "server/environment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "server/config.h"

namespace clearway {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;

TEST(Environment, Empty) {
  const EnvironmentValues dut = ReadEnvironment({});
  EXPECT_THAT(dut.values, IsEmpty());
  EXPECT_THAT(dut.warnings, IsEmpty());
  EXPECT_EQ(dut.config_file, "");
}

TEST(Environment, ReadsKeys) {
  const EnvironmentValues dut =
      ReadEnvironment({"CLEARWAY_THREADS=3", "CLEARWAY_CONFIG=a=b.toml", "HOME=/", "CLEARWAY=x"});
  EXPECT_THAT(dut.values, ElementsAre(Pair("threads", "3")));
  EXPECT_EQ(dut.config_file, "a=b.toml");
  EXPECT_THAT(dut.warnings, IsEmpty());
}

TEST(Environment, OtherPartsOfClearwayHaveNamesOfTheirOwn) {
  EXPECT_THAT(ReadEnvironment({"CLEARWAY_ADDRESS=a:1", "CLEARWAY_DATA=/d"}).warnings, IsEmpty());
}

// What Kubernetes gives to every container for services named clearway, clearway-listen and
// clearway-address, and Docker for a link.
TEST(Environment, LinksToServicesAreIgnoredTogether) {
  const EnvironmentValues dut = ReadEnvironment(
      {"CLEARWAY_SERVICE_HOST=10.0.0.1", "CLEARWAY_SERVICE_PORT=50151",
       "CLEARWAY_SERVICE_PORT_GRPC=50151", "CLEARWAY_PORT=tcp://10.0.0.1:50151",
       "CLEARWAY_PORT_50151_TCP=tcp://10.0.0.1:50151", "CLEARWAY_PORT_50151_TCP_PROTO=tcp",
       "CLEARWAY_PORT_50151_TCP_PORT=50151", "CLEARWAY_PORT_50151_TCP_ADDR=10.0.0.1",
       "CLEARWAY_LISTEN_SERVICE_HOST=10.0.0.2", "CLEARWAY_LISTEN_PORT=tcp://10.0.0.2:1",
       "CLEARWAY_ADDRESS_PORT=tcp://10.0.0.3:1", "CLEARWAY_NAME=/app/clearway",
       "CLEARWAY_ENV_PATH=/bin"});
  EXPECT_THAT(dut.values, IsEmpty());
  ASSERT_EQ(dut.warnings.size(), 1u);
  for (const char* name : {"CLEARWAY_SERVICE_HOST", "CLEARWAY_PORT_50151_TCP_ADDR",
                           "CLEARWAY_LISTEN_PORT", "CLEARWAY_ADDRESS_PORT", "CLEARWAY_ENV_PATH"}) {
    EXPECT_THAT(dut.warnings[0], HasSubstr(name));
  }
}

TEST(Environment, OneLinkIsWrittenOfInTheSingular) {
  EXPECT_THAT(ReadEnvironment({"CLEARWAY_PORT=tcp://10.0.0.1:50151"}).warnings,
              ElementsAre("environment: CLEARWAY_PORT looks like an orchestrator's link to a "
                          "service and is ignored"));
}

TEST(Environment, AConfigurationFileThatIsNotThereIsBlamedOnTheVariable) {
  const std::string variable = "CLEARWAY_CONFIG=/nonexistent/c.toml";
  EXPECT_THAT(std::string(ReadCommandLine({}, {variable}).status().message()),
              HasSubstr("/nonexistent/c.toml: no such file (set by CLEARWAY_CONFIG)"));
  EXPECT_THAT(
      std::string(ReadCommandLine({"--config", "/other.toml"}, {variable}).status().message()),
      testing::Not(HasSubstr("CLEARWAY_CONFIG")));
}

TEST(Environment, MisspeltKeysAreWarningsWithTheNearestName) {
  for (const auto& [name, nearest] : std::vector<std::pair<std::string, std::string>>{
           {"CLEARWAY_SCENE_RESOLUTION", "CLEARWAY_SCENE_RESOLUTION_M"},
           {"CLEARWAY_THREAD", "CLEARWAY_THREADS"},
           {"CLEARWAY_TLS_CERTS", "CLEARWAY_TLS_CERT"},
           {"CLEARWAY_ADRESS", "CLEARWAY_ADDRESS"}}) {
    const EnvironmentValues dut = ReadEnvironment({name + "=1"});
    EXPECT_THAT(dut.values, IsEmpty());
    EXPECT_THAT(dut.warnings, ElementsAre(AllOf(HasSubstr(name + " is not a setting"),
                                                HasSubstr("did you mean " + nearest + "?"))));
  }
  EXPECT_THAT(ReadEnvironment({"CLEARWAY_COLOUR=red"}).warnings,
              ElementsAre(testing::Not(HasSubstr("did you mean"))));
}

TEST(Environment, NamesDoNotCommandTheTerminal) {
  EXPECT_THAT(ReadEnvironment({"CLEARWAY_\x1b[31mX=1"}).warnings,
              ElementsAre(HasSubstr("CLEARWAY_\\x1b[31mX is not a setting")));
}

TEST(Environment, WarnsInsteadOfRefusing) {
  const auto line = ReadCommandLine({}, {"CLEARWAY_PORT=tcp://10.0.0.1:50151", "CLEARWAY_X=1"});
  ASSERT_TRUE(line.ok()) << line.status();
  EXPECT_EQ(line->config.listen, ServerConfig().listen);
  EXPECT_EQ(line->warnings.size(), 2u);
}

TEST(Environment, ABadValueOfAKeyIsAnErrorThatNamesTheVariable) {
  for (const char* entry : {"CLEARWAY_THREADS=x", "CLEARWAY_THREADS=300", "CLEARWAY_THREADS=",
                            "CLEARWAY_LISTEN=tcp://10.0.0.1:1", "CLEARWAY_SCENE_RESOLUTION_M=0"}) {
    const std::string name = std::string(entry).substr(0, std::string(entry).find('='));
    const absl::Status status = ReadCommandLine({}, {entry}).status();
    EXPECT_TRUE(absl::IsInvalidArgument(status)) << status;
    EXPECT_THAT(std::string(status.message()), HasSubstr("(set by " + name + ")"));
  }
  const absl::Status flag = ReadCommandLine({"--threads", "x"}, {"CLEARWAY_THREADS=3"}).status();
  EXPECT_THAT(std::string(flag.message()), testing::Not(HasSubstr("CLEARWAY_THREADS")));
}

}  // namespace
}  // namespace clearway
