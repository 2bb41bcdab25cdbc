#include "tools/view_server/access.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <stdexcept>
#include <sys/random.h>

#include "tools/view_server/listening_socket.hpp"

namespace azimuth {
namespace {

constexpr std::size_t kLeastToken = 16, kMostToken = 200;

/// The host without the port: "localhost" for "localhost:8017", "::1" for "[::1]:8017".
std::string_view without_port(std::string_view host) {
  if (host.starts_with('[')) {
    const std::size_t end = host.find(']');
    return end == std::string_view::npos ? std::string_view() : host.substr(1, end - 1);
  }
  return host.substr(0, host.find(':'));
}

}  // namespace

bool same_secret(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned differences = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    differences |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
  return differences == 0;
}

std::string random_token() {
  std::array<unsigned char, 16> bytes{};
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw std::runtime_error("the kernel gives no random numbers for a token");
  std::string token;
  for (const unsigned char byte : bytes) token += fmt::format("{:02x}", byte);
  return token;
}

bool is_own_name(std::string_view host) {
  const std::string name(without_port(host));
  return name == "localhost" || is_loopback(name);
}

std::optional<std::string> why_no_token(std::string_view token) {
  if (token.size() < kLeastToken || token.size() > kMostToken)
    return fmt::format("has {} characters; a token has {} to {}", token.size(), kLeastToken, kMostToken);
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  };
  if (!std::ranges::all_of(token, allowed)) return "a token is letters, digits, \"-\" and \"_\" on one line";
  return std::nullopt;
}

}  // namespace azimuth
