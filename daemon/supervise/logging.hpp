#pragma once
#include "daemon/config/daemon_settings.hpp"

namespace azimuth {

/// Logs to standard error. Under systemd it logs directly to the journal, which then gets the severity of each line and
/// the fields of events. May be called again while no other thread logs.
void set_up_logging(LogLevel level);

}  // namespace azimuth
