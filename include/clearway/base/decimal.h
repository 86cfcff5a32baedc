// Numbers out of text that people write.
#pragma once

#include <string_view>

#include "absl/strings/numbers.h"

namespace clearway {

// The whole text as a decimal number, "nan" and "inf" too; blanks may stand around it. False, and
// `number` undefined, for other texts: hexadecimal digits, which absl::SimpleAtod reads, are more
// often a slip than meant.
inline bool ParseDecimal(std::string_view text, double& number) {
  return text.find_first_of("xX") == std::string_view::npos &&
         absl::SimpleAtod({text.data(), text.size()}, &number);
}

}  // namespace clearway
