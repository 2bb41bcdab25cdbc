#include "tests/equipment/usb_camera/loopback_output.hpp"

#include <cerrno>
#include <cmath>
#include <fcntl.h>
#include <fmt/format.h>
#include <linux/videodev2.h>
#include <sys/ioctl.h>
#include <system_error>
#include <unistd.h>

#include "tests/equipment/usb_camera/log_line.hpp"

namespace azimuth::sim {
namespace {

std::uint32_t fourcc(WireFormat format) {
  switch (format) {
    case WireFormat::yuyv:
      return V4L2_PIX_FMT_YUYV;
    case WireFormat::uyvy:
      return V4L2_PIX_FMT_UYVY;
    case WireFormat::nv12:
      return V4L2_PIX_FMT_NV12;
    case WireFormat::mjpeg:
      return V4L2_PIX_FMT_MJPEG;
    default:
      return V4L2_PIX_FMT_GREY;
  }
}

v4l2_format format_of(const WireShape& shape) {
  v4l2_format format{};
  format.type = V4L2_BUF_TYPE_VIDEO_OUTPUT;
  v4l2_pix_format& pixels = format.fmt.pix;
  pixels.width = static_cast<std::uint32_t>(shape.width_px);
  pixels.height = static_cast<std::uint32_t>(shape.height_px);
  pixels.pixelformat = fourcc(shape.format);
  pixels.field = V4L2_FIELD_NONE;
  pixels.colorspace = shape.format == WireFormat::mjpeg ? V4L2_COLORSPACE_JPEG : V4L2_COLORSPACE_SMPTE170M;
  const bool planar = shape.format == WireFormat::nv12;
  pixels.bytesperline = planar ? pixels.width : pixels.width * static_cast<std::uint32_t>(shape.bits_per_pixel()) / 8;
  pixels.sizeimage = static_cast<std::uint32_t>(shape.bytes());
  if (shape.format == WireFormat::mjpeg) pixels.sizeimage = pixels.width * pixels.height * 3;
  return format;
}

}  // namespace

std::optional<std::string> LoopbackOutput::failed(const char* what, int error) const {
  return fmt::format("{}: {}: {}", device_, what, std::generic_category().message(error));
}

std::optional<std::string> LoopbackOutput::plug() {
  if (node_) return "is plugged in already";
  UniqueFd node(::open(device_.c_str(), O_RDWR | O_CLOEXEC));
  if (!node) return failed("open", errno);
  v4l2_format format = format_of(shape_);
  if (::ioctl(node.get(), VIDIOC_S_FMT, &format) != 0) return failed("VIDIOC_S_FMT", errno);
  if (format.fmt.pix.pixelformat != fourcc(shape_.format)) return failed("VIDIOC_S_FMT gives another format", EINVAL);
  v4l2_streamparm rate{};
  rate.type = V4L2_BUF_TYPE_VIDEO_OUTPUT;
  rate.parm.output.timeperframe = {1000, static_cast<std::uint32_t>(std::lround(1000 * rate_hz_))};
  if (::ioctl(node.get(), VIDIOC_S_PARM, &rate) != 0) log_line(*failed("VIDIOC_S_PARM", errno));
  node_ = std::move(node);
  frozen_ = false;
  return std::nullopt;
}

std::optional<std::string> LoopbackOutput::unplug() {
  if (!node_) return "is not plugged in";
  node_ = UniqueFd();
  return std::nullopt;
}

void LoopbackOutput::send(OctetSpan image, ImageFlaw flaw) {
  const OctetSpan written = flaw == ImageFlaw::none ? image : image.first(image.size() / 2);
  if (::write(node_.get(), written.data(), written.size()) >= 0) return;
  if (write_failures_++ == 0) log_line(*failed("write", errno));
}

std::string LoopbackOutput::status() const {
  return fmt::format("plugged={:d} size={}x{} rate_hz={:g} write_failures={}", plugged(), shape_.width_px,
                     shape_.height_px, rate_hz_, write_failures_);
}

}  // namespace azimuth::sim
