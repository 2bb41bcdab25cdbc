#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace azimuth {

/// Compares two texts. The time does not depend on the position of the first difference.
bool same_secret(std::string_view a, std::string_view b);

/// A token of 32 random hexadecimal digits.
std::string random_token();

/// True if a Host header is a local name of this machine ("localhost:8017", "127.0.0.1", "[::1]:8017"). This test
/// prevents DNS rebinding: a page of another site whose name resolves to this machine must not read data.
bool is_own_name(std::string_view host);

/// The reason why a token is invalid; nothing if it is valid. A token has 16 to 200 letters, digits, "-" and "_".
std::optional<std::string> why_no_token(std::string_view token);

}  // namespace azimuth
