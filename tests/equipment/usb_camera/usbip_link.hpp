#pragma once
#include <cstdint>
#include <deque>

#include "base/unique_fd.hpp"
#include "tests/equipment/usb_camera/emulated_camera.hpp"
#include "tests/equipment/usb_camera/usbip_packets.hpp"

namespace azimuth::sim {

/// The device's end of a plugged-in cable: receives the host's transfers from a stream socket and lets the camera
/// answer them. Transfers for images are queued until there is an image.
///
/// Blocks while the host reads slowly, and for the rest of a packet that has begun.
///
/// Thread contract: thread-bound.
class UsbipLink {
 public:
  /// `camera` must outlive this object.
  UsbipLink(UniqueFd socket, EmulatedCamera& camera) : socket_(std::move(socket)), camera_(&camera) {}

  int descriptor() const { return socket_.get(); }
  /// Serves one packet of the host. Returns false if the cable is unplugged or the packet is not valid.
  bool serve();
  /// Sends the camera's data to queued transfers. Returns false if the cable is unplugged.
  bool pump();

  std::size_t waiting() const { return waiting_.size(); }

 private:
  struct WaitingTransfer {
    std::uint32_t sequence = 0;
    std::uint32_t room = 0;
  };
  bool submit(const UsbipCommand& command);
  bool answer_control(const UsbipCommand& command);
  bool unlink(const UsbipCommand& command);
  bool reply(const UsbipHeader& header, OctetSpan data = {});

  UniqueFd socket_;
  EmulatedCamera* camera_;
  std::deque<WaitingTransfer> waiting_;
  Octets received_;
};

}  // namespace azimuth::sim
