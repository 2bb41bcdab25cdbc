#pragma once
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "tests/equipment/usb_camera/camera_output.hpp"
#include "tests/equipment/usb_camera/usbip_link.hpp"

namespace azimuth::sim {

/// An emulated camera at a port of vhci_hcd, the kernel's virtual USB host controller. Plugging in passes one end of a
/// socket pair to the kernel, without a network or the usbip programs. Replugging is also a power cycle.
class VhciOutput : public CameraOutput {
 public:
  static constexpr const char* kController = "/sys/devices/platform/vhci_hcd.0";

  /// `port` counts from 0; the ports of USB 2 come first. `controller` is the directory of the kernel's files.
  VhciOutput(std::unique_ptr<EmulatedCamera> camera, int port, std::filesystem::path controller = kController)
      : camera_(std::move(camera)), port_(port), controller_(std::move(controller)) {}
  ~VhciOutput() override { unplug(); }

  std::optional<std::string> plug() override;
  std::optional<std::string> unplug() override;
  bool plugged() const override { return link_ != nullptr; }
  int descriptor() const override { return link_ ? link_->descriptor() : -1; }
  void turn() override;
  bool ready() const override { return link_ && camera_->ready(); }
  WireShape shape() const override { return camera_->shape(); }
  double rate_hz() const override { return camera_->rate_hz(); }
  void send(OctetSpan image, ImageFlaw flaw) override;
  void freeze(bool frozen) override { camera_->freeze(frozen); }
  bool hang() override;
  std::string status() const override;

 private:
  /// Writes repeatedly until the kernel accepts it: a port needs a moment to become free.
  std::optional<std::string> tell_kernel(std::string_view file, const std::string& text) const;
  void drain(std::chrono::milliseconds limit);

  std::unique_ptr<EmulatedCamera> camera_;
  int port_;
  std::filesystem::path controller_;
  std::unique_ptr<UsbipLink> link_;  // Null if not plugged in
};

}  // namespace azimuth::sim
