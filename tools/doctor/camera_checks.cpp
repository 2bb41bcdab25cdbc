#include <algorithm>
#include <cerrno>
#include <fmt/format.h>
#include <iterator>
#include <system_error>

#include "drivers/iidc/iidc_text.hpp"
#include "tools/doctor/checks.hpp"
#include "tools/doctor/device_access.hpp"

namespace azimuth {

namespace fs = std::filesystem;

namespace {

using v4l2::VideoNode;

constexpr const char* kCameraCheck = "camera";
constexpr const char* kKernelOnCameras = "sudo dmesg | grep -iE 'usb|video|camera|firewire' | tail";

std::vector<VideoNode> video_nodes(const Machine& machine) {
  return machine.video_nodes ? machine.video_nodes() : std::vector<VideoNode>();
}

/// Example: "/dev/video0 (HD Webcam, USB 1-2, serial A1)".
std::string described(const VideoNode& node) {
  std::string about = node.card;
  if (!node.usb.port.empty()) about += (about.empty() ? "USB " : ", USB ") + node.usb.port;
  if (!node.usb.serial.empty()) about += ", serial " + node.usb.serial;
  return about.empty() ? node.path : fmt::format("{} ({})", node.path, about);
}

/// The problem that prevents the use of a camera; nothing if there is none. If this process runs as the account, the
/// result of opening the device counts, since access control lists may allow more than the file mode.
std::optional<Finding> obstacle(const Machine& machine, const VideoNode& node) {
  const bool tried = machine.account.is_here;
  const fs::path file = machine.at(node.path);
  const Access access = access_to(machine, file);
  if (tried && node.open_error == 0) return std::nullopt;
  if (access == Access::denied) return denied(machine, kCameraCheck, described(node), file, "video");
  const int error = access == Access::missing ? ENOENT : tried ? node.open_error : 0;
  if (error == 0) return std::nullopt;
  return Finding{kCameraCheck, Verdict::error,
                 fmt::format("{} cannot be opened: {}", described(node), std::generic_category().message(error)),
                 kKernelOnCameras};
}

Findings check_video_nodes(const Machine& machine, const std::vector<VideoNode>& nodes) {
  Findings findings;
  for (const VideoNode& node : nodes) {
    if (node.gives_images == false) continue;  // a metadata node beside the image node
    const auto trouble = obstacle(machine, node);
    findings.push_back(trouble ? *trouble
                               : Finding{kCameraCheck, Verdict::ok,
                                         fmt::format("{}, {} may use it; in [daemon.v4l2]: device = \"{}\"",
                                                     described(node), machine.account.name, lasting_name(node, nodes)),
                                         ""});
  }
  return findings;
}

/// The node at a path, or the first node that another kind of name matches; null if there is none.
const VideoNode* meant_node(const Machine& machine, const std::vector<VideoNode>& nodes, const std::string& device) {
  const auto is_it = [&](const VideoNode& node) {
    if (!device.starts_with('/')) return v4l2::is_meant(device, node);
    std::error_code error;
    return fs::equivalent(machine.at(device), machine.at(node.path), error) && !error;
  };
  const auto found = std::ranges::find_if(nodes, is_it);
  return found == nodes.end() ? nullptr : &*found;
}

Finding check_wanted_video(const Machine& machine, const std::vector<VideoNode>& nodes, const std::string& device) {
  const std::string wanted = fmt::format("the configured camera, {},", device);
  const VideoNode* const node = meant_node(machine, nodes, device);
  if (node == nullptr)
    return {kCameraCheck, Verdict::error, wanted + " is not there: it is not plugged in, or has another name",
            fmt::format("ls -l /dev/v4l/by-id/\n{}", kKernelOnCameras)};
  if (node->gives_images == false)
    return {kCameraCheck, Verdict::error, wanted + " is a node without images", "ls -l /dev/v4l/by-id/"};
  if (auto trouble = obstacle(machine, *node))
    return {kCameraCheck, Verdict::error, fmt::format("the configured camera: {}", trouble->what), trouble->fix};
  return {kCameraCheck, Verdict::ok, wanted + " is " + node->path, ""};
}

/// FireWire nodes also include controllers and disks. A node that does not state its kind may be a camera.
bool may_be_camera(const Machine& machine, const std::string& name) {
  const auto units = file_content(machine.at("/sys/bus/firewire/devices/" + name + "/units"));
  return !units || units->find("0x00a02d:0x00010") != std::string::npos ||  // IIDC's
         units->find("0x00b09d:0x00010") != std::string::npos;              // Point Grey's
}

Findings check_firewire_nodes(const Machine& machine) {
  Findings findings;
  for (const fs::path& file : entries(machine.at("/dev"), "fw")) {
    const std::string name = file.filename().string(), device = "/dev/" + name;
    if (!may_be_camera(machine, name)) continue;
    if (access_to(machine, file) == Access::denied) {
      findings.push_back(denied(machine, kCameraCheck, device, file, "video"));
      continue;
    }
    const auto model = first_line(machine.at("/sys/bus/firewire/devices/" + name + "/model_name"));
    findings.push_back(
        {kCameraCheck, Verdict::ok,
         fmt::format("{}{}, {} may use it", device, model ? " (" + *model + ")" : "", machine.account.name), ""});
  }
  return findings;
}

Findings check_iidc_cameras(const IidcBus& bus) {
  Findings findings;
  for (const std::string& guid : bus.guids)
    findings.push_back(
        {kCameraCheck, Verdict::ok, fmt::format("IIDC camera {0}; in [daemon.iidc]: guid = \"{0}\"", guid), ""});
  return findings;
}

Finding check_wanted_iidc(const std::optional<IidcBus>& bus, const std::string& setting) {
  const auto guid = iidc::parse_guid(setting);
  const std::string wanted = guid ? "IIDC camera " + iidc::guid_text(*guid) : std::string("an IIDC camera");
  if (!bus)
    return {kCameraCheck, Verdict::error, wanted + " is not found: libdc1394 does not answer", kKernelOnCameras};
  const bool there = guid ? std::ranges::count(bus->guids, iidc::guid_text(*guid)) > 0 : !bus->guids.empty();
  if (there) return {kCameraCheck, Verdict::ok, wanted + " is there, as configured", ""};
  const std::string why = bus->trouble.empty() ? "" : " (" + bus->trouble + ")";
  return {kCameraCheck, Verdict::error, wanted + " is configured, but not there, or may not be opened" + why,
          kKernelOnCameras};
}

}  // namespace

Findings check_cameras(const Machine& machine, const Plan& plan) {
  const std::vector<VideoNode> nodes = video_nodes(machine);
  const std::optional<IidcBus> bus = machine.iidc_cameras ? machine.iidc_cameras() : IidcBus{};
  Findings findings = check_video_nodes(machine, nodes);
  append(findings, check_firewire_nodes(machine));
  append(findings, check_iidc_cameras(bus.value_or(IidcBus{})));
  if (plan.v4l2_device) findings.push_back(check_wanted_video(machine, nodes, *plan.v4l2_device));
  if (plan.iidc_guid) findings.push_back(check_wanted_iidc(bus, *plan.iidc_guid));
  if (!findings.empty()) return findings;
  if (!plan.wants_camera)
    return {{kCameraCheck, Verdict::ok, "no camera is plugged in, and the configuration needs none", ""}};
  return {{kCameraCheck, Verdict::warning,
           "no camera is plugged in (no /dev/video*, no /dev/fw*, none that libdc1394 finds)", kKernelOnCameras}};
}

}  // namespace azimuth
