#include "drivers/iidc/iidc_stream.hpp"

#include <bit>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <poll.h>
#include <span>
#include <unistd.h>
#include <utility>
#include <vector>

#include "base/clocks.hpp"
#include "drivers/camera/frame.hpp"
#include "drivers/iidc/iidc_camera.hpp"
#include "drivers/iidc/iidc_setup.hpp"
#include "drivers/iidc/iidc_stamps.hpp"
#include "drivers/iidc/iidc_text.hpp"

namespace azimuth {
namespace iidc {
namespace {

/// Reads both clocks practically at once. An interrupted reading would look like a step of the wall clock, so it is
/// repeated.
ClockReading read_clocks() {
  constexpr int kAttempts = 3;
  constexpr std::int64_t kAtOnce_us = 100;
  ClockReading reading;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const std::int64_t before_us = now_on(CLOCK_MONOTONIC).count();
    reading.wall_us = now_on(CLOCK_REALTIME).count();
    const std::int64_t took_us = now_on(CLOCK_MONOTONIC).count() - before_us;
    reading.monotonic_us = before_us + took_us / 2;
    if (took_us < kAtOnce_us) break;
  }
  return reading;
}

/// The ring of libdc1394, filled by the camera from start() until destruction.
class Capture {
 public:
  explicit Capture(dc1394camera_t* camera) : camera_(camera) {}
  Capture(const Capture&) = delete;
  Capture& operator=(const Capture&) = delete;

  dc1394error_t set_up(int buffers) {
    const auto error = dc1394_capture_setup(camera_, static_cast<std::uint32_t>(buffers), DC1394_CAPTURE_FLAGS_DEFAULT);
    set_up_ = error == DC1394_SUCCESS;
    if (set_up_) descriptor_ = dc1394_capture_get_fileno(camera_);
    return error;
  }
  dc1394error_t start() {
    const auto error = dc1394_video_set_transmission(camera_, DC1394_ON);
    sending_ = error == DC1394_SUCCESS;
    return error;
  }

  // A failure here means that the camera has gone.
  ~Capture() {
    if (sending_) dc1394_video_set_transmission(camera_, DC1394_OFF);
    // On FireWire, when the camera has gone, the library stops before it closes the descriptor.
    if (set_up_ && dc1394_capture_stop(camera_) == DC1394_IOCTL_FAILURE && descriptor_ >= 0) ::close(descriptor_);
  }

  int descriptor() const { return descriptor_; }

 private:
  dc1394camera_t* camera_;
  int descriptor_ = -1;
  bool set_up_ = false, sending_ = false;
};

/// The driver's own buffers for images. Thread contract: as for FramePool.
class IidcFrames : public FramePool {
 public:
  /// Enough for the images that a driver holds unread and those on their way to perception.
  static constexpr unsigned kSlots = 10;

  explicit IidcFrames(const FrameFormat& format)
      : FramePool(UniqueFd{}), bytes_(format.bytes()), memory_(kSlots * bytes_) {}

  /// A buffer that is not leased. It stays free until lease().
  std::optional<unsigned> free_slot() {
    free_ |= take_returned();
    return free_ == 0 ? std::nullopt : std::optional(static_cast<unsigned>(std::countr_zero(free_)));
  }
  std::span<std::byte> buffer(unsigned slot) { return std::span(memory_).subspan(slot * bytes_, bytes_); }

  /// `self` owns this object.
  static Frame lease(const std::shared_ptr<IidcFrames>& self, unsigned slot, const FrameFormat& format) {
    self->free_ &= ~(1U << slot);
    return {self, slot, format, self->buffer(slot)};
  }

 private:
  std::size_t bytes_;
  std::vector<std::byte> memory_;
  std::uint32_t free_ = (1U << kSlots) - 1;
};

class IidcStream : public ImageStream {
 public:
  explicit IidcStream(OpenCamera camera) : camera_(std::move(camera)), capture_(camera_.get()), clock_(read_clocks()) {}

  /// False: trouble() tells why.
  bool open(const IidcSettings& settings) {
    const std::optional<ImageSetup> setup = set_up_image(camera_, settings, trouble_);
    if (!setup) return false;
    describe(*setup);
    set_features(camera_, settings, description_.refused);
    frames_ = std::make_shared<IidcFrames>(setup->format);
    counter_ = FrameCounter(setup->rate_hz);
    ring_frames_ = settings.dma_buffers;
    return start();
  }

  int descriptor() const override { return capture_.descriptor(); }
  short poll_events() const override { return POLLIN; }
  Read read(Frame& into) override;
  const CameraTrouble& trouble() const override { return trouble_; }
  const StreamDescription& description() const override { return description_; }

 private:
  void describe(const ImageSetup& setup);
  bool start();
  bool check(dc1394error_t error, const char* what);
  bool has_event() const;
  Read without_frame(bool was_event);
  Read take(const dc1394video_frame_t& raw, Frame& into);
  bool is_damaged(const dc1394video_frame_t& raw);

  OpenCamera camera_;
  Capture capture_;  // destroyed before the camera
  StreamDescription description_;
  CameraTrouble trouble_;
  std::shared_ptr<IidcFrames> frames_;
  StampClock clock_;
  FrameCounter counter_{0.0};
  int ring_frames_ = 0;
  std::uint32_t generation_ = 0;
  bool failed_ = false;
};

void IidcStream::describe(const ImageSetup& setup) {
  const auto text = [](const char* words) { return std::string(words != nullptr ? words : ""); };
  description_.device = camera_.guid;
  description_.name = text(camera_.get()->vendor) + " " + text(camera_.get()->model);
  description_.format = setup.format;
  description_.rate_hz = setup.rate_hz;
  description_.usb_port = usb_port_of(camera_);
  description_.refused = setup.refused;
}

bool IidcStream::start() {
  if (!check(capture_.set_up(ring_frames_), "preparing its frames")) return false;
  if (descriptor() < 0) return check(DC1394_FAILURE, "preparing its frames");
  if (!check(capture_.start(), "starting it")) return false;
  generation_ = bus_generation(camera_);
  return true;
}

bool IidcStream::check(dc1394error_t error, const char* what) {
  if (error == DC1394_SUCCESS) return true;
  trouble_ = trouble_of(camera_, what, error);
  failed_ = true;
  return false;
}

bool IidcStream::has_event() const {
  pollfd event{descriptor(), POLLIN, 0};
  return ::poll(&event, 1, 0) > 0;
}

ImageStream::Read IidcStream::read(Frame& into) {
  into = Frame{};
  // The loop is bounded by the number of frames that can have waited.
  for (int frames = 0; !failed_ && frames < ring_frames_; ++frames) {
    const bool event = has_event();
    dc1394video_frame_t* raw = nullptr;
    if (!check(dc1394_capture_dequeue(camera_.get(), DC1394_CAPTURE_POLICY_POLL, &raw), "taking a frame off")) break;
    if (raw == nullptr) return without_frame(event);
    const Read result = take(*raw, into);
    // If this fails, the image is still valid, and the next call reports the failure.
    check(dc1394_capture_enqueue(camera_.get(), raw), "giving a frame back");
    if (result != Read::nothing) return result;
  }
  return failed_ ? Read::failed : Read::nothing;
}

/// On FireWire, an event without a frame is a bus reset. The library learns of it when the camera is asked something.
ImageStream::Read IidcStream::without_frame(bool was_event) {
  clock_.drained(read_clocks());
  if (!was_event) return Read::nothing;
  dc1394switch_t sending = DC1394_ON;
  if (!check(dc1394_video_get_transmission(camera_.get(), &sending), "asking whether it still sends"))
    return Read::failed;
  const bool reset = bus_generation(camera_) != generation_;
  if (!reset && sending == DC1394_ON) return Read::nothing;
  trouble_ = {"IIDC camera " + camera_.guid + (reset ? ": the bus was reset" : ": it has stopped sending"), EIO};
  failed_ = true;
  return Read::failed;
}

bool IidcStream::is_damaged(const dc1394video_frame_t& raw) {
  const FrameFormat& format = description_.format;
  return dc1394_capture_is_frame_corrupt(camera_.get(), const_cast<dc1394video_frame_t*>(&raw)) != DC1394_FALSE ||
         raw.image == nullptr || std::cmp_not_equal(raw.size[0], format.width_px) ||
         std::cmp_not_equal(raw.size[1], format.height_px) || raw.image_bytes < format.bytes();
}

/// `nothing`: there was no free buffer for the frame.
ImageStream::Read IidcStream::take(const dc1394video_frame_t& raw, Frame& into) {
  const Stamp stamp = clock_.monotonic(raw.timestamp, read_clocks());
  const std::uint64_t sequence = counter_.next(stamp);
  if (is_damaged(raw)) return Read::corrupt;
  const std::optional<unsigned> slot = frames_->free_slot();
  if (!slot) return Read::nothing;
  std::memcpy(frames_->buffer(*slot).data(), raw.image, description_.format.bytes());
  into = IidcFrames::lease(frames_, *slot, description_.format);
  into.stamp = stamp;
  into.sequence = sequence;
  return Read::image;
}

}  // namespace
}  // namespace iidc

OpenedStream open_iidc(const IidcSettings& settings) {
  if (const auto problem = iidc::problem_of(settings))
    return tl::unexpected(CameraTrouble{"IIDC camera: " + std::string(problem->key) + " " + problem->text, EINVAL});
  auto camera = iidc::find_camera(settings);
  if (!camera) return tl::unexpected(std::move(camera.error()));
  auto stream = std::make_unique<iidc::IidcStream>(*std::move(camera));
  if (!stream->open(settings)) return tl::unexpected(stream->trouble());
  return stream;
}

}  // namespace azimuth
