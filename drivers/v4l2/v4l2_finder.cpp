#include "drivers/v4l2/v4l2_finder.hpp"

#include <cerrno>
#include <system_error>
#include <utility>

namespace azimuth::v4l2 {
namespace {

namespace fs = std::filesystem;

bool is_usb_number(std::string_view text) {
  return text.size() == 4 && text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

/// Takes the part before the next colon, and the colon.
std::string take_part(std::string_view& text) {
  const std::size_t colon = text.find(':');
  std::string part(text.substr(0, colon));
  text.remove_prefix(colon == std::string_view::npos ? text.size() : colon + 1);
  return part;
}

bool matches(const std::string& wanted, const std::string& has) { return wanted.empty() || wanted == has; }

tl::expected<Handle, CameraTrouble> open_path(Calls& calls, const std::string& path) {
  const int fd = calls.open(path);
  if (fd < 0) return tl::unexpected(CameraTrouble{path + ": open: " + error_text(-fd), -fd});
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

bool matches(const CameraName& name, const UsbIdentity& usb) {
  return matches(name.vendor, usb.vendor) && matches(name.product, usb.product) && matches(name.serial, usb.serial);
}

tl::expected<Handle, CameraTrouble> open_named(Calls& calls, const std::string& text) {
  const auto name = parse_name(text);
  if (!name) return tl::unexpected(CameraTrouble{text + ": not a camera's name", EINVAL});
  if (!name->path.empty()) return open_path(calls, name->path);
  // If no matching node can be opened, the error of the first one is reported.
  CameraTrouble trouble{text + ": no such camera", ENODEV};
  bool any = false;
  for (const std::string& node : node_names(calls)) {
    if (!matches(*name, usb_identity(calls, node))) continue;
    auto opened = open_path(calls, (calls.nodes() / node).string());
    if (!opened) {
      if (!std::exchange(any, true)) trouble = std::move(opened.error());
      continue;
    }
    Abilities abilities;
    if (ask_abilities(*opened, abilities) != 0 || abilities.buffer_type == 0) continue;
    if (name->card.empty() || abilities.card == name->card) return opened;
  }
  return tl::unexpected(std::move(trouble));
}

std::string usb_port(const Calls& calls, const fs::path& node) {
  std::error_code error;
  const fs::path real = fs::canonical(node, error);
  return usb_identity(calls, (error ? node : real).filename().string()).port;
}

}  // namespace azimuth::v4l2
