#pragma once
// A stand-in for libdc1394 with one camera on its bus: the same C functions, which follow the test's settings in
// FakeIidc. It is as strict as the library: buffers of the ring are filled and returned in one order, capture_stop
// frees their memory, and only one thread at a time may call.

#include <cstddef>
#include <cstdint>
#include <dc1394/dc1394.h>
#include <map>
#include <string>
#include <vector>

namespace azimuth::test {

struct FakeFeature {
  bool available = true, switchable = false, absolute = false, automatic = true;
  bool on = true, uses_absolute = false;
  dc1394feature_mode_t mode = DC1394_FEATURE_MODE_AUTO;
  std::uint32_t min = 0, max = 1000, value = 100, second_value = 100;
  float abs_min = 0.0F, abs_max = 10.0F, abs_value = 1.0F;
  std::uint32_t step = 1;  ///< set values are rounded down to multiples of the step
};

struct FakeFormat7 {
  std::uint32_t max_width = 1280, max_height = 960, unit_width = 8, unit_height = 2, unit_left = 4, unit_top = 2;
  std::uint32_t left = 0, top = 0, width = 1280, height = 960;
  std::vector<dc1394color_coding_t> codings{DC1394_COLOR_CODING_MONO8};
  dc1394color_coding_t coding = DC1394_COLOR_CODING_MONO8;
  dc1394color_filter_t filter = DC1394_COLOR_FILTER_RGGB;
  std::uint32_t packet_unit = 4, packet_max = 4096, packet_recommended = 2048, packet = 0;
  float interval_s = 0.0F;  ///< 0: not stated
};

/// State of the bus, the camera and the library.
struct FakeIidc {
  static constexpr std::uint64_t kGuid = 0x00b09d0100c0ffee;

  // Set by the test.
  std::vector<std::uint64_t> guids{kGuid};  ///< cameras on the bus; all are this camera
  std::string platform = "juju", vendor = "Bench", model = "VCAM-1";
  bool bmode = false;
  std::map<dc1394video_mode_t, std::vector<dc1394framerate_t>> modes;
  FakeFormat7 format7;
  std::map<dc1394feature_t, FakeFeature> features;
  std::uint32_t node = 1, generation = 7;
  dc1394error_t setup_error = DC1394_SUCCESS;    ///< result of dc1394_capture_setup
  dc1394error_t dequeue_error = DC1394_SUCCESS;  ///< result of dc1394_capture_dequeue, from the next frame on
  dc1394error_t enqueue_error = DC1394_SUCCESS;
  dc1394error_t stop_error = DC1394_SUCCESS;  ///< result of dc1394_capture_stop; on an error its descriptor stays open
  bool keeps_sending = true;                  ///< false: transmission reads as off
  std::string complaint;                      ///< logged by the library with its next failure

  /// Number of the call that fails; 0: none.
  int failing_call = 0;

  // Results.
  int calls = 0;
  const char* failed_call = nullptr;
  bool transmitting = false;
  int contexts = 0, cameras = 0, captures = 0;  ///< currently alive
  dc1394video_mode_t mode = DC1394_VIDEO_MODE_640x480_MONO8;
  dc1394framerate_t rate = DC1394_FRAMERATE_15;
  dc1394speed_t speed = DC1394_ISO_SPEED_100;
  dc1394operation_mode_t operation = DC1394_OPERATION_MODE_LEGACY;
  int lost = 0;              ///< frames for which the ring had no room
  std::vector<int> misuse;   ///< lines of fake_dc1394.cpp at which the real library would fail
  int last_descriptor = -1;  ///< descriptor of the last capture
  std::uint64_t opened_guid = 0;

  // Actions of the camera.
  std::uint64_t start_us = 0;  ///< wall clock at the start of the test
  /// Sends a frame whose pixels are all `number`, stamped `age_us` before the start of the test.
  void send(std::uint8_t number, std::int64_t age_us = 0, bool corrupt = false);
  /// Sends such a frame with any stamp.
  void send_stamped(std::uint8_t number, std::uint64_t wall_us, bool corrupt = false);
  void reset_bus();
  std::uint32_t ring_size() const { return static_cast<std::uint32_t>(ring.size()); }
  /// If not 0, the next frames state this width.
  std::uint32_t wrong_width = 0;

  // For the functions of the library.
  struct Slot {
    dc1394video_frame_t frame{};
    std::vector<unsigned char> memory;
    enum class State { queued, filled, taken } state = State::queued;
    bool corrupt = false;
  };
  bool fails(const char* call);
  std::vector<Slot> ring;
  std::size_t next_filled = 0, next_taken = 0, next_given = 0;
  int frame_pipe[2] = {-1, -1};
  std::uint32_t known_generation = 0;
  dc1394camera_t handle{};
};

/// The state that the functions use. reset_fake() renews it before each test.
FakeIidc& fake();
void reset_fake();

/// The usual modes of the tests: MONO8 640x480 and YUV422 320x240 at 7.5, 15 and 30 images per second.
void offer_usual_modes();

}  // namespace azimuth::test

/// First statement of every function that can fail: fails at the call that the test has chosen.
#define FAKE_CALL() \
  if (azimuth::test::fake().fails(__func__)) return DC1394_FAILURE
