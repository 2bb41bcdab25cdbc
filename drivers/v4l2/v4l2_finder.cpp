#include "drivers/v4l2/v4l2_finder.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <fstream>
#include <system_error>
#include <utility>
#include <vector>

namespace azimuth::v4l2 {
namespace {

namespace fs = std::filesystem;

bool is_usb_number(std::string_view text) {
  return text.size() == 4 && text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

/// The part before the next colon, which goes with it.
std::string take_part(std::string_view& text) {
  const std::size_t colon = text.find(':');
  std::string part(text.substr(0, colon));
  text.remove_prefix(colon == std::string_view::npos ? text.size() : colon + 1);
  return part;
}

/// First line of an attribute; empty when it cannot be read.
std::string attribute(const fs::path& file) {
  std::string line;
  std::ifstream in(file);
  std::getline(in, line);
  return line;
}

/// The directory of the USB device that the node belongs to; empty: none.
fs::path usb_device(const Calls& calls, const std::string& node) {
  std::error_code error;
  fs::path directory = fs::canonical(calls.classes() / node / "device", error);
  if (error) return {};
  for (; directory.has_relative_path(); directory = directory.parent_path())
    if (fs::exists(directory / "idVendor", error)) return directory;
  return {};
}

/// "video12" is 12.
std::optional<int> node_number(const std::string& node) {
  constexpr std::string_view kBegin = "video";
  if (!node.starts_with(kBegin)) return std::nullopt;
  int number = 0;
  const char* const last = node.data() + node.size();
  const auto [end, error] = std::from_chars(node.data() + kBegin.size(), last, number);
  return error == std::errc{} && end == last ? std::optional(number) : std::nullopt;
}

/// All there are, by number.
std::vector<std::string> all_nodes(const Calls& calls) {
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

bool matches(const std::string& wanted, const fs::path& file) { return wanted.empty() || attribute(file) == wanted; }

bool matches_usb(const Calls& calls, const CameraName& name, const std::string& node) {
  if (name.vendor.empty() && name.serial.empty()) return true;
  const fs::path device = usb_device(calls, node);
  return !device.empty() && matches(name.vendor, device / "idVendor") && matches(name.product, device / "idProduct") &&
         matches(name.serial, device / "serial");
}

std::variant<Handle, CameraTrouble> open_path(Calls& calls, const std::string& path) {
  const int fd = calls.open(path);
  if (fd < 0) return CameraTrouble{path + ": open: " + error_text(-fd), -fd};
  return Handle(calls, path, fd);
}

}  // namespace

std::optional<CameraName> parse_name(std::string_view text) {
  CameraName name;
  if (text == "first") return name;
  if (text.starts_with('/')) {
    name.path = text;
    return name;
  }
  const std::string kind = take_part(text);
  if (kind == "serial") name.serial = text;
  if (kind == "card") name.card = text;
  if (kind == "usb") {
    name.vendor = take_part(text);
    name.product = take_part(text);
    name.serial = text;
    if (!is_usb_number(name.vendor) || !is_usb_number(name.product)) return std::nullopt;
  }
  const bool says_something = !name.serial.empty() || !name.card.empty() || !name.vendor.empty();
  return says_something ? std::optional(name) : std::nullopt;
}

std::variant<Handle, CameraTrouble> open_named(Calls& calls, const std::string& text) {
  const auto name = parse_name(text);
  if (!name) return CameraTrouble{text + ": not a camera's name", EINVAL};
  if (!name->path.empty()) return open_path(calls, name->path);
  // Of those that match none may open: then the first one's reason is what the user needs.
  CameraTrouble trouble{text + ": no such camera", ENODEV};
  bool any = false;
  for (const std::string& node : all_nodes(calls)) {
    if (!matches_usb(calls, *name, node)) continue;
    auto opened = open_path(calls, (calls.nodes() / node).string());
    if (auto* const why = std::get_if<CameraTrouble>(&opened)) {
      if (!std::exchange(any, true)) trouble = std::move(*why);
      continue;
    }
    Abilities abilities;
    if (ask_abilities(std::get<Handle>(opened), abilities) != 0 || abilities.buffer_type == 0) continue;
    if (name->card.empty() || abilities.card == name->card) return opened;
  }
  return trouble;
}

std::string usb_port(const Calls& calls, const fs::path& node) {
  std::error_code error;
  const fs::path real = fs::canonical(node, error);
  return usb_device(calls, (error ? node : real).filename().string()).filename().string();
}

}  // namespace azimuth::v4l2
