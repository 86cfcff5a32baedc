// CLEARWAY_DATA, for as long as a test needs it.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

namespace clearway {

// The environment's CLEARWAY_DATA names the folder until the end. One thread.
class DataVariable {
 public:
  explicit DataVariable(const std::filesystem::path& folder) {
    if (const char* const value = std::getenv(kName)) before_ = value;
    setenv(kName, folder.c_str(), 1);
  }
  ~DataVariable() {
    if (before_) {
      setenv(kName, before_->c_str(), 1);
    } else {
      unsetenv(kName);
    }
  }
  DataVariable(const DataVariable&) = delete;
  DataVariable& operator=(const DataVariable&) = delete;

 private:
  static constexpr char kName[] = "CLEARWAY_DATA";
  std::optional<std::string> before_;
};

}  // namespace clearway
