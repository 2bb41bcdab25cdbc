#pragma once
#include "daemon/publish/publish_settings.hpp"

namespace azimuth {

/// Settings that keep messages inside the process, without a network.
inline PublishSettings quiet() {
  PublishSettings settings;
  settings.lcm_url = "memq://";
  return settings;
}

}  // namespace azimuth
