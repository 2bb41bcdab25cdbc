#pragma once
#include <cstdint>
#include <string>
#include <tl/expected.hpp>

#include "base/unique_fd.hpp"

namespace azimuth {

/// A non-blocking listening TCP socket. `address` is a numeric IPv4 or IPv6 address. The error is a sentence with the
/// likely cause. Reentrant.
tl::expected<UniqueFd, std::string> listening_socket(const std::string& address, std::uint16_t port);

/// The port of a socket.
std::uint16_t port_of(const UniqueFd& socket);

/// True for a numeric IPv4 or IPv6 address.
bool is_address(const std::string& address);
/// True for an address that only this machine can reach.
bool is_loopback(const std::string& address);

}  // namespace azimuth
