// The values of settings as text.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "clearway/base/time.h"
#include "clearway/geometry/aabb.h"
#include "clearway/scene/scene_params.h"

namespace clearway {

// A number with blanks around it.
bool ParseBlankedNumber(const std::string& text, double& value);

// From the text of a flag, a variable or a file. The error says what the text should be.
absl::Status ParseValue(const std::string& text, std::string& value);
absl::Status ParseValue(const std::string& text, bool& value);
absl::Status ParseValue(const std::string& text, double& value);
absl::Status ParseValue(const std::string& text, int& value);
absl::Status ParseValue(const std::string& text, std::uint64_t& value);
absl::Status ParseValue(const std::string& text, Duration& value);
absl::Status ParseValue(const std::string& text, SolidMode& value);
absl::Status ParseValue(const std::string& text, MotionModel& value);
absl::Status ParseValue(const std::string& text, MotionFromPoints& value);
absl::Status ParseValue(const std::string& text, Aabb& box);
absl::Status ParseValue(const std::string& text, std::vector<Aabb>& boxes);

// As TOML, which ParseValue reads as the same value.
std::string ValueText(const std::string& value);
std::string ValueText(bool value);
std::string ValueText(double value);
std::string ValueText(int value);
std::string ValueText(std::uint64_t value);
std::string ValueText(Duration value);
std::string ValueText(SolidMode value);
std::string ValueText(MotionModel value);
std::string ValueText(MotionFromPoints value);
std::string ValueText(const Aabb& box);
std::string ValueText(const std::vector<Aabb>& boxes);

}  // namespace clearway
