#pragma once
// The camera as libdc1394 knows it: found, opened, and what its calls answer in words. Internal to drivers/iidc.

#include <dc1394/dc1394.h>
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

/// One camera with a context of its own. Thread contract: thread-bound, as libdc1394 is; different objects may be used
/// by different threads.
struct OpenCamera {
  std::unique_ptr<dc1394_t, FreeContext> context;
  std::unique_ptr<dc1394camera_t, FreeCamera> handle;  // goes first
  std::string guid;
  bool on_usb = false;

  explicit operator bool() const { return static_cast<bool>(handle); }
  dc1394camera_t* get() const { return handle.get(); }
};

/// From now on libdc1394 writes nothing to stderr: the last error or warning of each thread is kept for
/// take_complaint(). What its debugging variable DC1394_DEBUG asks for is still printed.
void silence_library();
/// What the library said on this thread since the last call; empty: nothing.
std::string take_complaint();

/// "IIDC camera GUID: what: why", with what the library complained about.
CameraTrouble trouble_of(const OpenCamera& camera, std::string_view what, dc1394error_t error);

/// The camera of the settings.
tl::expected<OpenCamera, CameraTrouble> find_camera(const IidcSettings& settings);

/// The number of the last bus reset that the library has heard of, which it does when the camera is asked something.
/// On USB it never changes.
std::uint32_t bus_generation(const OpenCamera& camera);

/// Where a camera on USB is plugged in; empty if it is on FireWire or cannot be found.
std::string usb_port_of(const OpenCamera& camera);

}  // namespace azimuth::iidc
