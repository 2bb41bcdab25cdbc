#include "tools/ros2/bridge/options.hpp"

#include <CLI/CLI.hpp>
#include <charconv>
#include <net/if.h>

#include "drivers/lcm/lcm_address.hpp"
#include "settings/command_line/command_line.hpp"

namespace azimuth {
namespace {

constexpr unsigned kMostDomain = 232;  // DDS has no ports for domains larger than this

/// The domain in the text of ROS_DOMAIN_ID.
unsigned domain_of(const std::string& text) {
  unsigned domain = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), domain);
  if (error != std::errc{} || end != text.data() + text.size() || domain > kMostDomain)
    throw CLI::ValidationError("ROS_DOMAIN_ID=" + text + ": must be a number from 0 to 232");
  return domain;
}

bool is_local(const Environment& environment) {
  return environment("ROS_LOCALHOST_ONLY") == "1" || environment("ROS_AUTOMATIC_DISCOVERY_RANGE") == "LOCALHOST";
}

void check_interface(const std::string& name) {
  if (!name.empty() && ::if_nametoindex(name.c_str()) == 0)
    throw CLI::ValidationError("--interface " + name + ": there is no such network interface");
}

TransformChoice transforms_named(const std::string& word) {
  if (word == "full") return TransformChoice::full;
  return word == "map-odom" ? TransformChoice::map_odom : TransformChoice::none;
}

void add_options(CLI::App& app, Ros2Options& options) {
  BridgeSettings& bridge = options.bridge;
  app.set_version_flag("--version", "azimuth-ros2 " AZIMUTH_VERSION);
  app.add_option("--lcm-url", bridge.lcm_url, "LCM address to which azimuthd sends (its daemon.lcm.url)")
      ->capture_default_str();
  app.add_option("--prefix", bridge.channel_prefix, "Prefix of azimuthd's channels (its daemon.lcm.channel_prefix)");
  app.add_option("--domain", options.domain, "DDS domain; without it ROS_DOMAIN_ID, or 0")
      ->check(CLI::Range(0U, kMostDomain));
  app.add_option("--interface", options.interface,
                 "The only network interface to use, e.g. lo; without it Cyclone DDS chooses, or CYCLONEDDS_URI says");
  app.add_option("--map-frame", bridge.frames.map, "Name of the map's frame")->capture_default_str();
  app.add_option("--odom-frame", bridge.frames.odom, "Name of the odometer's frame")->capture_default_str();
  app.add_option("--base-frame", bridge.frames.base, "Name of the robot's frame")->capture_default_str();
  app.add_option_function<std::string>(
         "--tf", [&bridge](const std::string& word) { bridge.transforms = transforms_named(word); },
         "Transforms to send: full (map to odom, and odom to the robot), map-odom where another program sends odom to "
         "the robot, or none; without it full")
      ->check(CLI::IsMember({"full", "map-odom", "none"}));
}

}  // namespace

ParsedRos2Options parse_ros2_options(int argc, const char* const* argv, const Environment& environment) {
  ParsedRos2Options parsed;
  Ros2Options& options = parsed.options;
  CLI::App app("Poses, map and health of azimuthd for ROS 2, without ROS: heard over LCM, published by DDS.",
               "azimuth-ros2");
  add_options(app, options);
  parsed.exit_code = parse_command_line(app, argc, argv, [&] {
    if (!parse_lcm_url(options.bridge.lcm_url))
      throw CLI::ValidationError("--lcm-url " + options.bridge.lcm_url +
                                 ": must be of a multicast group, such as udpm://239.255.76.67:7667?ttl=0");
    const std::string domain = environment("ROS_DOMAIN_ID");
    if (app.count("--domain") == 0 && !domain.empty()) options.domain = domain_of(domain);
    if (options.interface.empty() && is_local(environment)) options.interface = "lo";
    check_interface(options.interface);
  });
  return parsed;
}

}  // namespace azimuth
