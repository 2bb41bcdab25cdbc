#pragma once
#include "daemon/publish/publish_settings.hpp"

namespace azimuth {

/// Messages stay inside the process: no network.
inline PublishSettings quiet() {
  PublishSettings settings;
  settings.lcm_url = "memq://";
  return settings;
}

}  // namespace azimuth
