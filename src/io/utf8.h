// Whether bytes are text.
#pragma once

#include <string_view>

namespace clearway {

// UTF-8 by RFC 3629: no overlong forms, no surrogates, nothing above U+10FFFF.
// https://www.rfc-editor.org/rfc/rfc3629#section-4
bool IsUtf8(std::string_view bytes);
// UTF-8 without the control characters of ASCII: what may be printed in a line.
bool IsPlainText(std::string_view bytes);

}  // namespace clearway
