#pragma once
// The table of an IIDC camera.

#include "drivers/iidc/iidc_settings.hpp"
#include "settings/section.hpp"
#include "settings/violation.hpp"

namespace azimuth {

/// [daemon.iidc]
Section iidc_section(IidcSettings& iidc);

/// Texts that mean nothing, whatever the camera.
Violations check(const IidcSettings& iidc);

}  // namespace azimuth
