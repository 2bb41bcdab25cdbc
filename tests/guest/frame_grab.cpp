// frame_grab reads images of a camera with the daemon's drivers and prints one line per image. `frame_grab --help`
// describes it.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <functional>
#include <poll.h>
#include <string>
#include <string_view>
#include <vector>

#include "daemon/config/daemon_settings.hpp"
#include "drivers/camera/camera_driver.hpp"
#include "drivers/iidc/iidc_stream.hpp"
#include "drivers/v4l2/v4l2_stream.hpp"
#include "settings/reader.hpp"
#include "tests/equipment/usb_camera/wire_image.hpp"

namespace {

using azimuth::CameraDriver;
using Clock = CameraDriver::Clock;

struct GrabWords {
  std::string kind;
  std::vector<std::string> assignments;
  std::uint64_t frames = 10;
  double for_s = 60.0;
  bool until_failed = false;
};

/// Applies the assignments. "mode=auto" belongs to the table of the camera's kind, "camera.silent_s=2" to another table
/// under [daemon]. "formats=YUYV" is no key of the daemon, which chooses among a camera's formats itself.
bool apply(const GrabWords& words, azimuth::DaemonSettings& settings) {
  std::vector<azimuth::Section> sections = azimuth::daemon_sections(settings);
  const std::vector<azimuth::Section*> tables = azimuth::pointers(sections);
  azimuth::FileErrors violations;
  for (const std::string& assignment : words.assignments) {
    if (constexpr std::string_view kFormats = "formats="; assignment.starts_with(kFormats)) {
      settings.live.v4l2.formats = assignment.substr(kFormats.size());
      continue;
    }
    const bool elsewhere = assignment.substr(0, assignment.find('=')).find('.') != std::string::npos;
    const std::string whole = "daemon." + (elsewhere ? "" : words.kind + ".") + assignment;
    for (const azimuth::FileError& violation : azimuth::apply_override(whole, tables)) violations.push_back(violation);
  }
  for (const azimuth::FileError& violation : azimuth::check(settings)) violations.push_back(violation);
  for (const azimuth::FileError& violation : violations) std::fprintf(stderr, "%s\n", violation.text().c_str());
  return violations.empty();
}

azimuth::StreamOpener opener(const std::string& kind, const azimuth::DaemonSettings& settings) {
  if (kind == "iidc") return [iidc = settings.live.iidc] { return azimuth::open_iidc(iidc); };
  return [v4l2 = settings.live.v4l2] { return azimuth::open_v4l2(v4l2); };
}

/// The first four bytes of the image as a number, in which emulated cameras count their images.
std::uint32_t number_of(const azimuth::Frame& frame) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < 4 && i < frame.bytes().size(); ++i)
    number |= std::to_integer<std::uint32_t>(frame.bytes()[i]) << 8U * i;
  return number;
}

/// True if all bytes are those of a test image. The pattern depends on the byte position only, not on the layout.
bool is_whole_pattern(const azimuth::Frame& frame) {
  const azimuth::sim::WireShape shape{azimuth::sim::WireFormat::grey, static_cast<int>(frame.bytes().size()), 1};
  const auto* const first = reinterpret_cast<const std::uint8_t*>(frame.bytes().data());
  return azimuth::sim::check_pattern(shape, {first, frame.bytes().size()}).has_value();
}

/// A hash of the bytes of the image.
std::size_t digest_of(const azimuth::Frame& frame) {
  const auto* const first = reinterpret_cast<const char*>(frame.bytes().data());
  return std::hash<std::string_view>{}({first, frame.bytes().size()});
}

void tell_events(CameraDriver& driver) {
  for (std::string event; driver.take_event(event);) std::fprintf(stderr, "%s\n", event.c_str());
}

void tell(const azimuth::CameraState& state) {
  std::printf("images %llu missing %llu corrupt %llu dropped %llu reopenings %llu silences %llu\n",
              static_cast<unsigned long long>(state.images), static_cast<unsigned long long>(state.missing),
              static_cast<unsigned long long>(state.corrupt), static_cast<unsigned long long>(state.stamps_dropped),
              static_cast<unsigned long long>(state.reopenings()), static_cast<unsigned long long>(state.silences));
}

void wait(const CameraDriver& driver) {
  constexpr std::int64_t kLongest_ms = 100;
  pollfd event{driver.descriptor(), driver.poll_events(), 0};
  const auto due = std::chrono::ceil<std::chrono::milliseconds>(driver.due_in(Clock::now()));
  ::poll(&event, 1, static_cast<int>(std::min<std::int64_t>(due.count(), kLongest_ms)));
}

int grab(const GrabWords& words, const azimuth::DaemonSettings& settings) {
  CameraDriver driver(settings.live.own_camera.driver, opener(words.kind, settings));
  const auto end =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(words.for_s));
  azimuth::Frame frame;
  std::uint64_t came = 0;
  bool failed = false;
  while (Clock::now() < end && !failed && (words.until_failed || came < words.frames)) {
    wait(driver);
    driver.turn(Clock::now());
    while ((words.until_failed || came < words.frames) && driver.take(frame)) {
      std::printf("%llu %lld %u %llu %d %zx\n", static_cast<unsigned long long>(frame.sequence),
                  static_cast<long long>(azimuth::to_us(frame.stamp)), number_of(frame),
                  static_cast<unsigned long long>(driver.state().corrupt), is_whole_pattern(frame), digest_of(frame));
      std::fflush(stdout);
      ++came;
    }
    tell_events(driver);
    failed = words.until_failed && came > 0 && driver.state().connection != azimuth::Connection::running;
  }
  tell(driver.state());
  return (words.until_failed ? failed : came == words.frames) ? 0 : 1;
}

int run(int argc, char** argv) {
  GrabWords words;
  CLI::App app(
      "Prints a line for each image: its sequence number, its stamp on CLOCK_MONOTONIC in us, its first four bytes as "
      "a "
      "number, how many corrupt ones there have been, 1 when it is a whole test image of usb_camera, and a digest of "
      "its bytes; then the counters. Events go to standard error.");
  app.add_option("KIND", words.kind, "iidc or v4l2")->required()->check(CLI::IsMember({"iidc", "v4l2"}));
  app.add_option("KEY=VALUE", words.assignments,
                 "Settings of [daemon.KIND]; with a table's name, of another one; formats=CODE of V4L2");
  app.add_option("--frames", words.frames, "Exit code 0 when so many came")->capture_default_str();
  app.add_option("--for", words.for_s, "Seconds at most")->capture_default_str();
  app.add_flag("--until-failed", words.until_failed, "Exit code 0 when the camera fails or falls silent, after images");
  CLI11_PARSE(app, argc, argv);
  azimuth::DaemonSettings settings;
  return apply(words, settings) ? grab(words, settings) : 2;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
