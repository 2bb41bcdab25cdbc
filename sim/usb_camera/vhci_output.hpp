#pragma once
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "sim/usb_camera/camera_output.hpp"
#include "sim/usb_camera/usbip_link.hpp"

namespace azimuth::sim {

/// An emulated camera at a port of vhci_hcd, the kernel's virtual USB host controller. Plugging in hands the kernel one
/// end of a socket pair; neither network nor usbip's own programs take part. Replugging is also a power cycle.
class VhciOutput : public CameraOutput {
 public:
  static constexpr const char* kController = "/sys/devices/platform/vhci_hcd.0";

  /// `port` counts from 0; those of USB 2 come first. `controller` is where the kernel's files are.
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
  /// Writes until the kernel agrees: a port takes a moment to be free again.
  std::optional<std::string> tell_kernel(std::string_view file, const std::string& text) const;
  void drain(std::chrono::milliseconds limit);

  std::unique_ptr<EmulatedCamera> camera_;
  int port_;
  std::filesystem::path controller_;
  std::unique_ptr<UsbipLink> link_;  // null: not plugged in
};

}  // namespace azimuth::sim
