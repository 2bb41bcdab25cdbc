#pragma once
// The table of an IIDC camera.

#include "base/file_result.hpp"
#include "drivers/iidc/iidc_settings.hpp"
#include "settings/section.hpp"

namespace azimuth {

/// [daemon.iidc]
Section iidc_section(IidcSettings& iidc);

/// Errors in texts that are not valid for any camera.
FileErrors check(const IidcSettings& iidc);

}  // namespace azimuth
