#pragma once
#include <cstdint>
#include <string>

#include "tests/equipment/usb_camera/emulated_camera.hpp"
#include "tests/equipment/usb_camera/iidc_registers.hpp"

namespace azimuth::sim {

/// An IIDC camera that uses USB instead of FireWire, as libdc1394 supports it: registers by control requests, images by
/// consecutive bulk transfers. Images carry no sequence numbers.
///
/// Thread contract: thread-bound.
class IidcCamera : public EmulatedCamera {
 public:
  /// `serial` is the serial number of the USB device.
  IidcCamera(std::uint64_t guid, std::string serial);

  WireShape shape() const override;
  double rate_hz() const override { return registers_.rate_hz(); }
  const IidcRegisters& registers() const { return registers_; }

 private:
  Octets device_descriptor() const override;
  Octets configuration_descriptor() const override;
  ControlAnswer own_request(const ControlRequest& request, OctetSpan data) override;
  std::size_t pack(OctetSpan unsent, std::size_t room, BulkAnswer& answer) override;
  void at_power_up() override { registers_.reset(); }
  void at_configuration() override { registers_.stop_streaming(); }
  void at_image(ImageFlaw flaw) override { fails_ = flaw == ImageFlaw::marked_bad; }

  ControlAnswer read_registers(std::uint32_t address, std::size_t bytes) const;
  ControlAnswer write_registers(std::uint32_t address, OctetSpan data);

  IidcRegisters registers_;
  bool fails_ = false;  // Whether the current image is to fail
};

}  // namespace azimuth::sim
