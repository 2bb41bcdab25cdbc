#include "sim/azimuth_sim/options.hpp"

#include <CLI/CLI.hpp>
#include <utility>

#include "drivers/pioneer/protocol.hpp"
#include "settings/command_line/command_line.hpp"
#include "sim/azimuth_sim/can_base.hpp"
#include "sim/world/scenario.hpp"

namespace azimuth::sim {
namespace {

/// The raw values that CLI11 fills in, before conversion.
struct Words {
  std::string scenario = "lab", subclass = "p3dx-sh", tcp, images, image_format = "rgb8";
  double image_rate_hz = 15.0, image_scale = 1.0, image_noise = 1.5;
  std::uint64_t seed = 1;
  int laps = 0, baud = 9600;
  bool no_identities = false, gyro = false, keep_baud = false, stand = false;
  double clutter_per_set = 0.0, every_s = 0.0;
  std::vector<std::string> faults, timed, cycle;
};

std::string known_scenarios() {
  std::string names;
  for (const std::string_view name : kScenarioNames) names += (names.empty() ? "" : ", ") + std::string(name);
  return names;
}

/// The parsed value; throws CLI11's validation error if there is none.
template <class Value>
Value or_refuse(tl::expected<Value, std::string> parsed, const char* option) {
  if (!parsed) throw CLI::ValidationError(option, parsed.error());
  return *std::move(parsed);
}

void add_robot_options(CLI::App& app, Options& options, Words& words) {
  app.add_option("--device", options.device, "Make this link lead to the robot's serial port (a pseudo-terminal)");
  app.add_option("--tcp", words.tcp, "Serve the robot's line at this port of 127.0.0.1 instead; 0: a free one")
      ->excludes("--device");
  app.add_option("--can", options.can_interface,
                 "Report as a base on the bus of this CAN interface, beside the serial line or instead of it");
  app.add_option("--baud", words.baud, "Baud rate after power-up: 9600, 19200, 38400, 57600 or 115200")
      ->capture_default_str();
  app.add_flag("--keep-baud", words.keep_baud,
               "Simulate a controller that does not fall back by itself to the baud rate after power-up");
  app.add_option("--subclass", words.subclass, "Kind of robot: " + known_subclasses())->capture_default_str();
  app.add_flag("--gyro", words.gyro, "The robot has an analog gyro");
}

void add_drive_options(CLI::App& app, Options& options, Words& words) {
  auto* const stand =
      app.add_flag("--stand-still", words.stand, "Stand still where no client drives, instead of following a path");
  app.add_option("--laps", words.laps, "Number of laps; 0: as many as the world says")
      ->check(CLI::Range(0, 10000))
      ->excludes(stand);
  app.add_flag("--end-at-arrival", options.end_at_arrival, "End when the robot reaches the end of its path")
      ->excludes(stand);
}

void add_world_options(CLI::App& app, Options& options, Words& words) {
  app.add_option("--scenario", words.scenario, "World to simulate")
      ->type_name(choices_text({kScenarioNames.begin(), kScenarioNames.end()}))
      ->capture_default_str();
  app.add_option("--seed", words.seed, "Seed of the world, the noise and the faults")->capture_default_str();
  app.add_flag("--no-identities", words.no_identities, "Send bearings without the identities of their landmarks");
  app.add_option("--clutter", words.clutter_per_set, "Mean number of false bearings per set")
      ->check(CLI::Range(0.0, 100.0));
  app.add_option("--speed", options.speed, "Speed, as a multiple of real time")->check(CLI::Range(0.01, 100.0));
  app.add_option("--duration", options.duration_s, "End after this many simulated seconds; 0: end only when told to")
      ->check(CLI::Range(0.0, 1e7));
}

void add_output_options(CLI::App& app, Options& options) {
  app.add_option("--camera-socket", options.camera_socket, "Serve the camera's samples at this unix socket");
  app.add_option("--truth", options.files.truth, "Write the robot's true poses (CSV)");
  app.add_option("--sip-log", options.files.sip_log, "Write the true time of each SIP's odometry (CSV)");
  app.add_option("--run-folder", options.files.run_folder,
                 "Write a run folder: rig, landmarks, truth, and the samples that ideal devices would have recorded");
  app.add_option("--control", options.control_socket, "Take commands at this unix socket, too");
  app.add_flag("-q,--quiet", options.quiet, "Print nothing but errors");
  app.add_flag("-v,--verbose", options.verbose, "Print a status every ten seconds");
}

void add_image_options(CLI::App& app, Words& words) {
  auto* const images =
      app.add_option("--images", words.images, "Send rendered images, too, from a camera with this lens");
  images->check(CLI::IsMember({"mirror", "fisheye"}))->needs("--camera-socket");
  app.add_option("--image-rate", words.image_rate_hz, "Images per second")->check(CLI::Range(0.1, 60.0))->needs(images);
  app.add_option("--image-scale", words.image_scale,
                 "Size of the images: the sides, as a multiple of 1024 x 768 pixels")
      ->check(CLI::Range(0.125, 1.0))
      ->needs(images);
  app.add_option("--image-format", words.image_format, "Pixel format of the images")
      ->check(CLI::IsMember({"gray8", "rgb8", "bgr8", "yuyv", "uyvy"}))
      ->needs(images);
  app.add_option("--image-noise", words.image_noise, "Standard deviation of the noise in the images, of 256 steps")
      ->check(CLI::Range(0.0, 50.0))
      ->needs(images);
}

void add_fault_options(CLI::App& app, Words& words) {
  const auto add = [&app](const char* name, std::vector<std::string>& texts, const char* help) {
    return app.add_option(name, texts, help)->take_all()->allow_extra_args(false);
  };
  add("--fault", words.faults, "Fault from the start, NAME[=VALUE]; may be repeated");
  add("--at", words.timed, "Fault at a given time, SECONDS:NAME[=VALUE]; may be repeated");
  auto* const cycle = add("--cycle", words.cycle, "Faults that come one after the other, for ever, NAME[=VALUE],...");
  cycle->delimiter(',');
  auto* const every = app.add_option("--every", words.every_s, "Seconds between the faults of --cycle");
  every->check(CLI::Range(0.1, 1e6));
  cycle->needs(every);
  every->needs(cycle);
  app.footer("The faults, their values, their meaning and [the value when none is given]:\n" + fault_help() + '\n' +
             can_base_help());
}

PioneerModel model_of(const Words& words) {
  std::optional<PioneerModel> model = pioneer_model(words.subclass);
  if (!model) throw CLI::ValidationError("--subclass", words.subclass + " is not one of " + known_subclasses());
  if (!pioneer::baud_code(words.baud)) throw CLI::ValidationError("--baud", "the controller has no such rate");
  model->start_baud = words.baud;
  model->baud_resets = !words.keep_baud;
  model->has_gyro = words.gyro;
  return *model;
}

Scenario scenario_of(const Words& words) {
  std::optional<Scenario> scenario = scenario_named(words.scenario, words.seed, words.laps);
  if (!scenario) throw CLI::ValidationError("--scenario", words.scenario + " is not one of " + known_scenarios());
  scenario->sensor.identities = !words.no_identities;
  scenario->sensor.clutter_per_set = words.clutter_per_set;
  return *scenario;
}

FaultSchedule schedule_of(const Words& words) {
  std::vector<TimedFault> timed;
  for (const std::string& text : words.timed) timed.push_back(or_refuse(parse_timed_fault(text), "--at"));
  std::vector<Fault> cycle;
  for (const std::string& text : words.cycle) cycle.push_back(or_refuse(parse_fault(text), "--cycle"));
  return {std::move(timed), std::move(cycle), duration_from_seconds(words.every_s)};
}

std::uint16_t port_of(const std::string& text) {
  int port = 0;
  if (!CLI::detail::lexical_cast(text, port) || port < 0 || port > 65535) {
    throw CLI::ValidationError("--tcp", text + " is no port");
  }
  return static_cast<std::uint16_t>(port);
}

PixelFormat pixels_of(const std::string& text) {
  int i = 0;
  while (i + 1 < kPixelFormats && name(static_cast<PixelFormat>(i)) != text) ++i;
  return static_cast<PixelFormat>(i);
}

void understand(const Words& words, Options& options) {
  if (options.device.empty() && words.tcp.empty() && options.can_interface.empty())
    throw CLI::RequiredError("--device, --tcp or --can");
  if (!words.tcp.empty()) options.tcp_port = port_of(words.tcp);
  options.simulation = {scenario_of(words),
                        model_of(words),
                        schedule_of(words),
                        std::nullopt,
                        !options.can_interface.empty(),
                        words.stand ? LeftAlone::stands : LeftAlone::follows_its_path};
  if (!words.images.empty()) {
    options.images = {words.images, pixels_of(words.image_format), words.image_rate_hz, words.image_scale,
                      words.image_noise};
    options.simulation.frame_period = duration_from_seconds(1.0 / words.image_rate_hz);
  }
  for (const std::string& text : words.faults) options.faults.push_back(or_refuse(parse_fault(text), "--fault"));
}

}  // namespace

ParsedOptions parse_options(int argc, const char* const* argv) {
  ParsedOptions parsed;
  Words words;
  CLI::App app("A simulated Pioneer with a bearing camera, driving through a world by itself or driven by a client.",
               "azimuth-sim");
  app.set_version_flag("--version", "azimuth-sim " AZIMUTH_VERSION);
  add_robot_options(app, parsed.options, words);
  add_world_options(app, parsed.options, words);
  add_drive_options(app, parsed.options, words);
  add_output_options(app, parsed.options);
  add_image_options(app, words);
  add_fault_options(app, words);
  parsed.exit_code = parse_command_line(app, argc, argv, [&] { understand(words, parsed.options); });
  return parsed;
}

}  // namespace azimuth::sim
