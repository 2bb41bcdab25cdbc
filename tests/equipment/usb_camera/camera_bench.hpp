#pragma once
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "sim/azimuth_sim/line_input.hpp"
#include "tests/equipment/usb_camera/camera_output.hpp"
#include "tests/equipment/usb_camera/image_feed.hpp"

namespace azimuth::sim {

/// Transfers images from a feed to an output, paced by a clock or by their arrival, and obeys commands on standard
/// input:
///
///   plug, unplug    the device appears, disappears; plugging in is also a power cycle
///   freeze, run     no image leaves the device until `run` or a power cycle
///   hang            the same, until the host resets the device (usb only)
///   drop N          N images are not made: the number inside the test image jumps; no kernel counts them
///   short [N]       the next N images are cut short
///   error [N]       the next N images are marked bad (uvc), fail on the bus (iidc), are cut short (loopback)
///   status          one line of key=value to standard output
///   quit            unplug and end, as SIGINT and SIGTERM do
///
/// The end of standard input does not end the bench. All commands except `status` are answered on standard error.
///
/// Thread contract: thread-bound.
class CameraBench {
 public:
  using Clock = ImageFeed::Clock;

  CameraBench(std::unique_ptr<CameraOutput> output, std::unique_ptr<ImageFeed> feed)
      : output_(std::move(output)), feed_(std::move(feed)) {}

  /// Plugs in and runs until told to end; returns the exit code. `signals` is a signalfd.
  int run(int signals);
  /// Executes a command and returns the answer, which may be empty. Public for tests.
  std::string obey(const std::string& line);

 private:
  bool paced_by_clock() const { return feed_->descriptor() < 0; }
  void wait_and_serve(int signals);
  void tick(Clock::time_point now);
  void make_image();
  ImageFlaw next_flaw();
  void read_console();
  std::string status() const;

  std::unique_ptr<CameraOutput> output_;
  std::unique_ptr<ImageFeed> feed_;
  sim::LineReader console_;
  bool console_open_ = true, ended_ = false;
  Clock::time_point next_image_{};
  std::uint32_t number_ = 0;   // Of the next image
  std::uint32_t to_drop_ = 0;  // With clock pacing: number of periods without an image
  std::uint32_t to_cut_ = 0, to_mark_ = 0;
  std::uint64_t images_ = 0, late_ = 0;  // Images made; images due while the previous one was still being sent
  Octets image_;
};

}  // namespace azimuth::sim
