#pragma once
// The camera as an object of libdc1394: how it is found and opened, and the texts of its errors. Internal to
// drivers/iidc.

#include <cstdint>
#include <dc1394/dc1394.h>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "drivers/camera/image_stream.hpp"
#include "drivers/iidc/iidc_settings.hpp"

namespace azimuth::iidc {

struct FreeContext {
  void operator()(dc1394_t* context) const { dc1394_free(context); }
};
struct FreeList {
  void operator()(dc1394camera_list_t* list) const { dc1394_camera_free_list(list); }
};
struct FreeCamera {
  void operator()(dc1394camera_t* camera) const { dc1394_camera_free(camera); }
};

/// One camera with a context of its own. Thread contract: thread-bound, as libdc1394 is; different threads may use
/// different objects.
struct OpenCamera {
  std::unique_ptr<dc1394_t, FreeContext> context;
  std::unique_ptr<dc1394camera_t, FreeCamera> handle;  // destroyed before the context
  std::string guid;
  bool on_usb = false;

  explicit operator bool() const { return static_cast<bool>(handle); }
  dc1394camera_t* get() const { return handle.get(); }
};

/// Stops libdc1394 from writing to stderr. The last error or warning of each thread is kept for take_complaint().
/// Output requested by its debugging variable DC1394_DEBUG is still printed.
void silence_library();
/// The library's message on this thread since the last call; empty: none.
std::string take_complaint();

/// "IIDC camera GUID: operation: cause", with the library's own message.
CameraTrouble trouble_of(const OpenCamera& camera, std::string_view what, dc1394error_t error);

/// Finds and opens the camera that the settings name.
tl::expected<OpenCamera, CameraTrouble> find_camera(const IidcSettings& settings);

/// The number of the last bus reset that the library knows of. The library learns of a reset when the camera is asked
/// something. On USB the number never changes.
std::uint32_t bus_generation(const OpenCamera& camera);

/// The port of a camera on USB; empty if it is on FireWire or cannot be found.
std::string usb_port_of(const OpenCamera& camera);

/// The port (its name in sysfs, "1-2.3") of the USB device with this bus number and address. Empty: there is none.
/// `devices` is /sys/bus/usb/devices, or a similar folder in tests.
std::string usb_port_of(std::uint32_t bus, std::uint32_t address, const std::filesystem::path& devices);

}  // namespace azimuth::iidc
