#pragma once
#include "base/file_result.hpp"
#include "daemon/publish/publish_settings.hpp"
#include "drivers/lcm/lcm_settings.hpp"
#include "settings/section.hpp"

namespace azimuth {

/// The table [daemon.lcm_source].
Section lcm_source_section(LcmSourceSettings& source);

/// An address that cannot be listened to, channels that cannot be, and above all those that the daemon itself sends on.
FileErrors check(const LcmSourceSettings& source, const PublishSettings& publish);

}  // namespace azimuth
