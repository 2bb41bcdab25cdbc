// Any text as an OCamCalib calibration. The result must be violations or a rig with a valid camera.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "settings/ocam_calibration.hpp"
#include "slam/camera/make_camera.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto rig =
      azimuth::read_ocam_calibration(std::string_view(reinterpret_cast<const char*>(data), size), "calib_results.txt");
  std::string why;
  if (rig && !azimuth::camera_of(rig->camera, why)) std::abort();
  return 0;
}
