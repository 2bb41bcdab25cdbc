#pragma once
// The table [identity] of azimuth.toml.

#include "settings/configuration.hpp"

namespace azimuth {

Section identity_section(IdentitySettings& identity, Preset& preset);

}  // namespace azimuth
