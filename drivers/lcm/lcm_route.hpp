#pragma once
#include "drivers/lcm/lcm_address.hpp"

namespace azimuth {

/// The errno of the kernel's route to a group: 0 when there is a route, ENETUNREACH without a network for it. Sends
/// nothing.
int route_error(const LcmAddress& address);

}  // namespace azimuth
