#pragma once
#include "drivers/lcm/lcm_address.hpp"

namespace azimuth {

/// What the kernel says of the way to a group, as errno: 0 when there is one, ENETUNREACH without a network for it.
/// Sends nothing.
int route_error(const LcmAddress& address);

}  // namespace azimuth
