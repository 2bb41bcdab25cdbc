#include "daemon/origin.hpp"

#include <chrono>
#include <fmt/format.h>
#include <utility>

#include "base/clocks.hpp"
#include "daemon/devices/camera_source.hpp"
#include "daemon/devices/lcm_source.hpp"
#include "daemon/devices/odometer_sources.hpp"
#include "daemon/pipeline/played_source.hpp"
#include "drivers/camera/run_images.hpp"
#include "drivers/device/device_clock.hpp"
#include "drivers/iidc/iidc_stream.hpp"
#include "drivers/pioneer/device_link.hpp"
#include "drivers/storage/run.hpp"
#include "drivers/v4l2/v4l2_stream.hpp"
#include "settings/file_text.hpp"
#include "settings/rig.hpp"

namespace azimuth {
namespace {

FileResult<RigFile> read_rig_text(std::string toml, const std::string& file) {
  FileResult<Rig> rig = read_rig(toml, file);
  if (!rig) return failure(rig.error());
  return RigFile{file, std::move(toml), *rig};
}

FileResult<RigFile> read_rig_named(const std::string& file) {
  return file_text(file).and_then([&](std::string toml) { return read_rig_text(std::move(toml), file); });
}

/// Returns a function that reads the images of `run`, and keeps the run for it.
ReadFrame frames_of(Run run) {
  struct Images {
    explicit Images(Run from) : run(std::move(from)), images(run) {}
    Run run;
    RunImages images;
  };
  const auto images = std::make_shared<Images>(std::move(run));
  return [images](std::size_t index) { return images->images.recorded(index); };
}

std::unique_ptr<Source> played_source(Run run, bool with_frames, double speed) {
  Recording recording{std::move(run.odometry), std::move(run.bearings)};
  if (!with_frames) return std::make_unique<PlayedSource>(std::move(recording), speed);
  for (const FrameFile& frame : run.frames) recording.frames.push_back(frame.stamp);
  return std::make_unique<PlayedSource>(std::move(recording), speed, frames_of(std::move(run)));
}

/// Each source's number among the clients of the port resetter.
constexpr std::size_t kOdometerClient = 0, kCameraClient = 1;

UsbHelp usb_help(const UsbSettings& usb, const std::shared_ptr<PortResetter>& resetter, std::size_t client,
                 UsbHelp::Clock::duration longest_interval) {
  return {usb.hotplug ? std::make_unique<UsbMonitor>() : nullptr, resetter, client, longest_interval};
}

/// A session is left open only if a later start can continue it, which requires a map file.
PioneerSettings pioneer_settings(const DaemonSettings& daemon) {
  PioneerSettings settings = daemon.live.pioneer;
  settings.keep_session = settings.keep_session && !daemon.map.file.empty();
  return settings;
}

std::unique_ptr<Source> pioneer_source(const DaemonSettings& daemon, Duration epoch_minus_monotonic,
                                       const std::shared_ptr<PortResetter>& resetter) {
  const LiveSettings& live = daemon.live;
  AdapterHelp help;
  if (pioneer::DeviceLink::is_serial(live.pioneer.device))
    help.usb = usb_help(live.usb, resetter, kOdometerClient, std::chrono::hours(1));
  help.reset_after = std::chrono::duration<double>(live.usb.reset_after_s);
  return std::make_unique<PioneerSource>(pioneer_settings(daemon), epoch_minus_monotonic, std::move(help));
}

/// Finds the signals of a robot base on a CAN bus.
FileResult<CanLayout> can_layout(const CanSettings& can) {
  std::optional<Dbc> dbc;
  if (!can.dbc.empty()) {
    const FileResult<std::string> dbc_text = file_text(can.dbc);
    if (!dbc_text) return failure(dbc_text.error());
    FileResult<Dbc> read = read_dbc(*dbc_text, can.dbc);
    if (!read) return failure(read.error());
    dbc = *std::move(read);
  }
  return find_can_layout(can, dbc ? &*dbc : nullptr);
}

FileResult<std::unique_ptr<Source>> can_source(const LiveSettings& live, Duration epoch_minus_monotonic) {
  return can_layout(live.can).map([&](const CanLayout& layout) -> std::unique_ptr<Source> {
    return std::make_unique<CanSource>(live.can, layout, epoch_minus_monotonic);
  });
}

/// Adds the source of odometry, and its description for the log.
[[nodiscard]] FileResult<void> add_odometer(const DaemonSettings& daemon, const std::shared_ptr<PortResetter>& resetter,
                                            Origin& origin) {
  const LiveSettings& live = daemon.live;
  const Duration epoch = *origin.epoch_minus_monotonic;
  const auto add = [&](std::string description, std::unique_ptr<Source> source) {
    origin.description = "odometer: " + std::move(description);
    origin.sources.push_back(std::move(source));
    return FileResult<void>();
  };
  switch (live.odometer) {
    case OdometerKind::none:
      return failure(FileError{"daemon.live.odometer", 0, "is \"none\""});
    case OdometerKind::pioneer:
      return add("Pioneer at " + live.pioneer.device, pioneer_source(daemon, epoch, resetter));
    case OdometerKind::can: {
      FileResult<std::unique_ptr<Source>> source = can_source(live, epoch);
      if (!source) return failure(source.error());
      return add("CAN base at " + live.can.interface, *std::move(source));
    }
    case OdometerKind::lcm:
      return add("LCM, " + live.lcm.odometry_channel,
                 std::make_unique<LcmOdometerSource>(live.lcm, *parse_lcm_url(live.lcm.url), epoch));
    case OdometerKind::fifo:
      return add("FIFO at " + live.fifo.path, std::make_unique<FifoSource>(live.fifo, epoch));
  }
  return {};
}

/// The images must have the size given in the rig. The stamps are moved to the middle of the exposure.
std::unique_ptr<Source> own_camera(const LiveSettings& live, const Rig& rig, StreamOpener open, Duration epoch,
                                   const std::shared_ptr<PortResetter>& resetter) {
  CameraDriverSettings driver = live.own_camera.driver;
  driver.width_px = rig.camera.image.width_px.value_or(0);
  driver.height_px = rig.camera.image.height_px.value_or(0);
  const Duration latency = duration_from_seconds(live.own_camera.latency_s);
  return std::make_unique<CameraSource>(driver, std::move(open), epoch - latency,
                                        usb_help(live.usb, resetter, kCameraClient, std::chrono::minutes(10)));
}

StreamOpener v4l2_opener(V4l2Settings settings, const Rig& rig) {
  if (settings.width_px == 0 && rig.camera.image.width_px && rig.camera.image.height_px) {
    settings.width_px = *rig.camera.image.width_px;
    settings.height_px = *rig.camera.image.height_px;
  }
  settings.wants_colour = rig.front_end == FrontEnd::colour;
  return [settings] { return open_v4l2(settings); };
}

StreamOpener iidc_opener(IidcSettings settings, const Rig& rig) {
  if (settings.width_px == 0 && settings.height_px == 0) {
    settings.width_px = rig.camera.image.width_px.value_or(0);
    settings.height_px = rig.camera.image.height_px.value_or(0);
  }
  settings.wants_colour = rig.front_end == FrontEnd::colour;
  return [settings] { return open_iidc(settings); };
}

void add_camera(const LiveSettings& live, const std::shared_ptr<PortResetter>& resetter, Origin& origin) {
  const Duration epoch = *origin.epoch_minus_monotonic;
  const Rig& rig = origin.rig.rig;
  switch (live.camera) {
    case CameraKind::none:
      return;
    case CameraKind::shared: {
      origin.description += ", camera: " + live.camera_socket;
      origin.sources.push_back(
          std::make_unique<SharedCameraSource>(live.camera_socket, epoch, clock_duration(live.camera_silent_s)));
      return;
    }
    case CameraKind::v4l2:
      origin.description += ", camera: V4L2, " + live.v4l2.device;
      origin.sources.push_back(own_camera(live, rig, v4l2_opener(live.v4l2, rig), epoch, resetter));
      return;
    case CameraKind::iidc:
      origin.description += ", camera: IIDC, " + (live.iidc.guid.empty() ? "the first" : live.iidc.guid);
      origin.sources.push_back(own_camera(live, rig, iidc_opener(live.iidc, rig), epoch, resetter));
      return;
    case CameraKind::lcm:
      origin.description += ", camera: LCM, " + live.lcm.frames_channel;
      origin.sources.push_back(std::make_unique<LcmCameraSource>(live.lcm, *parse_lcm_url(live.lcm.url), epoch));
      return;
  }
}

}  // namespace

FileResult<Origin> recorded_origin(const DaemonSettings& daemon) {
  FileResult<Run> run =
      load_run(daemon.play.run, {.channel_prefix = daemon.publish.channel_prefix, .rig_file = daemon.rig});
  if (!run) return failure(run.error());
  FileResult<RigFile> rig = read_rig_text(run->rig_toml, run->rig_file);
  if (!rig) return failure(rig.error());
  Origin origin;
  origin.rig = std::move(rig).value();
  origin.first_stamp = first_stamp(*run);
  // Recorded bearings are those that the robot used. Images are processed only when there are no bearings.
  origin.needs_perception = run->bearings.empty() && origin.rig.rig.front_end != FrontEnd::bearings;
  const auto frames = [&] { return fmt::format("{} images", run->frames.size()); };
  origin.description =
      fmt::format("playing {}: {} odometry readings, {}, speed {}", daemon.play.run, run->odometry.size(),
                  origin.needs_perception ? frames() : fmt::format("{} bearing sets", run->bearings.size()),
                  daemon.play.speed == 0.0 ? "max" : fmt::format("{}", daemon.play.speed));
  if (const std::string lost = run->skipped.text(); !lost.empty()) origin.description += "; " + lost;
  origin.sources.push_back(played_source(*std::move(run), origin.needs_perception, daemon.play.speed));
  return origin;
}

FileResult<Origin> live_origin(const DaemonSettings& daemon) {
  const LiveSettings& live = daemon.live;
  FileResult<RigFile> rig = read_rig_named(daemon.rig);
  if (!rig) return failure(rig.error());
  Origin origin;
  origin.rig = std::move(rig).value();
  origin.needs_perception = origin.rig.rig.front_end != FrontEnd::bearings;
  origin.epoch_minus_monotonic = epoch_minus_monotonic();
  const auto resetter = live.usb.reset ? std::make_shared<PortResetter>() : nullptr;
  if (auto added = add_odometer(daemon, resetter, origin); !added) return failure(added.error());
  if (live.camera == CameraKind::lcm && !origin.needs_perception) {
    return failure(
        FileError{origin.rig.file, 0, "its front end takes bearings, but the camera is \"lcm\", which gives images"});
  }
  add_camera(live, resetter, origin);
  return origin;
}

}  // namespace azimuth
