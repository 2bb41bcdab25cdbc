#pragma once
#include <cstdint>
#include <string>
#include <tl/expected.hpp>

#include "base/unique_fd.hpp"

namespace azimuth {

/// A TCP socket that listens without blocking. `address` is numeric, IPv4 or IPv6. The error is a sentence with the
/// likely cause. Reentrant.
tl::expected<UniqueFd, std::string> listening_socket(const std::string& address, std::uint16_t port);

/// The port it has.
std::uint16_t port_of(const UniqueFd& socket);

/// Whether only this machine can reach the address; nothing for what is no numeric address.
bool is_address(const std::string& address);
bool is_loopback(const std::string& address);

}  // namespace azimuth
