#pragma once
#include "daemon/config/daemon_settings.hpp"

namespace azimuth {

/// Logs to standard error; under systemd straight to the journal, which then knows each line's severity and
/// events' fields. May be called again while no other thread logs.
void set_up_logging(LogLevel level);

}  // namespace azimuth
