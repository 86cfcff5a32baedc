#include "server/config.h"

#include <toml++/toml.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <sstream>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/strip.h"
#include "clearway/base/file.h"
#include "server/environment.h"
#include "server/listen_address.h"

namespace clearway {
namespace {

using Values = std::map<std::string, std::string>;  // by key

absl::Status Unknown(const std::string& what) {
  return absl::InvalidArgumentError(absl::StrCat(what, " is not a key of the configuration"));
}

const Setting* FindSetting(const std::string& key) {
  for (const Setting& setting : Settings()) {
    if (setting.key == key) return &setting;
  }
  return nullptr;
}

// Numbers may be written in hexadecimal, octal and binary.
std::string TextOf(const toml::node& node) {
  if (const auto text = node.value_exact<std::string>()) return *text;
  if (const auto number = node.value_exact<std::int64_t>()) return absl::StrCat(*number);
  std::ostringstream out;
  node.visit([&](const auto& value) { out << value; });
  return out.str();
}

// Lists within a list are boxes. Only their numbers get into the text, so that their sizes are
// checked here.
absl::Status CheckBoxes(const std::string& key, const toml::node& node) {
  const toml::array* const list = node.as_array();
  if (list == nullptr) return absl::OkStatus();
  const auto nested = std::ranges::count_if(*list, [](const auto& e) { return e.is_array(); });
  for (std::size_t i = 0; nested > 0 && i < list->size(); ++i) {
    const toml::array* const box = (*list)[i].as_array();
    if (box != nullptr && box->size() == 6) continue;
    return absl::InvalidArgumentError(absl::StrCat(
        key, "[", i,
        "]: ", box == nullptr ? "is no list" : absl::StrCat("has ", box->size(), " numbers"),
        "; a box is a list of six: minimum, maximum"));
  }
  return absl::OkStatus();
}

bool IsSection(const std::string& key) {
  return std::ranges::any_of(Settings(),
                             [&](const Setting& s) { return s.key.starts_with(key + "."); });
}

absl::Status CollectToml(const toml::table& table, const std::string& prefix, Values& values) {
  for (const auto& [name, node] : table) {
    const std::string key = prefix + std::string(name.str());
    if (const toml::table* inner = node.as_table()) {
      if (!IsSection(key)) return Unknown(key);
      if (auto status = CollectToml(*inner, key + ".", values); !status.ok()) return status;
    } else if (FindSetting(key) == nullptr) {
      return Unknown(key);
    } else {
      if (auto status = CheckBoxes(key, node); !status.ok()) return status;
      values[key] = TextOf(node);
    }
  }
  return absl::OkStatus();
}

// The variable or file is named when it is to blame.
absl::Status SetBy(const std::string& origin, const absl::Status& status) {
  return absl::Status(status.code(),
                      absl::StrCat(std::string(status.message()), " (set by ", origin, ")"));
}

absl::Status ReadFile(const std::string& path, Values& values) {
  constexpr std::uint64_t kMaxBytes = 16'000'000;
  const absl::StatusOr<std::string> text = ReadTextFile(path, kMaxBytes);
  if (!text.ok()) return text.status();
  try {
    const absl::Status status = CollectToml(toml::parse(*text, path), "", values);
    return status.ok() ? status : SetBy(path, status);
  } catch (const toml::parse_error& error) {
    return absl::InvalidArgumentError(
        absl::StrCat(path, ":", error.source().begin.line, ": ", std::string(error.description())));
  }
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

}  // namespace

std::optional<unsigned> ParseSocketMode(const std::string& text) {
  absl::string_view digits = text;
  absl::ConsumePrefix(&digits, "0");
  if (digits.size() != 3) return std::nullopt;
  unsigned mode = 0;
  for (const char digit : digits) {
    if (digit < '0' || digit > '7') return std::nullopt;
    mode = mode * 8 + static_cast<unsigned>(digit - '0');
  }
  return mode;
}

absl::Status Validate(const ServerConfig& config) {
  const bool tls = !config.tls_cert.empty() && !config.tls_key.empty();
  static const auto* const kLevels =
      new std::set<std::string>{"trace", "debug", "info", "warning", "error", "off"};
  const absl::StatusOr<ListenAddress> listen = ParseListenAddress(config.listen);
  if (!listen.ok()) return listen.status();
  // What cannot be listened on needs no certificate.
  const bool open = !listen->IsLocal();
  for (const absl::Status& status :
       {!tls && open ? CheckResolves(*listen) : absl::OkStatus(),
        Require(config.tls_cert.empty() == config.tls_key.empty(), "tls_key",
                "tls_cert and tls_key belong together"),
        Require(tls || !open || config.insecure, "listen",
                absl::StrCat(config.listen,
                             " can be reached from elsewhere, which needs tls_cert and tls_key, or "
                             "insecure if the network itself is safe")),
        Require(tls || config.tls_client_ca.empty(), "tls_client_ca",
                "needs tls_cert and tls_key, too"),
        Require(
            ParseSocketMode(config.socket_mode).has_value(), "socket_mode",
            absl::StrCat("\"", config.socket_mode, "\" is not three octal digits, such as 0660")),
        Require(kLevels->count(config.log_level) != 0, "log_level",
                absl::StrCat("\"", config.log_level, "\" is not a level"))}) {
    if (!status.ok()) return status;
  }
  for (const Setting& setting : Settings()) {
    if (absl::Status status = setting.check(config); !status.ok()) return status;
  }
  const absl::Status scene = Validate(config.scene);
  if (scene.ok()) return scene;
  return absl::InvalidArgumentError(absl::StrCat("scene.", std::string(scene.message())));
}

absl::StatusOr<CommandLine> ReadCommandLine(const std::vector<std::string>& arguments,
                                            const std::vector<std::string>& environment) {
  absl::StatusOr<Flags> flags = ReadFlags(arguments);
  if (!flags.ok()) return flags.status();
  if (!flags->help.empty()) return CommandLine{{}, false, flags->help, {}};
  EnvironmentValues from_environment = ReadEnvironment(environment);
  const bool named_by_flag = !flags->file.empty();
  const std::string& file = named_by_flag ? flags->file : from_environment.config_file;
  Values values;
  if (!file.empty()) {
    const auto status = ReadFile(file, values);
    if (!status.ok()) return named_by_flag ? status : SetBy("CLEARWAY_CONFIG", status);
  }
  for (const Values* stronger : {&from_environment.values, &flags->values}) {
    for (const auto& [key, value] : *stronger) values[key] = value;
  }
  const auto blame = [&](const absl::Status& status) {
    const std::string message(status.message());
    const std::string key = message.substr(0, message.find_first_of(": "));
    if (flags->values.count(key) != 0) return status;
    if (from_environment.values.count(key) != 0) {
      return SetBy(FindSetting(key)->EnvironmentName(), status);
    }
    return values.count(key) != 0 ? SetBy(file, status) : status;
  };
  CommandLine line;
  line.print_config = flags->print_config;
  line.warnings = std::move(from_environment.warnings);
  for (const auto& [key, value] : values) {
    if (auto status = FindSetting(key)->set(line.config, value); !status.ok()) {
      return blame(status);
    }
  }
  if (auto status = Validate(line.config); !status.ok()) return blame(status);
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
