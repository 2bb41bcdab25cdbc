#include "drivers/iidc/iidc_camera.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>
#include <span>
#include <system_error>

#include "drivers/iidc/iidc_text.hpp"

namespace azimuth::iidc {
namespace {

/// The last message of the library on this thread; empty: none. The library's own threads write messages as well, so
/// each thread has its own buffer and nothing is shared.
constinit thread_local std::array<char, 256> g_complaint{};

void keep_complaint(dc1394log_t /*type*/, const char* message, void* /*user*/) {
  const std::size_t size = std::min(std::strlen(message), g_complaint.size() - 1);
  std::memcpy(g_complaint.data(), message, size);
  g_complaint[size] = '\0';
}

int errno_of(dc1394error_t error) {
  switch (error) {
    case DC1394_NOT_A_CAMERA:
      return ENODEV;
    case DC1394_NO_BANDWIDTH:
    case DC1394_NO_ISO_CHANNEL:
    case DC1394_CAPTURE_IS_RUNNING:
      return EBUSY;
    case DC1394_MEMORY_ALLOCATION_FAILURE:
      return ENOMEM;
    case DC1394_FUNCTION_NOT_SUPPORTED:
      return ENOTSUP;
    default:
      return EIO;
  }
}

std::string reason_of(dc1394error_t error) {
  switch (error) {
    case DC1394_NO_BANDWIDTH:
      return "the bus has no bandwidth left: other cameras use it, or a program that crashed has left its share taken "
             "until the next bus reset; a lower rate or a smaller image needs less";
    case DC1394_NO_ISO_CHANNEL:
      return "the bus has no isochronous channel left: other cameras use them, or a program that crashed has left its "
             "own taken until the next bus reset";
    default:
      break;
  }
  const char* const text = dc1394_error_get_string(error);
  return text != nullptr ? text : "error " + std::to_string(static_cast<int>(error));
}

CameraTrouble trouble_with(std::string text, int error_number) {
  if (const std::string complaint = take_complaint(); !complaint.empty()) text += " (" + complaint + ")";
  return {std::move(text), error_number};
}

/// Without a requested GUID, chooses the lowest one, so that the choice does not depend on the order of the bus. Null:
/// not found.
const dc1394camera_id_t* choose(std::span<const dc1394camera_id_t> found, const std::optional<std::uint64_t>& wish) {
  const auto chosen = wish ? std::ranges::find(found, *wish, &dc1394camera_id_t::guid)
                           : std::ranges::min_element(found, {}, &dc1394camera_id_t::guid);
  return chosen == found.end() ? nullptr : &*chosen;
}

bool is_on_usb(dc1394camera_t* camera) {
  const char* platform = nullptr;
  return dc1394_camera_get_platform_string(camera, &platform) == DC1394_SUCCESS && platform != nullptr &&
         std::string_view(platform) == "usb";
}

bool has_number(const std::filesystem::path& file, std::uint32_t expected) {
  std::ifstream in(file);
  std::uint32_t number = 0;
  return in >> number && number == expected;
}

}  // namespace

void silence_library() {
  // Done once, because the handlers belong to the whole process and must not be changed while the library runs.
  [[maybe_unused]] static const bool done = [] {
    dc1394_log_register_handler(DC1394_LOG_ERROR, keep_complaint, nullptr);
    dc1394_log_register_handler(DC1394_LOG_WARNING, keep_complaint, nullptr);
    return true;
  }();
}

std::string take_complaint() {
  std::string complaint(g_complaint.data());
  g_complaint[0] = '\0';
  while (!complaint.empty() && (complaint.back() == '\n' || complaint.back() == ' ')) complaint.pop_back();
  return complaint;
}

CameraTrouble trouble_of(const OpenCamera& camera, std::string_view what, dc1394error_t error) {
  return trouble_with("IIDC camera " + camera.guid + ": " + std::string(what) + ": " + reason_of(error),
                      errno_of(error));
}

tl::expected<OpenCamera, CameraTrouble> find_camera(const IidcSettings& settings) {
  silence_library();
  take_complaint();
  const std::optional<std::uint64_t> wish = settings.guid.empty() ? std::nullopt : parse_guid(settings.guid);
  OpenCamera camera;
  camera.guid = wish ? guid_text(*wish) : "(any)";
  camera.context.reset(dc1394_new());
  if (!camera.context)
    return tl::unexpected(trouble_with("IIDC cameras: libdc1394 finds neither FireWire nor USB", ENODEV));
  dc1394camera_list_t* found = nullptr;
  const dc1394error_t error = dc1394_camera_enumerate(camera.context.get(), &found);
  const std::unique_ptr<dc1394camera_list_t, FreeList> list(found);
  if (error != DC1394_SUCCESS || !list) return tl::unexpected(trouble_of(camera, "enumerating the bus", error));
  const dc1394camera_id_t* const id = choose({list->ids, list->num}, wish);
  if (id == nullptr) return tl::unexpected(trouble_with("IIDC camera " + camera.guid + ": is not there", ENODEV));
  camera.guid = guid_text(id->guid);
  camera.handle.reset(dc1394_camera_new_unit(camera.context.get(), id->guid, id->unit));
  if (!camera.handle) return tl::unexpected(trouble_with("IIDC camera " + camera.guid + ": cannot be opened", ENODEV));
  camera.on_usb = is_on_usb(camera.get());
  return camera;
}

std::uint32_t bus_generation(const OpenCamera& camera) {
  std::uint32_t node = 0, generation = 0;
  return dc1394_camera_get_node(camera.get(), &node, &generation) == DC1394_SUCCESS ? generation : 0;
}

std::string usb_port_of(std::uint32_t bus, std::uint32_t address, const std::filesystem::path& devices) {
  std::error_code error;
  for (std::filesystem::directory_iterator device(devices, error), end; !error && device != end;
       device.increment(error))
    if (has_number(device->path() / "busnum", bus) && has_number(device->path() / "devnum", address))
      return device->path().filename();
  return {};
}

std::string usb_port_of(const OpenCamera& camera) {
  // On USB, the library's "node" and "generation" are the device's address and bus number.
  std::uint32_t address = 0, bus = 0;
  if (!camera.on_usb || dc1394_camera_get_node(camera.get(), &address, &bus) != DC1394_SUCCESS) return {};
  return usb_port_of(bus, address, "/sys/bus/usb/devices");
}

}  // namespace azimuth::iidc
