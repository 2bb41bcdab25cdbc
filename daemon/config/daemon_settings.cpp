#include "daemon/config/daemon_settings.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "drivers/pioneer/device_link.hpp"

namespace azimuth {
namespace {

constexpr double kMaxCpu = 1023;         // CPU_SETSIZE - 1
constexpr double kMaxFifoPriority = 99;  // sched(7)

constexpr auto kProviders = std::to_array<std::string_view>({"udpm://", "tcpq://", "memq://", "file://"});
constexpr std::size_t kLongestPrefix = 40;  // LCM allows 63 characters for the whole channel name

Section top_section(DaemonSettings& settings) {
  return {"daemon",
          "The daemon itself.",
          {path_key("rig", settings.rig, "rig.toml of the robot; for a recording, it replaces the recording's own."),
           choice<LogLevel>("log_level", settings.log_level,
                            {{"debug", LogLevel::debug},
                             {"info", LogLevel::info},
                             {"warning", LogLevel::warning},
                             {"error", LogLevel::error}},
                            "Least severity of the messages that are logged.")}};
}

Section play_section(PlaySettings& play) {
  return {
      "daemon.play",
      "The playback of a recording.",
      {path_key("run", play.run, "Run folder or LCM log to play."),
       {"speed", &play.speed, "Speed, as a multiple of the recording's own; 0: as fast as possible.", from_to(0, 1e6)},
       {"hold", &play.hold, "Keep running after the end of the recording."}}};
}

Section live_section(LiveSettings& live) {
  return {"daemon.live",
          "The robot's own sensors, used when nothing is played. They may come and go while the daemon runs.",
          {choice<OdometerKind>("odometer", live.odometer,
                                {{"none", OdometerKind::none},
                                 {"pioneer", OdometerKind::pioneer},
                                 {"can", OdometerKind::can},
                                 {"lcm", OdometerKind::lcm},
                                 {"fifo", OdometerKind::fifo}},
                                "Source of the wheel odometry. fifo: lines that another program writes."),
           choice<CameraKind>("camera", live.camera,
                              {{"none", CameraKind::none},
                               {"shared", CameraKind::shared},
                               {"v4l2", CameraKind::v4l2},
                               {"iidc", CameraKind::iidc},
                               {"lcm", CameraKind::lcm}},
                              "Source of the images or bearings. shared: another process on this machine "
                              "(azimuth-sim); v4l2: a camera of the kernel's video interface; iidc: a camera on "
                              "FireWire, or its kin on USB; lcm: another process, by messages."),
           path_key("camera_socket", live.camera_socket, "Unix socket of a shared camera.")}};
}

Key feature(std::string_view name, PioneerFeature& member, std::string_view help) {
  return choice<PioneerFeature>(
      name, member, {{"auto", PioneerFeature::automatic}, {"on", PioneerFeature::on}, {"off", PioneerFeature::off}},
      help);
}

/// The device if it is a serial one; empty: the setting is a network address.
std::string_view serial_device(std::string_view device) {
  return pioneer::DeviceLink::is_serial(std::string(device)) ? device : std::string_view();
}

/// The path of the log in file://LOG?mode=w; empty for other providers, which have no log.
std::string_view log_of_url(std::string_view url) {
  constexpr std::string_view kFile = "file://";
  return url.starts_with(kFile) ? url.substr(kFile.size(), url.find('?') - kFile.size()) : std::string_view();
}

Section pioneer_section(PioneerSettings& pioneer) {
  return {"daemon.pioneer",
          "The Pioneer's controller. It is only read: motors are never enabled, and the robot is never moved.",
          {{"device", PathText{&pioneer.device, serial_device}, "Serial device of the controller, or tcp:HOST:PORT."},
           {"baud", &pioneer.baud, "Baud rate to begin with; 0: search for it.", from_to(0, 115200)},
           {"subclass", &pioneer.subclass, "Kind of robot, e.g. p3dx-sh; empty: what the robot says."},
           {"ticks_per_turn", &pioneer.ticks_per_turn,
            "Calibrated difference of the two wheels' ticks over one turn in place; 0: take the heading from the "
            "controller.",
            from_to(0, 1e7)},
           feature("gyro", pioneer.gyro, "Use the analog gyro, unless the firmware does so itself."),

           {"keep_session", &pioneer.keep_session,
            "Leave the controller's session open on a stop, where a map is kept: the controller counts on, and the "
            "next start knows where the robot is. false: end the session, for other programs that do not take over an "
            "open one."}}};
}

Section fifo_section(FifoSettings& fifo) {
  return {"daemon.fifo",
          "Odometry that another program writes into a FIFO, one line per reading: stamp_s,x_m,y_m,heading_rad. The "
          "pose is cumulative; the stamp is of CLOCK_MONOTONIC (time.monotonic() in Python).",
          {path_key("path", fifo.path, "Path of the FIFO; the daemon makes it if nothing is there.")}};
}

Section usb_section(UsbSettings& usb) {
  return {"daemon.usb",
          "Cameras and serial adapters on USB.",
          {{"reset", &usb.reset,
            "Reset the port of a device that hangs, at most once a minute. Needs write permission in /dev/bus/usb."}}};
}

Section record_section(RecordSettings& record) {
  return {
      "daemon.record",
      "The field log: everything that a replay needs for the same estimates bit for bit, and the published messages.",
      {path_key("folder", record.folder, "Folder for the recorded sessions; empty: nothing is recorded."),
       {"quota_mb", &record.quota_mb,
        "Most space of all sessions together; the oldest files are deleted first. 0: no limit.", from_to(0, 1e9)},
       {"min_free_mb", &record.min_free_mb,
        "Space to leave free on the disk: old files are deleted, and then recording stops.", from_to(0, 1e9)},
       choice<RecordedFrames>(
           "frames", record.frames,
           {{"none", RecordedFrames::none}, {"jpeg", RecordedFrames::jpeg}, {"raw", RecordedFrames::raw}},
           "Images to record, so that a replay can look at them anew (azimuth replay --perceive). raw: as the camera "
           "sent them; a replay finds exactly the same in them. jpeg: a tenth of that size, but edges and colours "
           "change a little, and so do the bearings; images of a camera that sends JPEG stay as they came."),
       {"frames_rate_hz", &record.frames_rate_hz,
        "Most recorded images per second; 0: every image that the front end looked at.", from_to(0, 1000)},
       {"frames_quality", &record.frames_quality, "Quality of recorded JPEG images.", from_to(1, 100)},
       {"frames_quota_mb", &record.frames_quota_mb,
        "Most space of the images of all sessions together, beside quota_mb: the oldest images are deleted first, "
        "samples never. 0: no limit.",
        from_to(0, 1e9)}}};
}

Section map_keeper_section(MapSettings& map) {
  return {"daemon.map",
          "The map that outlives the daemon: loaded at the start as the table [map] says, saved while it runs. A robot "
          "that only localises never writes it.",
          {path_key("file", map.file, "Map file, e.g. /var/lib/azimuth/map.azmap; empty: none is loaded or saved."),
           {"save_interval_s", &map.save_interval_s, "Time between two saves; 0: save only on an orderly stop.",
            from_to(0, 86400)}}};
}

Section lcm_section(PublishSettings& publish) {
  return {"daemon.lcm",
          "Messages that the daemon publishes over LCM.",
          {{"url", PathText{&publish.lcm_url, log_of_url},
            "LCM provider to publish on. ttl=0 keeps the messages on this machine."},
           {"channel_prefix", &publish.channel_prefix, "Prefix of every channel's name."},
           {"map_rate_hz", &publish.map_rate_hz, "Rate at which the map is sent; 0: only at the end.", from_to(0, 100)},
           {"echo_samples", &publish.echo_samples, "Publish odometry and bearings, too."}}};
}

Section picture_section(PictureSettings& picture) {
  return {"daemon.picture",
          "Pictures, for people, of the landmarks that an image shows and of those that the map expected; only with "
          "images.",
          {{"rate_hz", &picture.rate_hz, "Most pictures per second; 0: none.", from_to(0, 100)},
           path_key("file", picture.file, "JPEG file that always holds the newest picture; empty: none."),
           {"publish", &picture.publish, "Publish the pictures over LCM, too."}}};
}

Section realtime_section(DaemonSettings& settings) {
  ThreadSettings& threads = settings.threads;
  const Range priority = from_to(0, kMaxFifoPriority), cpu = from_to(-1, kMaxCpu);
  return {
      "daemon.realtime",
      "Scheduling of the threads. The daemon reports what the system refuses, and runs without it.",
      {{"lock_memory", &settings.lock_memory, "Keep the whole process in memory (mlockall), from its first pose on."},
       {"source_fifo_priority", &threads.source.fifo_priority, "SCHED_FIFO priority of the source thread; 0: none.",
        priority},
       {"perception_fifo_priority", &threads.perception.fifo_priority,
        "SCHED_FIFO priority of the perception thread; 0: none.", priority},
       {"estimator_fifo_priority", &threads.estimator.fifo_priority,
        "SCHED_FIFO priority of the estimator thread; 0: none.", priority},
       {"source_cpu", &threads.source.cpu, "The only CPU that the source thread may run on; -1: any.", cpu},
       {"perception_cpu", &threads.perception.cpu, "The only CPU that the perception thread may run on; -1: any.", cpu},
       {"estimator_cpu", &threads.estimator.cpu, "The only CPU that the estimator thread may run on; -1: any.", cpu},
       {"deadline_ms", &threads.deadline_ms,
        "Longest turn of a stage: a stage that takes longer counts as hung, and the watchdog is no longer fed.",
        from_to(200, 600000)}}};
}

}  // namespace

FileErrors check(const DaemonSettings& settings) {
  FileErrors violations;
  const auto provides = [&](std::string_view provider) { return settings.publish.lcm_url.starts_with(provider); };
  if (std::none_of(kProviders.begin(), kProviders.end(), provides)) {
    violations.push_back(
        {"daemon.lcm.url", 0,
         "is \"" + settings.publish.lcm_url + "\", must begin with udpm://, tcpq://, memq:// or file://"});
  }
  if (settings.publish.channel_prefix.size() > kLongestPrefix) {
    violations.push_back(
        {"daemon.lcm.channel_prefix", 0, "is longer than " + std::to_string(kLongestPrefix) + " characters"});
  }
  const LiveSettings& live = settings.live;
  if (settings.play.run.empty() && live.odometer != OdometerKind::none && settings.rig.empty())
    violations.push_back({"daemon.rig", 0, "is missing: a robot's own sensors need its rig.toml"});
  if (live.camera != CameraKind::none && live.odometer == OdometerKind::none)
    violations.push_back({"daemon.live.odometer", 0, "is \"none\": a camera alone is not enough"});
  for (FileError& violation : check(live.v4l2)) violations.push_back(std::move(violation));
  for (FileError& violation : check(live.iidc)) violations.push_back(std::move(violation));
  for (FileError& violation : check(live.lcm, settings.publish)) violations.push_back(std::move(violation));
  return violations;
}

std::vector<Section> daemon_sections(DaemonSettings& settings) {
  std::vector<Section> sections{top_section(settings),
                                live_section(settings.live),
                                pioneer_section(settings.live.pioneer),
                                usb_section(settings.live.usb),
                                own_camera_section(settings.live.own_camera),
                                v4l2_section(settings.live.v4l2),
                                iidc_section(settings.live.iidc),
                                play_section(settings.play),
                                record_section(settings.record),
                                map_keeper_section(settings.map),
                                lcm_section(settings.publish),
                                picture_section(settings.picture),
                                realtime_section(settings)};
  for (Section& section : can_sections(settings.live.can)) sections.push_back(std::move(section));
  sections.push_back(lcm_source_section(settings.live.lcm));
  sections.push_back(fifo_section(settings.live.fifo));
  return sections;
}

}  // namespace azimuth
