#pragma once

namespace azimuth {

/// What USB may do for cameras and serial adapters.
struct UsbSettings {
  bool hotplug = true;          ///< wake sources when something is plugged in, instead of at their next try
  bool reset = true;            ///< reset the port of a device that hangs, at most once a minute
  double reset_after_s = 10.0;  ///< silence of a serial adapter that counts as hanging; cameras have their own
};

}  // namespace azimuth
