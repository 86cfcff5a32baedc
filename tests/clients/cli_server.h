// The tool and a real server for it.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "clients/run_clearway.h"
#include "clients/server_process.h"

namespace clearway {

class CliServer : public ::testing::Test {
 protected:
  static constexpr int kFrames = 8;

  void SetUp() override {
    server_ = std::make_unique<ServerProcess>();
    ASSERT_FALSE(server_->address().empty()) << "the server did not start";
  }

  Finished Clearway(std::vector<std::string> arguments, const std::string& input = "") {
    arguments.insert(arguments.end(), {"--server", server_->address()});
    return RunClearway(arguments, input);
  }

  // The answer of a command that must succeed.
  nlohmann::json Ask(std::vector<std::string> arguments, const std::string& input = "") {
    arguments.push_back("--json");
    const Finished finished = Clearway(std::move(arguments), input);
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    return nlohmann::json::parse(finished.out, nullptr, /*allow_exceptions=*/false);
  }

  // A small simulated drive.
  nlohmann::json Replay() {
    return Ask({"replay", "sim:small", "--frames", std::to_string(kFrames), "--quiet"});
  }

  // "x,y,z" of an object that moves, as the server has it.
  std::string PointInAnObject(nlohmann::json* object) {
    const nlohmann::json objects = Ask({"objects"});
    for (const nlohmann::json& candidate : objects["objects"]) {
      if (candidate["speed_mps"] < 0.1) continue;
      *object = candidate;
      const nlohmann::json& box = candidate["box_world"];
      const auto middle = [&box](int axis) {
        return (box["min_m"][axis].get<double>() + box["max_m"][axis].get<double>()) / 2;
      };
      return absl::StrCat(middle(0), ",", middle(1), ",", middle(2));
    }
    ADD_FAILURE() << "nothing moves: " << objects.dump();
    return "0,0,0";
  }

  std::unique_ptr<ServerProcess> server_;
};

}  // namespace clearway
