#include "drivers/v4l2/v4l2_nodes.hpp"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <utility>

#include "drivers/v4l2/v4l2_finder.hpp"

namespace azimuth::v4l2 {
namespace {

namespace fs = std::filesystem;

/// The first line of an attribute; empty when it cannot be read.
std::string attribute(const fs::path& file) {
  std::string line;
  std::ifstream in(file);
  std::getline(in, line);
  return line;
}

/// The directory of the USB device to which the node belongs; empty: none.
fs::path usb_device(const Calls& calls, const std::string& node) {
  std::error_code error;
  fs::path directory = fs::canonical(calls.classes() / node / "device", error);
  if (error) return {};
  for (; directory.has_relative_path(); directory = directory.parent_path())
    if (fs::exists(directory / "idVendor", error)) return directory;
  return {};
}

/// The number in the name of a node, e.g. 12 for "video12".
std::optional<int> node_number(const std::string& node) {
  constexpr std::string_view kBegin = "video";
  if (!node.starts_with(kBegin)) return std::nullopt;
  int number = 0;
  const char* const last = node.data() + node.size();
  const auto [end, error] = std::from_chars(node.data() + kBegin.size(), last, number);
  return error == std::errc{} && end == last ? std::optional(number) : std::nullopt;
}

VideoNode described(Calls& calls, const std::string& name) {
  VideoNode node{.path = (calls.nodes() / name).string(),
                 .card = attribute(calls.classes() / name / "name"),
                 .usb = usb_identity(calls, name)};
  const int fd = calls.open(node.path);
  if (fd < 0) {
    node.open_error = -fd;
    return node;
  }
  Abilities abilities;
  if (ask_abilities(Handle(calls, node.path, fd), abilities) != 0) return node;
  node.card = abilities.card;
  node.gives_images = abilities.buffer_type != 0;
  return node;
}

}  // namespace

UsbIdentity usb_identity(const Calls& calls, const std::string& node) {
  const fs::path device = usb_device(calls, node);
  if (device.empty()) return {};
  return {device.filename().string(), attribute(device / "idVendor"), attribute(device / "idProduct"),
          attribute(device / "serial")};
}

std::vector<std::string> node_names(const Calls& calls) {
  std::vector<std::pair<int, std::string>> numbered;
  std::error_code error;
  for (fs::directory_iterator entry(calls.classes(), error), end; !error && entry != end; entry.increment(error)) {
    std::string node = entry->path().filename().string();
    if (const auto number = node_number(node)) numbered.emplace_back(*number, std::move(node));
  }
  std::ranges::sort(numbered);
  std::vector<std::string> nodes;
  for (auto& [number, node] : numbered) nodes.push_back(std::move(node));
  return nodes;
}

std::vector<VideoNode> video_nodes(Calls& calls) {
  std::vector<VideoNode> nodes;
  for (const std::string& name : node_names(calls)) nodes.push_back(described(calls, name));
  return nodes;
}

bool is_meant(std::string_view text, const VideoNode& node) {
  const auto name = parse_name(text);
  return name && name->path.empty() && node.gives_images != false && matches(*name, node.usb) &&
         (name->card.empty() || name->card == node.card);
}

std::string lasting_name(const VideoNode& node, std::span<const VideoNode> all) {
  const UsbIdentity& usb = node.usb;
  const std::string model = "usb:" + usb.vendor + ":" + usb.product;
  for (const std::string& name : {"serial:" + usb.serial, model, model + ":" + usb.serial, "card:" + node.card}) {
    const auto means = [&](const VideoNode& other) { return is_meant(name, other); };
    if (means(node) && std::ranges::count_if(all, means) == 1) return name;
  }
  return node.path;
}

}  // namespace azimuth::v4l2
