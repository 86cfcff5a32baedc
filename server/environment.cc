#include "server/environment.h"

#include <algorithm>
#include <regex>

#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "clearway/base/nearest_name.h"
#include "server/config.h"

namespace clearway {
namespace {

const std::string kPrefix = "CLEARWAY_";

// Names that other parts of Clearway read.
const std::vector<std::string>& NamesOfOthers() {
  static const auto* const kNames = new std::vector<std::string>{
      "CLEARWAY_ADDRESS", "CLEARWAY_ALL_FRAMES", "CLEARWAY_CONFIG",    "CLEARWAY_DATA",
      "CLEARWAY_JOBS",    "CLEARWAY_SERVER",     "CLEARWAY_TOKEN_FILE"};
  return *kNames;
}

// What Kubernetes (_SERVICE_, _PORT) and Docker's links (_PORT, _NAME, _ENV_) define.
bool IsServiceLink(const std::string& name) {
  static const auto* const kPattern = new std::regex(
      "CLEARWAY_(\\w+_)?"
      "(SERVICE_HOST|SERVICE_PORT(_\\w+)?|PORT(_\\d+_(TCP|UDP|SCTP)(_(PROTO|PORT|ADDR))?)?|NAME|"
      "ENV_\\w+)");
  return std::regex_match(name, *kPattern);
}

// The name without the prefix that all share, so that it does not count for likeness.
std::string OwnPart(const std::string& name) { return name.substr(kPrefix.size()); }

std::string UnknownName(const std::string& name) {
  std::vector<std::string> known;
  for (const Setting& setting : Settings()) known.push_back(OwnPart(setting.EnvironmentName()));
  for (const std::string& other : NamesOfOthers()) known.push_back(OwnPart(other));
  const std::string nearest = NearestName(OwnPart(name), known);
  return absl::StrCat(
      "environment: ", absl::CHexEscape(name), " is not a setting and is ignored",
      nearest.empty() ? "" : absl::StrCat("; did you mean ", kPrefix, nearest, "?"));
}

}  // namespace

EnvironmentValues ReadEnvironment(const std::vector<std::string>& environment) {
  std::map<std::string, std::string> keys;
  for (const Setting& setting : Settings()) keys[setting.EnvironmentName()] = setting.key;
  EnvironmentValues read;
  std::vector<std::string> links;
  for (const std::string& entry : environment) {
    if (!entry.starts_with(kPrefix)) continue;
    const std::size_t equals = entry.find('=');
    const std::string name = entry.substr(0, equals);
    const std::string value = equals == std::string::npos ? "" : entry.substr(equals + 1);
    const auto& others = NamesOfOthers();
    if (const auto key = keys.find(name); key != keys.end()) {
      read.values[key->second] = value;
    } else if (name == "CLEARWAY_CONFIG") {
      read.config_file = value;
    } else if (IsServiceLink(name)) {
      links.push_back(name);
    } else if (std::find(others.begin(), others.end(), name) == others.end()) {
      read.warnings.push_back(UnknownName(name));
    }
  }
  if (!links.empty()) {
    read.warnings.push_back(absl::StrCat(
        "environment: ", absl::StrJoin(links, ", "),
        links.size() == 1 ? " looks like an orchestrator's link to a service and is ignored"
                          : " look like an orchestrator's links to a service and are ignored"));
  }
  return read;
}

}  // namespace clearway
