#pragma once
// The table of an IIDC camera.

#include "base/file_result.hpp"
#include "drivers/iidc/iidc_settings.hpp"
#include "settings/section.hpp"

namespace azimuth {

/// [daemon.iidc]
Section iidc_section(IidcSettings& iidc);

/// Texts that mean nothing, whatever the camera.
FileErrors check(const IidcSettings& iidc);

}  // namespace azimuth
