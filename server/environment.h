// The configuration's keys in environment variables.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace clearway {

// What of the environment concerns the configuration.
struct EnvironmentValues {
  std::map<std::string, std::string> values;  // by the settings' keys
  std::string config_file;                    // CLEARWAY_CONFIG
  // Of variables that begin with CLEARWAY_ and are nobody's. Orchestrators make some on their own:
  // Kubernetes and Docker give every container CLEARWAY_PORT=tcp://... for a service of that name.
  std::vector<std::string> warnings;
};

// `environment`: "NAME=value" each. Values are not looked at.
EnvironmentValues ReadEnvironment(const std::vector<std::string>& environment);

}  // namespace clearway
