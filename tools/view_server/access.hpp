#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace azimuth {

/// As long for any two texts of one length.
bool same_secret(std::string_view a, std::string_view b);

/// 32 hexadecimal digits that nobody can guess.
std::string random_token();

/// Whether a Host header names this machine as it names itself ("localhost:8017", "127.0.0.1", "[::1]:8017"): a page of
/// another site that has its name lead here must not read.
bool is_own_name(std::string_view host);

/// What a token may be made of: 16 to 200 letters, digits, "-" and "_". What is wrong with it; nothing: it is one.
std::optional<std::string> why_no_token(std::string_view token);

}  // namespace azimuth
