#pragma once
#include <string_view>

namespace spectra {

/// Byte offset of the first sequence that is no UTF-8 (RFC 3629: overlong forms, surrogates and
/// values above 10FFFF are none); npos if all is well.
[[nodiscard]] std::size_t first_invalid_utf8(std::string_view text);

}  // namespace spectra
