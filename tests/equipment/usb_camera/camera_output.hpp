#pragma once
#include <optional>
#include <string>

#include "tests/equipment/usb_camera/emulated_camera.hpp"

namespace azimuth::sim {

/// The destination of images: a device that this process emulates. Faults are injected here.
///
/// Thread contract: thread-bound.
class CameraOutput {
 public:
  virtual ~CameraOutput() = default;

  /// Plugs the device in; returns the error, or nullopt on success.
  virtual std::optional<std::string> plug() = 0;
  virtual std::optional<std::string> unplug() = 0;
  virtual bool plugged() const = 0;

  /// For poll(2): readable if turn() has work; -1: never.
  virtual int descriptor() const = 0;
  virtual void turn() = 0;

  /// Whether the device would accept an image now.
  virtual bool ready() const = 0;
  virtual WireShape shape() const = 0;
  virtual double rate_hz() const = 0;
  virtual void send(OctetSpan image, ImageFlaw flaw) = 0;

  virtual void freeze(bool frozen) = 0;
  /// Returns false if this kind of device has no reset that would end the hang.
  virtual bool hang() = 0;

  virtual std::string status() const = 0;  ///< key=value pairs separated by spaces
};

}  // namespace azimuth::sim
