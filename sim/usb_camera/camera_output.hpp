#pragma once
#include <optional>
#include <string>

#include "sim/usb_camera/emulated_camera.hpp"

namespace azimuth::sim {

/// Where images go: a device that this process pretends to be. Faults are injected here.
///
/// Thread contract: thread-bound.
class CameraOutput {
 public:
  virtual ~CameraOutput() = default;

  /// Nothing when it worked, or why it did not.
  virtual std::optional<std::string> plug() = 0;
  virtual std::optional<std::string> unplug() = 0;
  virtual bool plugged() const = 0;

  /// For poll(2), readable when turn() has something to do; -1: never.
  virtual int descriptor() const = 0;
  virtual void turn() = 0;

  /// Whether an image would be taken now.
  virtual bool ready() const = 0;
  virtual WireShape shape() const = 0;
  virtual double rate_hz() const = 0;
  virtual void send(OctetSpan image, ImageFlaw flaw) = 0;

  virtual void freeze(bool frozen) = 0;
  /// False: this kind of device has no reset that would cure it.
  virtual bool hang() = 0;

  virtual std::string status() const = 0;  ///< key=value, separated by blanks
};

}  // namespace azimuth::sim
