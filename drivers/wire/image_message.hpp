#pragma once
// Images as LCM messages (image_t), and back.
//
// The decoding function accepts bytes from any origin; see messages.hpp. Thread contract: reentrant.

#include <azimuth/image_t.hpp>
#include <cstdint>
#include <optional>

#include "base/bytes.hpp"
#include "slam/sample/image.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth {

/// An image inside a message. Borrows the message's bytes.
struct ImageMessage {
  Stamp stamp{};
  ImageView image;         ///< without bytes: a JPEG image that could not be read when the message was made
  bool supported = false;  ///< false: the pixel format is not supported; `image` is empty
};

/// True: the bytes claim to be an image_t. Other message types use the same channel name.
bool claims_image(Bytes data);

/// Checks only the message around the pixels. None when the bytes are not such a message, or when an image in a
/// supported format is impossible: a side beyond kMaxFrameSide_px, overlapping rows, or fewer bytes than the rows need.
std::optional<ImageMessage> decode_image(Bytes data);

/// Writes `image` unchanged; a view without bytes becomes an empty JPEG image. The storage of `message` is reused.
void fill_message(const ImageView& image, Stamp stamp, image_t& message);

}  // namespace azimuth
