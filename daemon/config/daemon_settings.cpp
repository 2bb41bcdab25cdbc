#include "daemon/config/daemon_settings.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "daemon/config/can_section.hpp"
#include "daemon/config/lcm_source_section.hpp"
#include "drivers/pioneer/device_link.hpp"

namespace azimuth {
namespace {

constexpr double kMaxCpu = 1023;         // CPU_SETSIZE - 1
constexpr double kMaxFifoPriority = 99;  // sched(7)

constexpr auto kProviders = std::to_array<std::string_view>({"udpm://", "tcpq://", "memq://", "file://"});
constexpr std::size_t kLongestPrefix = 40;  // LCM allows 63 for the whole channel

Section top_section(DaemonSettings& settings) {
  return {"daemon",
          "The daemon itself.",
          {everyday(path_key("rig", settings.rig, "rig.toml of the robot; of a recording instead of its own.")),
           everyday(choice<LogLevel>("log_level", settings.log_level,
                                     {{"debug", LogLevel::debug},
                                      {"info", LogLevel::info},
                                      {"warning", LogLevel::warning},
                                      {"error", LogLevel::error}},
                                     "Least severity of what is logged."))}};
}

Section play_section(PlaySettings& play) {
  return {"daemon.play",
          "The source that plays a recording.",
          {everyday(path_key("run", play.run, "Run folder or LCM log.")),
           {"speed", &play.speed, "Times the recording's own pace; 0: as fast as possible.", from_to(0, 1e6)},
           {"hold", &play.hold, "Keep running when the recording has ended."}}};
}

Section live_section(LiveSettings& live) {
  return {"daemon.live",
          "The robot's own sensors, used when nothing is played. They may come and go while the daemon runs.",
          {everyday(choice<OdometerKind>("odometer", live.odometer,
                                         {{"none", OdometerKind::none},
                                          {"pioneer", OdometerKind::pioneer},
                                          {"can", OdometerKind::can},
                                          {"lcm", OdometerKind::lcm},
                                          {"fifo", OdometerKind::fifo}},
                                         "Where wheel odometry comes from. fifo: lines that another program writes.")),
           everyday(choice<CameraKind>(
               "camera", live.camera,
               {{"none", CameraKind::none},
                {"shared", CameraKind::shared},
                {"v4l2", CameraKind::v4l2},
                {"iidc", CameraKind::iidc},
                {"lcm", CameraKind::lcm}},
               "Where images or bearings come from. shared: another process on this machine (azimuth-sim); "
               "v4l2: a camera of the kernel's video interface; iidc: one on FireWire, or its kin on USB; "
               "lcm: another process, by messages.")),
           everyday(path_key("camera_socket", live.camera_socket, "Unix socket of a shared camera.")),
           {"camera_silent_s", &live.camera_silent_s,
            "A shared camera that has sent nothing for so long is in trouble.", above_to(0, 600)}}};
}

Key feature(std::string_view name, PioneerFeature& member, std::string_view help) {
  return choice<PioneerFeature>(
      name, member, {{"auto", PioneerFeature::automatic}, {"on", PioneerFeature::on}, {"off", PioneerFeature::off}},
      help);
}

/// Of what may also be an address.
std::string_view serial_device(std::string_view device) {
  return pioneer::DeviceLink::is_serial(std::string(device)) ? device : std::string_view();
}

/// The log in file://LOG?mode=w; other providers have none.
std::string_view log_of_url(std::string_view url) {
  constexpr std::string_view kFile = "file://";
  return url.starts_with(kFile) ? url.substr(kFile.size(), url.find('?') - kFile.size()) : std::string_view();
}

Section pioneer_section(PioneerSettings& pioneer) {
  return {
      "daemon.pioneer",
      "The Pioneer's controller. It is only read: motors are never enabled, and the robot is never moved.",
      {everyday({"device", PathText{&pioneer.device, serial_device}, "Serial device, or tcp:HOST:PORT."}),
       {"baud", &pioneer.baud, "Baud rate to begin with; 0: search.", from_to(0, 115200)},
       {"raised_baud", &pioneer.raised_baud, "Rate to change to where the firmware allows it; 0: stay.",
        from_to(0, 115200)},
       everyday({"subclass", &pioneer.subclass, "Kind of robot, e.g. p3dx-sh; empty: what the robot says."}),
       {"distance_mm_per_unit", &pioneer.distance_mm_per_unit, "Position unit; 0: by subclass.", from_to(0, 100)},
       {"heading_units_per_turn", &pioneer.heading_units_per_turn, "Heading unit; 0: by subclass.", from_to(0, 1e6)},
       {"ticks_per_mm", &pioneer.ticks_per_mm, "Encoder ticks of a wheel; 0: as the robot says.", from_to(0, 1e5)},
       {"ticks_per_turn", &pioneer.ticks_per_turn,
        "Difference of the wheels' ticks over a turn in place, calibrated; 0: heading from the controller.",
        from_to(0, 1e7)},
       feature("encoder", pioneer.encoder, "Use wheel ticks, which are finer than a millimetre."),
       everyday(feature("gyro", pioneer.gyro, "Use the analog gyro, unless the firmware does so itself.")),
       everyday(
           {"keep_session", &pioneer.keep_session,
            "Where a map is kept, leave the session open on a stop: the controller counts on, and the next start knows "
            "where the robot is. false: end it, for other programs that do not take over an open one."}),
       {"usb_latency_s", &pioneer.usb_latency_s, "From a byte's end on the wire to its arrival.", from_to(0, 0.1)},
       {"stale_s", &pioneer.stale_s, "Odometry that has not come for so long counts as silent.", above_to(0, 60)},
       {"lost_s", &pioneer.lost_s, "After so long without odometry the connection is made anew.", above_to(0, 60)},
       {"max_speed_m_s", &pioneer.max_speed_m_s, "The fastest the robot can be; faster steps are not trusted.",
        above_to(0, 20)},
       {"max_turn_rad_s", &pioneer.max_turn_rad_s, "The fastest the robot can turn; faster turns are not trusted.",
        above_to(0, 100)}}};
}

Section fifo_section(FifoSettings& fifo) {
  return {
      "daemon.fifo",
      "Odometry that another program writes into a FIFO, a line a reading: stamp_s,x_m,y_m,heading_rad. The pose is "
      "cumulative; the stamp is of CLOCK_MONOTONIC (time.monotonic() in Python).",
      {everyday(path_key("path", fifo.path, "Of the FIFO, which is made if nothing is there.")),
       {"silent_s", &fifo.silent_s, "A writer that writes nothing for so long is in trouble.", above_to(0, 60)}}};
}

Section usb_section(UsbSettings& usb) {
  return {
      "daemon.usb",
      "What USB may do for cameras and serial adapters.",
      {{"hotplug", &usb.hotplug, "Try devices at once when something is plugged in. Needs udev."},
       everyday(
           {"reset", &usb.reset,
            "Reset the port of a device that hangs, at most once a minute. Needs write permission in /dev/bus/usb."}),
       {"reset_after_s", &usb.reset_after_s,
        "Silence after which a serial adapter seems to hang. A robot that is switched off is as silent: resets in "
        "vain become rarer, down to one an hour.",
        from_to(3, 3600)}}};
}

Section record_section(RecordSettings& record) {
  return {
      "daemon.record",
      "The field log: all that a replay needs for the same estimates bit for bit, and what was published.",
      {everyday(path_key("folder", record.folder, "Where sessions are recorded; empty: nothing is.")),
       {"max_file_mb", &record.max_file_mb, "A file of this size is closed and the next begun.", above_to(0, 1e6)},
       {"max_file_age_s", &record.max_file_age_s, "A file of this age is closed and the next begun.", above_to(0, 1e6)},
       everyday({"quota_mb", &record.quota_mb, "All sessions together; the oldest files give way. 0: no limit.",
                 from_to(0, 1e9)}),
       {"min_free_mb", &record.min_free_mb, "Left free on the disk, at the cost of old files, then of recording.",
        from_to(0, 1e9)},
       {"flush_interval_s", &record.flush_interval_s, "The most that a sudden end of the process loses.",
        above_to(0, 60)},
       everyday(choice<RecordedFrames>(
           "frames", record.frames,
           {{"none", RecordedFrames::none}, {"jpeg", RecordedFrames::jpeg}, {"raw", RecordedFrames::raw}},
           "Record images as well, so that a replay can look at them anew (azimuth replay "
           "--perceive). raw: as the camera sent them; a replay finds the very same in them. "
           "jpeg: a tenth of that, but edges and colours change a little, and so does what is "
           "found; images of a camera that sends JPEG stay as they came.")),
       everyday({"frames_rate_hz", &record.frames_rate_hz, "Images a second at most; 0: every one that was looked at.",
                 from_to(0, 1000)}),
       {"frames_quality", &record.frames_quality, "Quality of recorded JPEG images.", from_to(1, 100)},
       everyday({"frames_quota_mb", &record.frames_quota_mb,
                 "Images of all sessions together, beside quota_mb: the oldest give way, samples never. 0: no limit.",
                 from_to(0, 1e9)})}};
}

Section map_keeper_section(MapSettings& map) {
  return {
      "daemon.map",
      "The map that outlives the daemon: loaded at the start as the table [map] says, saved while it runs. A robot "
      "that only localises never writes it.",
      {everyday(
           path_key("file", map.file, "Map file, e.g. /var/lib/azimuth/map.azmap; empty: none is loaded or saved.")),
       everyday({"save_interval_s", &map.save_interval_s, "Between two saves; 0: only on an orderly stop.",
                 from_to(0, 86400)}),
       {"recent_s", &map.recent_s,
        "A robot whose map is no older than this when the daemon starts is looked for only as far as it can have come "
        "since. 0: always anywhere.",
        from_to(0, 86400)},
       {"fastest_m_per_s", &map.fastest_m_per_s,
        "How fast the robot may have driven, or been carried, while the daemon did not run.", from_to(0, 100)}}};
}

Section lcm_section(PublishSettings& publish) {
  return {"daemon.lcm",
          "What is published, where and how often.",
          {everyday({"url", PathText{&publish.lcm_url, log_of_url},
                     "LCM provider. ttl=0 keeps the messages on this machine."}),
           everyday({"channel_prefix", &publish.channel_prefix, "Put before every channel's name."}),
           everyday({"map_rate_hz", &publish.map_rate_hz, "How often the map is sent; 0: only at the end.",
                     from_to(0, 100)}),
           everyday({"echo_samples", &publish.echo_samples, "Send odometry and bearings as well."}),
           {"print_poses", &publish.print_poses, "Print a line for the pose of every step."}}};
}

Section picture_section(PictureSettings& picture) {
  return {"daemon.picture",
          "Pictures of what was seen in an image and what the map expected, to look at. Images only.",
          {everyday({"rate_hz", &picture.rate_hz, "How often at most; 0: never.", from_to(0, 100)}),
           everyday(path_key("file", picture.file, "JPEG file that always holds the newest; empty: none.")),
           {"publish", &picture.publish, "Send them over LCM as well."},
           {"quality", &picture.quality, "Quality of the picture's JPEG.", from_to(1, 100)}}};
}

Section realtime_section(DaemonSettings& settings) {
  ThreadSettings& threads = settings.threads;
  const Range priority = from_to(0, kMaxFifoPriority), cpu = from_to(-1, kMaxCpu);
  return {"daemon.realtime",
          "Scheduling. What the system refuses is reported, and the daemon runs without it.",
          {everyday({"lock_memory", &settings.lock_memory,
                     "Keep the whole process in memory (mlockall), from its first pose on."}),
           everyday({"source_fifo_priority", &threads.source.fifo_priority, "SCHED_FIFO priority; 0: none.", priority}),
           {"perception_fifo_priority", &threads.perception.fifo_priority, "SCHED_FIFO priority; 0: none.", priority},
           everyday({"estimator_fifo_priority", &threads.estimator.fifo_priority, "SCHED_FIFO priority; 0: none.",
                     priority}),
           {"publisher_fifo_priority", &threads.publisher.fifo_priority, "SCHED_FIFO priority; 0: none.", priority},
           {"recorder_fifo_priority", &threads.recorder.fifo_priority, "SCHED_FIFO priority; 0: none.", priority},
           {"source_cpu", &threads.source.cpu, "The only CPU the thread may run on; -1: any.", cpu},
           {"perception_cpu", &threads.perception.cpu, "The only CPU the thread may run on; -1: any.", cpu},
           {"estimator_cpu", &threads.estimator.cpu, "The only CPU the thread may run on; -1: any.", cpu},
           {"publisher_cpu", &threads.publisher.cpu, "The only CPU the thread may run on; -1: any.", cpu},
           {"recorder_cpu", &threads.recorder.cpu, "The only CPU the thread may run on; -1: any.", cpu},
           everyday({"deadline_ms", &threads.deadline_ms,
                     "A stage whose turn takes longer counts as hung and stops the watchdog from being fed.",
                     from_to(200, 600000)})}};
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
