#include "server/config.h"

#include <arpa/inet.h>
#include <toml++/toml.h>

#include <CLI/CLI.hpp>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include "absl/strings/match.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "clearway/base/file.h"

namespace clearway {
namespace {

using Values = std::map<std::string, std::string>;  // by key

constexpr char kPrefix[] = "CLEARWAY_";
// Names that other parts of Clearway read.
const std::set<std::string>& ForeignNames() {
  static const auto* const kNames =
      new std::set<std::string>{"CLEARWAY_ADDRESS", "CLEARWAY_ALL_FRAMES", "CLEARWAY_CONFIG",
                                "CLEARWAY_DATA",    "CLEARWAY_JOBS",       "CLEARWAY_SERVER"};
  return *kNames;
}

absl::Status Unknown(const std::string& what) {
  return absl::InvalidArgumentError(absl::StrCat(what, " is not a key of the configuration"));
}

const Setting* FindSetting(const std::string& key) {
  for (const Setting& setting : Settings()) {
    if (setting.key == key) return &setting;
  }
  return nullptr;
}

std::string TextOf(const toml::node& node) {
  if (const auto text = node.value_exact<std::string>()) return *text;
  std::ostringstream out;
  node.visit([&](const auto& value) { out << value; });
  return out.str();
}

absl::Status CollectToml(const toml::table& table, const std::string& prefix, Values& values) {
  for (const auto& [name, node] : table) {
    const std::string key = prefix + std::string(name.str());
    if (const toml::table* inner = node.as_table()) {
      if (auto status = CollectToml(*inner, key + ".", values); !status.ok()) return status;
    } else if (FindSetting(key) == nullptr) {
      return Unknown(key);
    } else {
      values[key] = TextOf(node);
    }
  }
  return absl::OkStatus();
}

absl::Status ReadFile(const std::string& path, Values& values) {
  constexpr std::uint64_t kMaxBytes = 16'000'000;
  const absl::StatusOr<std::string> text = ReadTextFile(path, kMaxBytes);
  if (!text.ok()) return text.status();
  try {
    return CollectToml(toml::parse(*text, path), "", values);
  } catch (const toml::parse_error& error) {
    return absl::InvalidArgumentError(
        absl::StrCat(path, ":", error.source().begin.line, ": ", std::string(error.description())));
  }
}

absl::Status ReadEnvironment(const std::vector<std::string>& environment, Values& values,
                             std::string& file) {
  std::map<std::string, const Setting*> settings;
  for (const Setting& setting : Settings()) settings[setting.EnvironmentName()] = &setting;
  for (const std::string& entry : environment) {
    if (!absl::StartsWith(entry, kPrefix)) continue;
    const std::size_t equals = entry.find('=');
    const std::string name = entry.substr(0, equals);
    const std::string value = equals == std::string::npos ? "" : entry.substr(equals + 1);
    if (name == "CLEARWAY_CONFIG") file = value;
    if (ForeignNames().count(name) != 0) continue;
    const auto setting = settings.find(name);
    if (setting == settings.end()) return Unknown("environment: " + name);
    values[setting->second->key] = value;
  }
  return absl::OkStatus();
}

struct Flags {
  Values values;
  std::string file;
  bool print_config = false;
  std::string help;
};

absl::StatusOr<Flags> ReadFlags(std::vector<std::string> arguments) {
  CLI::App app(
      "Clearway's server: labelled scans in, answers about a moving world out.\n"
      "Example: clearway-server --listen 127.0.0.1:0 --scene-resolution-m 0.05",
      "clearway-server");
  Flags flags;
  app.add_option("--config", flags.file, "TOML file");
  app.add_flag("--print-config", flags.print_config, "print the configuration as TOML and end");
  std::map<std::string, std::string> texts;
  std::map<std::string, CLI::Option*> options;
  for (const Setting& setting : Settings()) {
    options[setting.key] =
        app.add_option(setting.FlagName(), texts[setting.key],
                       absl::StrCat(setting.help, " [", setting.get(ServerConfig()), "]"))
            ->allow_extra_args(false);
  }
  std::reverse(arguments.begin(), arguments.end());  // CLI11's order
  try {
    app.parse(arguments);
  } catch (const CLI::CallForHelp&) {
    flags.help = app.help();
    return flags;
  } catch (const CLI::ParseError& error) {
    return absl::InvalidArgumentError(absl::StrCat("flags: ", error.what()));
  }
  for (const auto& [key, option] : options) {
    if (option->count() > 0) flags.values[key] = texts[key];
  }
  return flags;
}

absl::Status Require(bool condition, const char* key, const std::string& what) {
  if (condition) return absl::OkStatus();
  return absl::InvalidArgumentError(absl::StrCat(key, ": ", what));
}

absl::Status ValidateLimits(const ServerLimits& limits) {
  const ServerConfig defaults;
  for (const Setting& setting : Settings()) {
    if (!absl::StartsWith(setting.key, "limits.")) continue;
    ServerConfig config;
    config.limits = limits;
    const double value = std::stod(setting.get(config));
    if (auto status = Require(value > 0, setting.key.c_str(), "must be above 0"); !status.ok()) {
      return status;
    }
  }
  constexpr std::uint64_t kMaxMessage = std::uint64_t{1} << 30;  // gRPC counts bytes in an int
  if (auto status =
          Require(limits.max_message_bytes <= kMaxMessage, "limits.max_message_bytes",
                  absl::StrCat("is ", limits.max_message_bytes, "; the limit is ", kMaxMessage));
      !status.ok()) {
    return status;
  }
  return Require(limits.max_lease_ttl_s <= 1e6 && limits.max_version_wait_s <= 1e6 &&
                     limits.max_planning_s <= 1e6,
                 "limits.max_lease_ttl_s", "times must be at most 1000000 s");
}

bool NamesAPortOrSocket(const std::string& listen) {
  if (absl::StartsWith(listen, "unix:")) return listen.size() > 5;
  const std::size_t colon = listen.rfind(':');
  int port = 0;
  return colon != std::string::npos && absl::SimpleAtoi(listen.substr(colon + 1), &port) &&
         port >= 0 && port <= 65535;
}

}  // namespace

bool IsLocalAddress(const std::string& listen) {
  if (absl::StartsWith(listen, "unix:")) return true;
  std::string_view host = std::string_view(listen).substr(0, listen.rfind(':'));
  if (host.starts_with("ipv4:") || host.starts_with("ipv6:")) host.remove_prefix(5);
  if (host == "localhost" || host == "[::1]") return true;
  in_addr address;
  return inet_pton(AF_INET, std::string(host).c_str(), &address) == 1 &&
         ntohl(address.s_addr) >> 24 == 127;
}

absl::Status Validate(const ServerConfig& config) {
  const bool tls = !config.tls_cert.empty() && !config.tls_key.empty();
  static const auto* const kLevels =
      new std::set<std::string>{"trace", "debug", "info", "warning", "error", "off"};
  for (const absl::Status& status :
       {Require(!config.listen.empty(), "listen", "is missing"),
        Require(NamesAPortOrSocket(config.listen), "listen",
                absl::StrCat(config.listen, " is neither host:port nor unix:/path")),
        Require(config.tls_cert.empty() == config.tls_key.empty(), "tls_key",
                "tls_cert and tls_key belong together"),
        Require(tls || IsLocalAddress(config.listen), "listen",
                absl::StrCat(config.listen,
                             " can be reached from elsewhere, which needs tls_cert "
                             "and tls_key")),
        Require(kLevels->count(config.log_level) != 0, "log_level",
                absl::StrCat("\"", config.log_level, "\" is not a level")),
        Require(config.threads >= 0 && config.threads <= 256, "threads",
                absl::StrCat("is ", config.threads, "; it must lie between 0 and 256")),
        Require(config.writer_niceness >= 0 && config.writer_niceness <= 19, "writer_niceness",
                absl::StrCat("is ", config.writer_niceness, "; it must lie between 0 and 19")),
        Require(config.kept_versions <= 10'000, "kept_versions",
                absl::StrCat("is ", config.kept_versions, "; the limit is 10000")),
        ValidateLimits(config.limits)}) {
    if (!status.ok()) return status;
  }
  const absl::Status scene = Validate(config.scene);
  if (scene.ok()) return scene;
  return absl::InvalidArgumentError(absl::StrCat("scene.", std::string(scene.message())));
}

absl::StatusOr<CommandLine> ReadCommandLine(const std::vector<std::string>& arguments,
                                            const std::vector<std::string>& environment) {
  absl::StatusOr<Flags> flags = ReadFlags(arguments);
  if (!flags.ok()) return flags.status();
  if (!flags->help.empty()) return CommandLine{{}, false, flags->help};
  Values from_environment, values;
  std::string file;
  if (auto status = ReadEnvironment(environment, from_environment, file); !status.ok()) {
    return status;
  }
  if (!flags->file.empty()) file = flags->file;
  if (!file.empty()) {
    if (auto status = ReadFile(file, values); !status.ok()) return status;
  }
  for (const Values* stronger : {&from_environment, &flags->values}) {
    for (const auto& [key, value] : *stronger) values[key] = value;
  }
  CommandLine line;
  line.print_config = flags->print_config;
  for (const auto& [key, value] : values) {
    if (auto status = FindSetting(key)->set(line.config, value); !status.ok()) return status;
  }
  if (auto status = Validate(line.config); !status.ok()) return status;
  return line;
}

std::string ToToml(const ServerConfig& config) {
  std::string toml, section;
  for (const Setting& setting : Settings()) {
    const std::size_t dot = setting.key.find('.');
    const std::string own = dot == std::string::npos ? "" : setting.key.substr(0, dot);
    if (own != section) absl::StrAppend(&toml, "\n[", section = own, "]\n");
    const std::string name = dot == std::string::npos ? setting.key : setting.key.substr(dot + 1);
    absl::StrAppend(&toml, name, " = ", setting.get(config), "  # ", setting.help, "\n");
  }
  return toml;
}

}  // namespace clearway
