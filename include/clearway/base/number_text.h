// Numbers in messages.
#pragma once

#include <string>

namespace clearway {

// The shortest text that reads back as the same number ("0.1", "6.0000001", "1e+06", "nan"). Six
// digits, as absl::StrCat prints, can make a value look like the limit that it exceeds.
std::string NumberText(double number);
// The same for a number in single precision: 0.1F is "0.1".
std::string NumberText(float number);

}  // namespace clearway
