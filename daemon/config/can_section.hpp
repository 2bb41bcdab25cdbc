#pragma once
#include <vector>

#include "drivers/can/can_settings.hpp"
#include "settings/section.hpp"

namespace azimuth {

/// The tables of a robot base on a CAN bus, bound to `can`, which must outlive them.
std::vector<Section> can_sections(CanSettings& can);

}  // namespace azimuth
