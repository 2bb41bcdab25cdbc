#include "tests/drivers/v4l2/fake_v4l2.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <sys/eventfd.h>
#include <unistd.h>

namespace azimuth::test {

namespace fs = std::filesystem;

FakeV4l2::FakeV4l2() : ready_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
  fs::create_directories(nodes());
  fs::create_directories(classes());
  add_node("video0", "1-2");
}

void FakeV4l2::add_node(const std::string& node, const std::string& port, const std::string& vendor,
                        const std::string& product, const std::string& serial) {
  const auto write = [](const fs::path& file, const std::string& text) { std::ofstream(file) << text << '\n'; };
  const fs::path device = folder_.path() / "devices" / (port.empty() ? node : port);
  fs::create_directories(device / "interface");
  if (!port.empty()) {
    write(device / "idVendor", vendor);
    write(device / "idProduct", product);
    if (!serial.empty()) write(device / "serial", serial);
  }
  fs::create_directories(classes() / node);
  fs::create_symlink(device / "interface", classes() / node / "device");
  std::ofstream(nodes() / node) << "";
}

void FakeV4l2::remove_node(const std::string& node) {
  fs::remove_all(classes() / node);
  fs::remove(nodes() / node);
}

int FakeV4l2::open(const std::string& path) {
  ++calls_;
  std::error_code error;
  const fs::path real = fs::canonical(path, error);
  if (error) return -ENOENT;
  if (open_error != 0) return -open_error;
  opened_node = real.filename().string();
  ++open_;
  return ::dup(ready_.get());
}

void FakeV4l2::close(int fd) {
  --open_;
  ::close(fd);
}

std::span<std::byte> FakeV4l2::map(int, std::size_t bytes, std::uint32_t offset, int& error) {
  ++calls_;
  error = fail_after >= 0 && calls_ > fail_after ? failure : map_error;
  if (error != 0) return {};
  ++mapped_;
  return std::span(memory_.at(offset / 4096)).first(bytes);
}

void FakeV4l2::unmap(std::span<std::byte>) { --mapped_; }

bool FakeV4l2::fill(FakeFill image) {
  if (!streaming_ || queued_.empty()) return false;
  const std::uint32_t index = queued_.front();
  queued_.pop_front();
  std::vector<std::byte>& bytes = memory_[index];
  std::ranges::fill(bytes, static_cast<std::byte>(image.value));
  if (code_ == V4L2_PIX_FMT_MJPEG && image.value == 0) {
    bytes[0] = std::byte{0xFF};
    bytes[1] = std::byte{0xD8};
  }
  filled_.emplace_back(index, image);
  const std::uint64_t one = 1;
  return ::write(ready_.get(), &one, sizeof one) == sizeof one;
}

int FakeV4l2::ioctl(int, unsigned long request, void* argument) {
  ++calls_;
  if (fail_after >= 0 && calls_ > fail_after) return failure;
  const auto set = failing.find(request);
  return set != failing.end() ? set->second : answer(request, argument);
}

int FakeV4l2::answer(unsigned long request, void* argument) {
  switch (request) {
    case VIDIOC_QUERYCAP: {
      auto& answer = *static_cast<v4l2_capability*>(argument);
      std::memcpy(answer.card, card.data(), std::min(card.size(), sizeof answer.card));
      const bool metadata = std::ranges::find(metadata_, opened_node) != metadata_.end();
      answer.device_caps = metadata ? V4L2_CAP_META_CAPTURE | V4L2_CAP_STREAMING : capabilities;
      answer.capabilities = capabilities | V4L2_CAP_DEVICE_CAPS;
      return 0;
    }
    case VIDIOC_ENUM_FMT: {
      auto& entry = *static_cast<v4l2_fmtdesc*>(argument);
      if (entry.index >= formats.size()) return EINVAL;
      entry.pixelformat = formats[entry.index].code;
      return 0;
    }
    case VIDIOC_ENUM_FRAMEINTERVALS: {
      auto& entry = *static_cast<v4l2_frmivalenum*>(argument);
      const FakeV4l2Format* const known = format(entry.pixel_format);
      if (!has_rates || !known || entry.index > 0) return EINVAL;
      entry.type = V4L2_FRMIVAL_TYPE_DISCRETE;
      entry.discrete = {1000, static_cast<std::uint32_t>(std::lround(1000 * known->fastest_hz))};
      return 0;
    }
    case VIDIOC_G_FMT:
      tell_format(*static_cast<v4l2_format*>(argument));
      return 0;
    case VIDIOC_S_FMT:
      return set_format(*static_cast<v4l2_format*>(argument));
    case VIDIOC_G_PARM:
    case VIDIOC_S_PARM:
      return parameters(request, *static_cast<v4l2_streamparm*>(argument));
    case VIDIOC_QUERYCTRL:
      return query_control(*static_cast<v4l2_queryctrl*>(argument));
    case VIDIOC_QUERYMENU: {
      const auto& item = *static_cast<v4l2_querymenu*>(argument);
      const auto known = controls.find(item.id);
      if (known == controls.end()) return EINVAL;
      const auto& menu = known->second.menu;
      return std::ranges::find(menu, static_cast<int>(item.index)) != menu.end() ? 0 : EINVAL;
    }
    case VIDIOC_S_EXT_CTRLS:
    case VIDIOC_G_EXT_CTRLS:
      return controls_call(request, *static_cast<v4l2_ext_controls*>(argument));
    case VIDIOC_REQBUFS:
      return request_buffers(*static_cast<v4l2_requestbuffers*>(argument));
    case VIDIOC_QUERYBUF:
      return query_buffer(*static_cast<v4l2_buffer*>(argument));
    case VIDIOC_QBUF:
      return queue(*static_cast<v4l2_buffer*>(argument));
    case VIDIOC_DQBUF:
      return dequeue(*static_cast<v4l2_buffer*>(argument));
    case VIDIOC_STREAMON:
      streaming_ = true;
      return 0;
    case VIDIOC_STREAMOFF:
      streaming_ = false;
      queued_.clear();
      filled_.clear();
      return 0;
    default:
      return ENOTTY;
  }
}

const FakeV4l2Format* FakeV4l2::format(std::uint32_t code) const {
  const auto known = std::ranges::find(formats, code, &FakeV4l2Format::code);
  return known == formats.end() ? nullptr : &*known;
}

std::uint32_t FakeV4l2::stride() const {
  const FakeV4l2Format* const known = format(code_);
  const int bytes = known ? known->bytes_per_pixel : 0;
  return bytes == 0 ? 0 : static_cast<std::uint32_t>(bytes * width_) + padding_bytes;
}

std::uint32_t FakeV4l2::image_bytes() const {
  const auto height = static_cast<std::uint32_t>(height_);
  if (stride() == 0) return static_cast<std::uint32_t>(width_) * height;
  return code_ == V4L2_PIX_FMT_NV12 ? stride() * height * 3 / 2 : stride() * height;
}

int FakeV4l2::set_format(v4l2_format& wanted) {
  const bool planes = has_planes();
  const std::uint32_t code = planes ? wanted.fmt.pix_mp.pixelformat : wanted.fmt.pix.pixelformat;
  const auto width = static_cast<int>(planes ? wanted.fmt.pix_mp.width : wanted.fmt.pix.width);
  const auto height = static_cast<int>(planes ? wanted.fmt.pix_mp.height : wanted.fmt.pix.height);
  const FakeV4l2Format& chosen = format(code) ? *format(code) : formats.front();
  code_ = chosen.code;
  const bool has_size = std::ranges::find(chosen.sizes, std::pair(width, height)) != chosen.sizes.end();
  std::tie(width_, height_) = has_size ? std::pair(width, height) : chosen.sizes.front();
  tell_format(wanted);
  return 0;
}

void FakeV4l2::tell_format(v4l2_format& into) const {
  if (has_planes()) {
    auto& pix = into.fmt.pix_mp;
    pix = {};
    pix.pixelformat = code_;
    pix.width = static_cast<std::uint32_t>(width_);
    pix.height = static_cast<std::uint32_t>(height_);
    pix.field = field;
    pix.num_planes = 1;
    pix.plane_fmt[0].bytesperline = stride();
    pix.plane_fmt[0].sizeimage = image_bytes();
    return;
  }
  auto& pix = into.fmt.pix;
  pix = {};
  pix.pixelformat = code_;
  pix.width = static_cast<std::uint32_t>(width_);
  pix.height = static_cast<std::uint32_t>(height_);
  pix.field = field;
  pix.bytesperline = stride();
  pix.sizeimage = image_bytes();
}

int FakeV4l2::parameters(unsigned long request, v4l2_streamparm& all) {
  if (!has_rates) return ENOTTY;
  auto& capture = all.parm.capture;
  if (request == VIDIOC_S_PARM && capture.timeperframe.numerator > 0) {
    const double wanted = static_cast<double>(capture.timeperframe.denominator) / capture.timeperframe.numerator;
    rate_hz_ = std::min(wanted, format(code_)->fastest_hz);
  }
  capture.capability = V4L2_CAP_TIMEPERFRAME;
  capture.timeperframe = {1000, static_cast<std::uint32_t>(std::lround(1000 * rate_hz_))};
  return 0;
}

int FakeV4l2::query_control(v4l2_queryctrl& query) const {
  const auto known = controls.find(query.id);
  if (known == controls.end()) return EINVAL;
  query.minimum = known->second.minimum;
  query.maximum = known->second.maximum;
  query.flags = 0;
  return 0;
}

int FakeV4l2::controls_call(unsigned long request, v4l2_ext_controls& all) {
  for (std::uint32_t i = 0; i < all.count; ++i) {
    const auto known = controls.find(all.controls[i].id);
    if (known == controls.end()) return EINVAL;
    if (request == VIDIOC_G_EXT_CTRLS)
      all.controls[i].value = known->second.value;
    else if (!known->second.stubborn)
      known->second.value = all.controls[i].value;
  }
  return 0;
}

int FakeV4l2::request_buffers(v4l2_requestbuffers& request) {
  for (auto& bytes : memory_) orphans_.push_back(std::move(bytes));
  memory_.clear();
  queued_.clear();
  filled_.clear();
  if (request.count == 0) return 0;
  request.count = std::max(least_buffers, std::min(request.count, most_buffers));
  memory_.assign(request.count, std::vector<std::byte>(buffer_bytes > 0 ? buffer_bytes : image_bytes()));
  return 0;
}

int FakeV4l2::query_buffer(v4l2_buffer& buffer) {
  if (buffer.index >= memory_.size()) return EINVAL;
  const auto length = static_cast<std::uint32_t>(memory_[buffer.index].size());
  buffer.flags = stamp_flags;
  if (has_planes()) {
    buffer.m.planes[0].length = length;
    buffer.m.planes[0].m.mem_offset = buffer.index * 4096;
  } else {
    buffer.length = length;
    buffer.m.offset = buffer.index * 4096;
  }
  return 0;
}

int FakeV4l2::queue(const v4l2_buffer& buffer) {
  if (buffer.index >= memory_.size() || std::ranges::find(queued_, buffer.index) != queued_.end()) return EINVAL;
  queued_.push_back(buffer.index);
  return 0;
}

int FakeV4l2::dequeue(v4l2_buffer& buffer) {
  if (filled_.empty()) return EAGAIN;
  std::uint64_t rings = 0;
  const auto [index, image] = filled_.front();
  filled_.pop_front();
  if (filled_.empty() && ::read(ready_.get(), &rings, sizeof rings) < 0) return EAGAIN;
  buffer.index = image.index.value_or(index);
  buffer.flags = image.flags;
  buffer.sequence = image.sequence;
  buffer.timestamp = {image.stamp_us / 1'000'000, image.stamp_us % 1'000'000};
  const std::uint32_t used = image.bytesused.value_or(image_bytes());
  if (has_planes()) {
    buffer.m.planes[0].bytesused = used;
    buffer.m.planes[0].data_offset = image.data_offset;
    buffer.m.planes[0].length = static_cast<std::uint32_t>(memory_[index].size());
  } else {
    buffer.bytesused = used;
    buffer.length = static_cast<std::uint32_t>(memory_[index].size());
  }
  return 0;
}

}  // namespace azimuth::test
