#pragma once
#include <string>

#include "base/unique_fd.hpp"
#include "tests/equipment/usb_camera/camera_output.hpp"

namespace azimuth::sim {

/// The writing side of a v4l2loopback node. Unplugging closes the node, which ends the reader's stream; the node
/// remains. A flawed image is written cut short.
class LoopbackOutput : public CameraOutput {
 public:
  LoopbackOutput(std::string device, WireShape shape, double rate_hz)
      : device_(std::move(device)), shape_(shape), rate_hz_(rate_hz) {}

  std::optional<std::string> plug() override;
  std::optional<std::string> unplug() override;
  bool plugged() const override { return static_cast<bool>(node_); }
  int descriptor() const override { return -1; }
  void turn() override {}
  bool ready() const override { return plugged() && !frozen_; }
  WireShape shape() const override { return shape_; }
  double rate_hz() const override { return rate_hz_; }
  void send(OctetSpan image, ImageFlaw flaw) override;
  void freeze(bool frozen) override { frozen_ = frozen; }
  bool hang() override { return false; }
  std::string status() const override;

 private:
  std::optional<std::string> failed(const char* what, int error) const;

  std::string device_;
  WireShape shape_;
  double rate_hz_;
  UniqueFd node_;
  bool frozen_ = false;
  std::uint64_t write_failures_ = 0;
};

}  // namespace azimuth::sim
