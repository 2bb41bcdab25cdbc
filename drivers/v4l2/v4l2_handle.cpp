#include "drivers/v4l2/v4l2_handle.hpp"

#include <cstring>
#include <system_error>

namespace azimuth::v4l2 {

std::string error_text(int error) { return std::generic_category().message(error); }

CameraTrouble Handle::trouble(std::string_view what, int error) const {
  std::string text = device_ + ": " + std::string(what);
  if (error != 0) text += ": " + error_text(error);
  return {std::move(text), error};
}

int ask_abilities(const Handle& handle, Abilities& abilities) {
  v4l2_capability answer{};
  if (const int error = handle.call(VIDIOC_QUERYCAP, answer)) return error;
  const auto* card = reinterpret_cast<const char*>(answer.card);
  abilities.card.assign(card, ::strnlen(card, sizeof answer.card));
  const std::uint32_t can =
      (answer.capabilities & V4L2_CAP_DEVICE_CAPS) != 0 ? answer.device_caps : answer.capabilities;
  abilities.buffer_type = 0;
  if ((can & V4L2_CAP_STREAMING) == 0) return 0;
  if ((can & V4L2_CAP_VIDEO_CAPTURE) != 0)
    abilities.buffer_type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  else if ((can & V4L2_CAP_VIDEO_CAPTURE_MPLANE) != 0)
    abilities.buffer_type = V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE;
  return 0;
}

}  // namespace azimuth::v4l2
