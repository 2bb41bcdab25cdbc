#pragma once
// The host's end of an emulated webcam in tests: assembles images from transfers by the rules of uvcvideo.

#include <cstdint>
#include <optional>
#include <vector>

#include "tests/equipment/usb_camera/emulated_camera.hpp"

namespace azimuth::sim::test {

struct ReceivedImage {
  Octets bytes;
  bool error = false;
  int fid = 0;
  bool ended = false;  ///< Whether the end-of-frame bit ended it
};

/// Reads transfers of `room` bytes. A payload ends with a short transfer or when it is `max_payload` bytes long.
class UvcHost {
 public:
  UvcHost(std::size_t room, std::size_t max_payload) : room_(room), max_payload_(max_payload) {}

  /// Reads until the camera has no more data. Returns false if a payload has no valid header.
  bool read_all(EmulatedCamera& camera) {
    while (const std::optional<BulkAnswer> answer = camera.next_transfer(room_)) {
      if (answer->failed || !take(answer->bytes)) return false;
    }
    return true;
  }
  const std::vector<ReceivedImage>& images() const { return images_; }
  bool between_payloads() const { return payload_bytes_ == 0; }

 private:
  bool take(OctetSpan transfer) {
    OctetSpan data = transfer;
    if (payload_bytes_ == 0) {
      if (data.empty()) return true;
      if (data.size() < 2 || data[0] < 2 || data[0] > data.size()) return false;
      flags_ = data[1];
      const int fid = flags_ & 1;
      if (images_.empty() || images_.back().fid != fid) images_.push_back({.bytes = {}, .fid = fid});
      images_.back().error = images_.back().error || (flags_ & 0x40) != 0;
      data = data.subspan(data[0]);
    }
    put_octets(images_.back().bytes, data);
    payload_bytes_ += transfer.size();
    if (transfer.size() < room_ || payload_bytes_ >= max_payload_) {
      images_.back().ended = images_.back().ended || (flags_ & 2) != 0;
      payload_bytes_ = 0;
    }
    return true;
  }

  std::size_t room_, max_payload_;
  std::size_t payload_bytes_ = 0;
  int flags_ = 0;
  std::vector<ReceivedImage> images_;
};

}  // namespace azimuth::sim::test
