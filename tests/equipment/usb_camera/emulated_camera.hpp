#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "tests/equipment/usb_camera/usb_request.hpp"
#include "tests/equipment/usb_camera/wire_image.hpp"

namespace azimuth::sim {

/// A deliberate flaw of one image.
enum class ImageFlaw : std::uint8_t {
  none,
  cut_short,  ///< The image ends early
  marked_bad  ///< Uvc: the error bit in every header; iidc: a failed transfer
};

/// The device's data for one bulk transfer.
struct BulkAnswer {
  Octets bytes;
  bool failed = false;  ///< A protocol error on the bus instead of bytes
};

/// A USB camera as its host sees it: answers to control requests, and one bulk endpoint with images. It depends neither
/// on time nor on the bus. This class handles the requests common to all devices; subclasses add those of their kind.
///
/// Control requests are answered even while no image leaves the camera, as by real cameras that hang.
///
/// Thread contract: thread-bound.
class EmulatedCamera {
 public:
  virtual ~EmulatedCamera() = default;

  /// `data` is the payload of a request to the device. Answers are no longer than the request permits.
  ControlAnswer control(const ControlRequest& request, OctetSpan data);

  /// The bytes of a transfer of at most `room` bytes; nullopt while there is nothing to send.
  std::optional<BulkAnswer> next_transfer(std::size_t room);

  /// The layout of the images that the host has requested.
  virtual WireShape shape() const = 0;
  virtual double rate_hz() const = 0;

  bool streaming() const { return streaming_; }
  /// Whether an image can be begun: the camera streams, is not frozen, and the previous image has been sent.
  bool ready() const { return streaming_ && !frozen_ && !hung_ && sent_ == image_.size(); }
  /// The camera must be ready().
  void begin_image(OctetSpan image, ImageFlaw flaw);

  /// Stops the output of images until it is called with false.
  void freeze(bool frozen) { frozen_ = frozen; }
  /// Stops the output of images until the host resets the device.
  void hang() { hung_ = true; }
  bool hung() const { return hung_; }
  std::uint64_t resets() const { return resets_; }  ///< Number of enumerations, including the first

  /// Sets the state after power-up.
  void power_up();

 protected:
  EmulatedCamera(std::string product, std::string serial) : product_(std::move(product)), serial_(std::move(serial)) {}

  virtual Octets device_descriptor() const = 0;
  virtual Octets configuration_descriptor() const = 0;
  /// Handles requests that are specific to the kind of camera.
  virtual ControlAnswer own_request(const ControlRequest& request, OctetSpan data) = 0;
  /// Fills `answer` with the next bytes of the image, of which `unsent` is left; returns how many of these it took.
  virtual std::size_t pack(OctetSpan unsent, std::size_t room, BulkAnswer& answer) = 0;
  virtual bool owes_transfer() const { return false; }  ///< Whether a transfer without image bytes is due
  virtual void at_power_up() {}
  virtual void at_image(ImageFlaw) {}
  virtual void at_configuration() {}  ///< Called after streaming was stopped

  void start_streaming();
  void stop_streaming();

 private:
  ControlAnswer standard_request(const ControlRequest& request);
  ControlAnswer descriptor(const ControlRequest& request);
  ControlAnswer set_configuration();

  std::string product_, serial_;
  Octets image_;
  std::size_t sent_ = 0;  // Bytes of image_ that have been sent
  bool streaming_ = false, frozen_ = false, hung_ = false;
  bool enumerating_ = false;  // Whether the host has asked for descriptors without having configured the device yet
  std::uint64_t resets_ = 0;
};

}  // namespace azimuth::sim
