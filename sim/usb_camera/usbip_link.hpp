#pragma once
#include <cstdint>
#include <deque>

#include "base/unique_fd.hpp"
#include "sim/usb_camera/emulated_camera.hpp"
#include "sim/usb_camera/usbip_packets.hpp"

namespace azimuth::sim {

/// The device's end of a plugged-in cable: takes the host's transfers from a stream socket and has the camera answer
/// them. Transfers for images wait here until there is an image.
///
/// Blocks for as long as the host takes to read, and for the rest of a packet that has begun.
///
/// Thread contract: thread-bound.
class UsbipLink {
 public:
  /// `camera` must live longer than this.
  UsbipLink(UniqueFd socket, EmulatedCamera& camera) : socket_(std::move(socket)), camera_(&camera) {}

  int descriptor() const { return socket_.get(); }
  /// Serves one packet of the host. False: the cable is out, or what came over it made no sense.
  bool serve();
  /// Sends what the camera has to waiting transfers. False: the cable is out.
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
