#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "sim/usb_camera/usb_request.hpp"
#include "sim/usb_camera/wire_image.hpp"

namespace azimuth::sim {

/// What is wrong with one image, on purpose.
enum class ImageFlaw : std::uint8_t {
  none,
  cut_short,  ///< ends before its time
  marked_bad  ///< uvc: the error bit in every header; iidc: a transfer that fails
};

/// What the device puts into one bulk transfer.
struct BulkAnswer {
  Octets bytes;
  bool failed = false;  ///< a protocol error on the bus instead of bytes
};

/// A USB camera as its host sees it: answers to control requests, and one bulk endpoint full of images. Pure: time and
/// the bus are elsewhere. This class answers what every device must; the kinds of camera add their own.
///
/// Control requests are answered even while no image leaves the camera: that is how cameras hang.
///
/// Thread contract: thread-bound.
class EmulatedCamera {
 public:
  virtual ~EmulatedCamera() = default;

  /// `data` came with a request to the device. Answers are no longer than the request asks for.
  ControlAnswer control(const ControlRequest& request, OctetSpan data);

  /// The bytes of a transfer that may take `room` of them; nothing while there is none to send.
  std::optional<BulkAnswer> next_transfer(std::size_t room);

  /// Of the images that the host has asked for.
  virtual WireShape shape() const = 0;
  virtual double rate_hz() const = 0;

  bool streaming() const { return streaming_; }
  /// Whether an image could be begun: streaming, not frozen, the one before has left.
  bool ready() const { return streaming_ && !frozen_ && !hung_ && sent_ == image_.size(); }
  /// The camera must be ready().
  void begin_image(OctetSpan image, ImageFlaw flaw);

  /// No image leaves any more, until told otherwise.
  void freeze(bool frozen) { frozen_ = frozen; }
  /// The same, until the host resets the device.
  void hang() { hung_ = true; }
  bool hung() const { return hung_; }
  std::uint64_t resets() const { return resets_; }  ///< enumerations, the first included

  /// As after power-up.
  void power_up();

 protected:
  EmulatedCamera(std::string product, std::string serial) : product_(std::move(product)), serial_(std::move(serial)) {}

  virtual Octets device_descriptor() const = 0;
  virtual Octets configuration_descriptor() const = 0;
  /// Requests that are not every device's.
  virtual ControlAnswer own_request(const ControlRequest& request, OctetSpan data) = 0;
  /// Fills `answer` with the next bytes of the image, of which `unsent` is left; returns how many of them it took.
  virtual std::size_t pack(OctetSpan unsent, std::size_t room, BulkAnswer& answer) = 0;
  virtual bool owes_transfer() const { return false; }  ///< besides the bytes of images
  virtual void at_power_up() {}
  virtual void at_image(ImageFlaw) {}
  virtual void at_configuration() {}  ///< streaming has been stopped

  void start_streaming();
  void stop_streaming();

 private:
  ControlAnswer standard_request(const ControlRequest& request);
  ControlAnswer descriptor(const ControlRequest& request);
  ControlAnswer set_configuration();

  std::string product_, serial_;
  Octets image_;
  std::size_t sent_ = 0;  // bytes of image_
  bool streaming_ = false, frozen_ = false, hung_ = false;
  bool enumerating_ = false;  // asked what it is, not yet configured
  std::uint64_t resets_ = 0;
};

}  // namespace azimuth::sim
