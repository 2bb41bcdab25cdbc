#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "sim/usb_camera/emulated_camera.hpp"
#include "sim/usb_camera/uvc_controls.hpp"

namespace azimuth::sim {

/// A webcam: UVC 1.0, images uncompressed in one size, at the rate it was made with or half of it, over a bulk
/// endpoint.
///
/// What Linux makes of its faults: an image marked bad or cut short is dropped by uvcvideo, whose sequence number,
/// counted from the toggling bit in the payloads' headers, then jumps by one. Images that were never begun toggle
/// nothing: only the number inside the test image tells of them.
///
/// Thread contract: thread-bound.
class UvcCamera : public EmulatedCamera {
 public:
  /// Bytes of a payload, header included: what one transfer of uvcvideo takes.
  static constexpr std::size_t kMaxPayloadBytes = 16384;
  static constexpr std::size_t kHeaderBytes = 2;

  /// Sides are even; the rate is positive.
  UvcCamera(int width_px, int height_px, double rate_hz, std::string serial);

  WireShape shape() const override;
  double rate_hz() const override { return 1e7 / interval_; }
  const UvcControlBank& controls() const { return controls_; }

 private:
  Octets device_descriptor() const override;
  Octets configuration_descriptor() const override;
  ControlAnswer own_request(const ControlRequest& request, OctetSpan data) override;
  std::size_t pack(OctetSpan unsent, std::size_t room, BulkAnswer& answer) override;
  bool owes_transfer() const override { return owes_empty_; }
  void at_power_up() override;
  void at_image(ImageFlaw flaw) override;

  ControlAnswer stream_request(const ControlRequest& request, OctetSpan data);
  void negotiate(OctetSpan wanted);
  Octets agreement() const;

  int width_px_, height_px_;
  std::vector<std::uint32_t> intervals_;  // on offer, in 100 ns
  UvcControlBank controls_;
  std::size_t format_ = 0;  // in kUvcFormats
  std::uint32_t interval_;
  std::uint8_t flags_ = 0;         // of the headers of this image
  std::size_t payload_left_ = 0;   // of the payload under way, which may take several transfers
  std::size_t payload_bytes_ = 0;  // of it so far
  bool owes_empty_ = false;        // a payload that ended with a full transfer needs an empty one to end it
};

}  // namespace azimuth::sim
