// What a server is told to be: flags over environment over a TOML file over defaults.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/scene/scene_params.h"
#include "clearway/wire/server_info.h"

namespace clearway {

// How dead connections are found. A plain value.
struct KeepaliveConfig {
  Duration time = std::chrono::seconds(20);     // without a sign of life before a ping
  Duration timeout = std::chrono::seconds(20);  // for its answer; then the connection is dropped
  Duration min_client_ping = std::chrono::seconds(4);  // clients that ping more often are refused
};

// A plain value; Validate says whether it makes sense.
struct ServerConfig {
  // As ParseListenAddress: "127.0.0.1:50151" (port 0: any free one) or "unix:/path". Anything but
  // loopback and Unix sockets needs TLS.
  std::string listen = "127.0.0.1:50151";
  std::string tls_cert, tls_key;     // PEM files
  std::string tls_client_ca;         // PEM file; not empty: clients must show a certificate of its
  std::string tokens;                // file of a TokenTable; empty: everybody may do everything
  bool insecure = false;             // no TLS where others than this machine can connect
  std::string socket_mode = "0600";  // of a Unix socket's file
  bool reflection = false;
  std::string log_level = "info";
  int threads = 0;                            // that apply frames; 0: as many as the machine has
  int writer_niceness = 5;                    // of those threads: 0, as those that answer, to 19
  std::uint64_t kept_versions = 16;           // beside the newest, for mirrors that fell behind
  Duration drain = std::chrono::seconds(10);  // that calls and frames have to end after SIGTERM
  KeepaliveConfig keepalive;
  SceneParams scene;
  ServerLimits limits;
};

// INVALID_ARGUMENT naming the key, the value and the limit.
absl::Status Validate(const ServerConfig& config);

// Of ServerConfig::socket_mode: three octal digits, with or without a leading 0.
std::optional<unsigned> ParseSocketMode(const std::string& text);

// One key of the configuration: "scene.resolution_m" in the file, --scene-resolution-m as a flag,
// CLEARWAY_SCENE_RESOLUTION_M in the environment.
struct Setting {
  std::string key;
  std::string help;
  // INVALID_ARGUMENT naming the key, the value and what it may be.
  std::function<absl::Status(ServerConfig&, const std::string&)> set;
  std::function<std::string(const ServerConfig&)> get;  // as TOML
  // Of what the configuration holds, as `set`.
  std::function<absl::Status(const ServerConfig&)> check;

  std::string FlagName() const;
  std::string EnvironmentName() const;
};
const std::vector<Setting>& Settings();

// What the command line asked for.
struct CommandLine {
  ServerConfig config;
  bool print_config = false;          // and then end
  std::string help;                   // not empty: print this and end
  std::vector<std::string> warnings;  // of the environment
};

// `environment`: "NAME=value" each; CLEARWAY_CONFIG names the file. Unknown keys of the file and
// unknown flags are errors; unknown variables are warnings, for others may have set them.
absl::StatusOr<CommandLine> ReadCommandLine(const std::vector<std::string>& arguments,
                                            const std::vector<std::string>& environment);

// The whole configuration as a TOML file that would make it again.
std::string ToToml(const ServerConfig& config);

}  // namespace clearway
