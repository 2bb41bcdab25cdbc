#pragma once
#include "base/file_result.hpp"
#include "daemon/publish/publish_settings.hpp"
#include "drivers/lcm/lcm_settings.hpp"
#include "settings/section.hpp"

namespace azimuth {

/// The table [daemon.lcm_source].
Section lcm_source_section(LcmSourceSettings& source);

/// Errors: an address that cannot be listened to, invalid channel names, and channels on which the daemon itself sends.
FileErrors check(const LcmSourceSettings& source, const PublishSettings& publish);

}  // namespace azimuth
