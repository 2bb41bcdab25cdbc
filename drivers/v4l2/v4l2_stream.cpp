#include "drivers/v4l2/v4l2_stream.hpp"

#include <algorithm>
#include <cerrno>
#include <optional>
#include <poll.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <utility>

#include "drivers/device/device_clock.hpp"
#include "drivers/v4l2/v4l2_buffers.hpp"
#include "drivers/v4l2/v4l2_finder.hpp"
#include "drivers/v4l2/v4l2_setup.hpp"

namespace azimuth {
namespace v4l2 {

namespace {

/// Smallest number of buffers, so that the driver can fill one while another is read.
constexpr unsigned kFewestBuffers = 2;

/// Largest plausible age at dequeueing of an image whose driver does not name its clock.
constexpr Duration kOldest{1'000'000};

class Stream final : public ImageStream {
 public:
  Stream(Handle handle, const Abilities& abilities)
      : handle_(std::move(handle)), buffer_type_(abilities.buffer_type), events_(::epoll_create1(EPOLL_CLOEXEC)) {
    description_.device = handle_.device();
    description_.name = abilities.card;
    description_.usb_port = usb_port(handle_.calls(), handle_.device());
  }
  ~Stream() override { stop(); }
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;

  /// False: trouble() tells why.
  bool start(const Abilities& abilities, const V4l2Settings& settings);

  int descriptor() const override { return events_.get(); }
  short poll_events() const override { return POLLIN; }
  Read read(Frame& into) override;
  const CameraTrouble& trouble() const override { return trouble_; }
  const StreamDescription& description() const override { return description_; }

 private:
  bool agree(const Abilities& abilities, const V4l2Settings& settings);
  bool make_buffers(int wanted);
  bool map_buffer(unsigned index);
  bool watch(int fd) const;
  bool watch_again() const;
  bool queue(unsigned index);
  bool queue_returned();
  std::optional<Read> dequeue(Frame& into);
  Read nothing_or_failed();
  bool is_ours(const BufferCall& filled) const;
  bool is_leased(const BufferCall& filled) const;
  bool is_older(const BufferCall& filled, Stamp stamp) const;
  bool is_whole(const BufferCall& filled) const;
  void count(std::uint32_t number);
  Frame lease(const BufferCall& filled, Stamp stamp);
  Stamp stamp_of(const BufferCall& filled) const;
  Stamp now() const { return stamp_at(handle_.calls().now()); }
  void stop();
  /// Stores what went wrong, and returns false.
  bool fail(std::string_view what, int error = 0) {
    trouble_ = handle_.trouble(what, error);
    return false;
  }

  Handle handle_;
  std::uint32_t buffer_type_;
  UniqueFd events_;  // an epoll of the device and of the bell for returned leases
  std::shared_ptr<Buffers> buffers_;
  std::uint32_t leased_ = 0;                  // leased slots, one bit each
  std::uint32_t queued_ = 0;                  // slots queued in the driver, one bit each
  std::optional<std::uint32_t> last_number_;  // the driver's number of the last image
  std::uint64_t sequence_ = 1ULL << 32U;      // starts high, in case the driver's numbers go backwards
  bool streaming_ = false;
  Stamp started_{};
  StreamDescription description_;
  CameraTrouble trouble_;
};

bool Stream::start(const Abilities& abilities, const V4l2Settings& settings) {
  if (!agree(abilities, settings)) return false;
  apply_controls(handle_, settings, description_.refused);
  if (!make_buffers(settings.buffers)) return false;
  for (unsigned i = 0; i < buffers_->count(); ++i)
    if (!queue(i)) return false;
  if (!events_ || !watch(handle_.descriptor()) || !watch(buffers_->descriptor())) return fail("epoll", errno);
  started_ = now();
  int type = static_cast<int>(buffer_type_);
  if (const int error = handle_.call(VIDIOC_STREAMON, type)) return fail("VIDIOC_STREAMON", error);
  streaming_ = true;
  return true;
}

bool Stream::agree(const Abilities& abilities, const V4l2Settings& settings) {
  auto agreed = negotiate(handle_, abilities, settings, description_.refused);
  if (!agreed) {
    trouble_ = std::move(agreed.error());
    return false;
  }
  description_.format = agreed->format;
  description_.rate_hz = agreed->rate_hz;
  return true;
}

bool Stream::make_buffers(int wanted) {
  v4l2_requestbuffers request{};
  request.count = static_cast<std::uint32_t>(std::clamp<int>(wanted, kFewestBuffers, FramePool::kMaxSlots));
  request.type = buffer_type_;
  request.memory = V4L2_MEMORY_MMAP;
  if (const int error = handle_.call(VIDIOC_REQBUFS, request)) return fail("VIDIOC_REQBUFS", error);
  if (request.count < kFewestBuffers || request.count > FramePool::kMaxSlots)
    return fail("gives " + std::to_string(request.count) + " buffers, asked for " + std::to_string(wanted));
  buffers_ = std::make_shared<Buffers>(handle_.calls(), UniqueFd(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)));
  for (unsigned i = 0; i < request.count; ++i)
    if (!map_buffer(i)) return false;
  return true;
}

bool Stream::map_buffer(unsigned index) {
  BufferCall buffer(buffer_type_, index);
  if (const int error = buffer.send(handle_, VIDIOC_QUERYBUF)) return fail("VIDIOC_QUERYBUF", error);
  // A JPEG image has no fixed size. The buffer must hold an uncompressed image.
  if (buffer.length() == 0 || buffer.length() < description_.format.bytes())
    return fail("has buffers of " + std::to_string(buffer.length()) + " bytes, too small for an image");
  if (index == 0 && !buffer.stamp_is_monotonic())
    description_.refused.emplace_back(
        "does not say that it stamps images on the monotonic clock: a stamp that cannot be on it gives way to the time "
        "of dequeueing");
  int error = 0;
  const std::span<std::byte> bytes = handle_.calls().map(handle_.descriptor(), buffer.length(), buffer.offset(), error);
  if (error != 0) return fail("mmap", error);
  buffers_->add(bytes);
  return true;
}

bool Stream::watch(int fd) const {
  epoll_event readable{.events = EPOLLIN, .data = {.fd = fd}};
  return ::epoll_ctl(events_.get(), EPOLL_CTL_ADD, fd, &readable) == 0;
}

/// v4l2loopback notifies only a watcher that is added while no image is ready; an earlier watcher would sleep for ever.
/// So the descriptor is watched again when there is nothing left to read, at a cost of two calls per image.
bool Stream::watch_again() const {
  const int fd = handle_.descriptor();
  return ::epoll_ctl(events_.get(), EPOLL_CTL_DEL, fd, nullptr) == 0 && watch(fd);
}

bool Stream::queue(unsigned index) {
  BufferCall buffer(buffer_type_, index);
  if (const int error = buffer.send(handle_, VIDIOC_QBUF)) return fail("VIDIOC_QBUF", error);
  queued_ |= 1U << index;
  return true;
}

bool Stream::queue_returned() {
  const std::uint32_t returned = buffers_->take_returned() & leased_;
  leased_ &= ~returned;
  for (unsigned i = 0; i < buffers_->count(); ++i)
    if ((returned >> i & 1U) != 0 && !queue(i)) return false;
  return true;
}

ImageStream::Read Stream::read(Frame& into) {
  into = Frame{};
  if (!queue_returned()) return Read::failed;
  std::optional<Read> outcome;
  while (!outcome) outcome = dequeue(into);
  return *outcome;
}

/// None: an image from before this stream, to be skipped.
std::optional<ImageStream::Read> Stream::dequeue(Frame& into) {
  BufferCall filled(buffer_type_);
  if (const int error = filled.send(handle_, VIDIOC_DQBUF)) {
    if (error == EAGAIN) return nothing_or_failed();
    fail("VIDIOC_DQBUF", error);
    return Read::failed;
  }
  const std::uint32_t index = filled.buffer().index;
  if (is_leased(filled)) {
    count(filled.buffer().sequence);
    return Read::corrupt;
  }
  if (!is_ours(filled)) {
    fail("gave buffer " + std::to_string(index) + ", which it did not have");
    return Read::failed;
  }
  queued_ &= ~(1U << index);
  const Stamp stamp = stamp_of(filled);
  if (is_older(filled, stamp)) return queue(index) ? std::nullopt : std::optional(Read::failed);
  count(filled.buffer().sequence);
  if (!is_whole(filled)) return queue(index) ? Read::corrupt : Read::failed;
  into = lease(filled, stamp);
  return Read::image;
}

/// A device that is gone or in error reports only this event.
ImageStream::Read Stream::nothing_or_failed() {
  const short events = handle_.calls().poll(handle_.descriptor());
  if ((events & (POLLERR | POLLHUP | POLLNVAL)) == 0) {
    if (watch_again()) return Read::nothing;
    fail("epoll", errno);
    return Read::failed;
  }
  fail((events & POLLERR) != 0 ? "reports an error" : "hung up");
  return Read::failed;
}

bool Stream::is_ours(const BufferCall& filled) const {
  const std::uint32_t index = filled.buffer().index;
  return index < buffers_->count() && (queued_ >> index & 1U) != 0;
}

/// v4l2loopback reuses its few buffers in turn, even leased ones. The leased image is then overwritten, which cannot be
/// prevented. The new image is lost until the lease is returned.
bool Stream::is_leased(const BufferCall& filled) const {
  const std::uint32_t index = filled.buffer().index;
  return index < buffers_->count() && (leased_ >> index & 1U) != 0;
}

/// v4l2loopback delivers old contents of its buffers, with numbers that do not belong to the images.
bool Stream::is_older(const BufferCall& filled, Stamp stamp) const {
  return !filled.stamp_is_monotonic() && stamp < started_;
}

bool Stream::is_whole(const BufferCall& filled) const {
  if ((filled.buffer().flags & V4L2_BUF_FLAG_ERROR) != 0) return false;
  const std::span<const std::byte> bytes = buffers_->bytes(filled.buffer().index);
  if (filled.end() > bytes.size() || filled.begin() >= filled.end()) return false;
  const std::size_t size = filled.end() - filled.begin();
  if (description_.format.pixels != PixelFormat::mjpeg) return size >= description_.format.bytes();
  const auto image = bytes.subspan(filled.begin(), size);
  return size > 2 && image[0] == std::byte{0xFF} && image[1] == std::byte{0xD8};  // start of image
}

/// Unwraps the driver's 32-bit number by the shorter way.
void Stream::count(std::uint32_t number) {
  const auto step = static_cast<std::int32_t>(number - last_number_.value_or(number));
  sequence_ += static_cast<std::uint64_t>(std::int64_t{step});
  last_number_ = number;
}

Frame Stream::lease(const BufferCall& filled, Stamp stamp) {
  const v4l2_buffer& buffer = filled.buffer();
  const bool is_jpeg = description_.format.pixels == PixelFormat::mjpeg;
  const std::size_t size = is_jpeg ? filled.end() - filled.begin() : description_.format.bytes();
  leased_ |= 1U << buffer.index;
  Frame frame(buffers_, buffer.index, description_.format, buffers_->bytes(buffer.index).subspan(filled.begin(), size));
  frame.stamp = stamp;
  frame.sequence = sequence_;
  return frame;
}

/// Some drivers stamp on the monotonic clock without saying so. A stamp on another clock differs from the current time
/// by more than the age of an image.
Stamp Stream::stamp_of(const BufferCall& filled) const {
  const Stamp stamp = to_stamp(filled.buffer().timestamp);
  if (filled.stamp_is_monotonic()) return stamp;
  const Stamp now = this->now();
  return now - kOldest <= stamp && stamp <= now ? stamp : now;
}

/// Stops the stream, even when the device is gone; a failed step then does not matter. Leased buffers stay with their
/// leases. The driver's buffers are released, so that the next stream can have its own.
void Stream::stop() {
  int type = static_cast<int>(buffer_type_);
  if (streaming_) handle_.call(VIDIOC_STREAMOFF, type);
  if (!buffers_) return;
  buffers_.reset();
  v4l2_requestbuffers none{};
  none.type = buffer_type_;
  none.memory = V4L2_MEMORY_MMAP;
  handle_.call(VIDIOC_REQBUFS, none);
}

}  // namespace
}  // namespace v4l2

OpenedStream open_v4l2(const V4l2Settings& settings, v4l2::Calls& calls) {
  auto opened = v4l2::open_named(calls, settings.device);
  if (!opened) return tl::unexpected(std::move(opened.error()));
  v4l2::Handle& handle = *opened;
  v4l2::Abilities abilities;
  if (const int error = v4l2::ask_abilities(handle, abilities))
    return tl::unexpected(handle.trouble("VIDIOC_QUERYCAP", error));
  if (abilities.buffer_type == 0) return tl::unexpected(handle.trouble("is no camera that streams"));
  auto stream = std::make_unique<v4l2::Stream>(std::move(handle), abilities);
  if (!stream->start(abilities, settings)) return tl::unexpected(stream->trouble());
  return stream;
}

}  // namespace azimuth
