#pragma once
// Images as LCM messages (image_t) and back.
//
// The decoding function takes bytes from anywhere; see messages.hpp. Thread contract: reentrant.

#include <azimuth/image_t.hpp>
#include <cstdint>
#include <optional>

#include "base/bytes.hpp"
#include "slam/sample/image.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth {

/// An image as it lies in a message. Borrows the message's bytes.
struct ImageMessage {
  Stamp stamp{};
  ImageView image;         ///< without bytes: a JPEG image that could not be read when the message was made
  bool supported = false;  ///< false: of a pixel format that nothing here can read; `image` is empty
};

/// Whether the bytes claim to be an image_t: the channel's name is in use for other things too.
bool claims_image(Bytes data);

/// Looks only at the frame round the pixels. Nothing when the bytes are no such message, or say of pixels in a
/// supported format what cannot be: a size beyond kMaxFrameSide_px, rows that overlap, fewer bytes than rows.
std::optional<ImageMessage> decode_image(Bytes data);

/// `image` as it is; a view without bytes makes an empty JPEG image. `message` is used again.
void fill_message(const ImageView& image, Stamp stamp, image_t& message);

}  // namespace azimuth
