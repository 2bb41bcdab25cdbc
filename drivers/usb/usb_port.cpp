#include "drivers/usb/usb_port.hpp"

#include <algorithm>
#include <charconv>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <system_error>

namespace azimuth {
namespace {

/// Takes a number from 1 to 255 without leading zeros from the beginning of `text`.
std::optional<std::uint8_t> take_number(std::string_view& text) {
  std::uint8_t number = 0;
  const auto [end, wrong] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (wrong != std::errc{} || text.front() == '0') return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return number;
}

bool take(std::string_view& text, char wanted) {
  if (!text.starts_with(wanted)) return false;
  text.remove_prefix(1);
  return true;
}

}  // namespace

std::optional<UsbPort> UsbPort::make(std::uint8_t bus, std::span<const std::uint8_t> ports) {
  if (bus == 0 || ports.empty() || ports.size() > kMaxDepth || std::ranges::count(ports, 0) > 0) return std::nullopt;
  UsbPort port;
  port.bus_ = bus;
  port.depth_ = static_cast<std::uint8_t>(ports.size());
  std::ranges::copy(ports, port.ports_.begin());
  return port;
}

std::optional<UsbPort> UsbPort::parse(std::string_view text) {
  const std::optional<std::uint8_t> bus = take_number(text);
  if (!bus) return std::nullopt;
  std::array<std::uint8_t, kMaxDepth> ports{};
  std::size_t depth = 0;
  while (!text.empty()) {
    if (depth == kMaxDepth || !take(text, depth == 0 ? '-' : '.')) return std::nullopt;
    const std::optional<std::uint8_t> number = take_number(text);
    if (!number) return std::nullopt;
    ports.at(depth++) = *number;
  }
  return make(*bus, std::span(ports).first(depth));
}

std::string UsbPort::text() const {
  std::string text = std::to_string(bus_);
  for (std::size_t i = 0; i < depth_; ++i) text += (i == 0 ? '-' : '.') + std::to_string(ports_.at(i));
  return text;
}

std::optional<UsbPort> usb_port_in_path(const std::filesystem::path& sysfs_path) {
  // A name counts as a port only below the root hub of its bus, because names on other buses contain hyphens as well.
  std::string root_hub;
  std::optional<UsbPort> innermost;
  for (const std::filesystem::path& part : sysfs_path) {
    const std::string name = part.string();
    const std::optional<UsbPort> port = UsbPort::parse(name);
    if (name.starts_with("usb")) root_hub = name;
    if (port && root_hub == "usb" + name.substr(0, name.find('-'))) innermost = port;
  }
  return innermost;
}

std::optional<UsbPort> usb_port_of_node(const std::filesystem::path& node, const std::filesystem::path& sysfs) {
  struct stat found {};
  if (::stat(node.c_str(), &found) < 0 || !S_ISCHR(found.st_mode)) return std::nullopt;
  const std::string number = std::to_string(major(found.st_rdev)) + ':' + std::to_string(minor(found.st_rdev));
  std::error_code error;
  const std::filesystem::path device = std::filesystem::canonical(sysfs / "dev" / "char" / number, error);
  return error ? std::nullopt : usb_port_in_path(device);
}

}  // namespace azimuth
