// usb_camera: an emulated camera for kernels without hardware; see `usb_camera --help`.

#include <CLI/CLI.hpp>
#include <csignal>
#include <exception>
#include <sys/signalfd.h>

#include "tests/equipment/usb_camera/camera_bench.hpp"
#include "tests/equipment/usb_camera/iidc_camera.hpp"
#include "tests/equipment/usb_camera/log_line.hpp"
#include "tests/equipment/usb_camera/loopback_output.hpp"
#include "tests/equipment/usb_camera/uvc_camera.hpp"
#include "tests/equipment/usb_camera/vhci_output.hpp"

namespace {

namespace sim = azimuth::sim;

struct CameraWords {
  int port = 0, width_px = 640, height_px = 480;
  double rate_hz = 15.0;
  std::string device, serial = "SN0001", guid = "00b09d0100c0ffee", frames, camera_link, format = "yuyv";
};

void add_size(CLI::App& app, CameraWords& words) {
  app.add_option("WIDTH", words.width_px, "Pixels, even")->required()->check(CLI::Range(16, 4096));
  app.add_option("HEIGHT", words.height_px, "Pixels, even")->required()->check(CLI::Range(16, 4096));
  app.add_option("FPS", words.rate_hz, "Images a second")->required()->check(CLI::Range(0.1, 240.0));
}

void add_feed(CLI::App& app, CameraWords& words) {
  auto* frames = app.add_option("--frames", words.frames, "Raw images to send over and over, in the camera's layout");
  app.add_option("--camera-link", words.camera_link, "Send the images served at this socket, as they arrive")
      ->excludes(frames);
}

std::unique_ptr<sim::ImageFeed> make_feed(const CameraWords& words) {
  if (!words.camera_link.empty()) return std::make_unique<sim::LinkFeed>(words.camera_link);
  if (!words.frames.empty() && words.frames != "-") return std::make_unique<sim::FileFeed>(words.frames);
  return std::make_unique<sim::PatternFeed>();
}

int end_signals() {
  sigset_t set;
  ::sigemptyset(&set);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) ::sigaddset(&set, signal);
  ::sigprocmask(SIG_BLOCK, &set, nullptr);
  return ::signalfd(-1, &set, SFD_CLOEXEC);
}

int run(int argc, char** argv) {
  CameraWords words;
  CLI::App app(
      "A camera for a kernel to drive. Standard input takes: plug unplug freeze run hang drop N short [N] "
      "error [N] status quit.");
  app.require_subcommand(1);
  CLI::App* uvc = app.add_subcommand("uvc", "A webcam at a port of vhci_hcd");
  uvc->add_option("PORT", words.port, "Of the virtual host controller, from 0")->required()->check(CLI::Range(0, 7));
  add_size(*uvc, words);
  uvc->add_option("--serial", words.serial, "Serial number")->capture_default_str();
  add_feed(*uvc, words);
  CLI::App* iidc = app.add_subcommand("iidc", "An IIDC camera on USB there; its size and rate are the host's choice");
  iidc->add_option("PORT", words.port, "Of the virtual host controller, from 0")->required()->check(CLI::Range(0, 7));
  add_size(*iidc, words);
  iidc->add_option("--serial", words.serial, "Of the USB device")->capture_default_str();
  iidc->add_option("--guid", words.guid, "Of the camera, hexadecimal")->capture_default_str();
  add_feed(*iidc, words);
  CLI::App* loopback = app.add_subcommand("loopback", "The writing side of a v4l2loopback node");
  loopback->add_option("DEVICE", words.device, "/dev/videoN")->required();
  add_size(*loopback, words);
  loopback->add_option("--format", words.format)
      ->check(CLI::IsMember({"yuyv", "uyvy", "grey", "nv12", "mjpeg"}))
      ->capture_default_str();
  add_feed(*loopback, words);
  CLI11_PARSE(app, argc, argv);

  const int signals = end_signals();
  std::unique_ptr<sim::CameraOutput> output;
  if (*uvc) {
    auto camera =
        std::make_unique<sim::UvcCamera>(words.width_px & ~1, words.height_px & ~1, words.rate_hz, words.serial);
    output = std::make_unique<sim::VhciOutput>(std::move(camera), words.port);
  } else if (*iidc) {
    auto camera = std::make_unique<sim::IidcCamera>(std::stoull(words.guid, nullptr, 16), words.serial);
    output = std::make_unique<sim::VhciOutput>(std::move(camera), words.port);
  } else {
    const sim::WireShape shape{*sim::wire_format(words.format), words.width_px & ~1, words.height_px & ~1};
    output = std::make_unique<sim::LoopbackOutput>(words.device, shape, words.rate_hz);
  }
  return sim::CameraBench(std::move(output), make_feed(words)).run(signals);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    sim::log_line(error.what());
    return 1;
  }
}
