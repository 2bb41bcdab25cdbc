#pragma once
// Internal to drivers/iidc.

#include <cstdint>
#include <filesystem>
#include <string>

namespace azimuth::iidc {

/// The port (its name in sysfs, "1-2.3") of the USB device with this bus number and address. Empty: there is none.
/// `devices` is /sys/bus/usb/devices, or a similar folder in tests.
std::string usb_port_of(std::uint32_t bus, std::uint32_t address, const std::filesystem::path& devices);

}  // namespace azimuth::iidc
