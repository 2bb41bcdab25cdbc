#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "tests/equipment/usb_camera/emulated_camera.hpp"
#include "tests/equipment/usb_camera/uvc_controls.hpp"

namespace azimuth::sim {

/// A webcam: UVC 1.0, uncompressed images of one size, at the rate given to the constructor or half of it, over a bulk
/// endpoint.
///
/// Effect of its flaws on Linux: uvcvideo drops an image that is marked bad or cut short, and its sequence number,
/// derived from the toggling bit in the payload headers, jumps by one. Images that were never begun do not toggle the
/// bit; only the number inside the test image reveals them.
///
/// Thread contract: thread-bound.
class UvcCamera : public EmulatedCamera {
 public:
  /// Bytes of a payload including its header: the size of one transfer of uvcvideo.
  static constexpr std::size_t kMaxPayloadBytes = 16384;
  static constexpr std::size_t kHeaderBytes = 2;

  /// Width and height must be even, the rate positive.
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
  std::vector<std::uint32_t> intervals_;  // Permitted intervals, in 100 ns
  UvcControlBank controls_;
  std::size_t format_ = 0;  // Index in kUvcFormats
  std::uint32_t interval_;
  std::uint8_t flags_ = 0;         // Of the current image's headers
  std::size_t payload_left_ = 0;   // Rest of the current payload, which may take several transfers
  std::size_t payload_bytes_ = 0;  // Bytes of it sent so far
  bool owes_empty_ = false;        // Whether an empty transfer is due, which must follow a payload that ended with a
                                   // full transfer
};

}  // namespace azimuth::sim
