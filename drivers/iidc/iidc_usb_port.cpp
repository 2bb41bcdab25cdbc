#include "drivers/iidc/iidc_usb_port.hpp"

#include <fstream>
#include <system_error>

namespace azimuth::iidc {
namespace {

bool has_number(const std::filesystem::path& file, std::uint32_t expected) {
  std::ifstream in(file);
  std::uint32_t number = 0;
  return in >> number && number == expected;
}

}  // namespace

std::string usb_port_of(std::uint32_t bus, std::uint32_t address, const std::filesystem::path& devices) {
  std::error_code error;
  for (std::filesystem::directory_iterator device(devices, error), end; !error && device != end;
       device.increment(error))
    if (has_number(device->path() / "busnum", bus) && has_number(device->path() / "devnum", address))
      return device->path().filename();
  return {};
}

}  // namespace azimuth::iidc
