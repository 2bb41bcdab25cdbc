#pragma once
// The table [lamp_ekf] of azimuth.toml.

#include "settings/section.hpp"
#include "slam/ceiling/lamp_ekf_settings.hpp"

namespace azimuth {

Section lamp_ekf_section(LampEkfSettings& lamp_ekf);

}  // namespace azimuth
