#include "drivers/camera/camera_driver.hpp"

#include <algorithm>
#include <utility>

#include "drivers/device/device_clock.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;
using Clock = CameraDriver::Clock;

constexpr Clock::duration kFirstBackOff = 50ms, kLongestBackOff = 1s;
constexpr Clock::duration kStillOpening = 10ms;
constexpr Clock::duration kIdle = 1s;
constexpr double kSilentIntervals = 4.0;
/// Limits the reads of one turn, so that a device that floods does not keep the thread from its other work.
constexpr int kMostReads = 16;
/// Consecutive failed openings of a camera that is present, after which a reset of its port is requested.
constexpr int kHungOpenings = 3;

/// A time in seconds for a person, e.g. "0.8".
std::string seconds_text(Clock::duration time) {
  const auto tenths = std::chrono::round<std::chrono::duration<std::int64_t, std::deci>>(time).count();
  return std::to_string(tenths / 10) + '.' + std::to_string(tenths % 10);
}

std::string size_text(int width_px, int height_px) {
  return std::to_string(width_px) + 'x' + std::to_string(height_px);
}

std::string described(const StreamDescription& description) {
  const FrameFormat& format = description.format;
  std::string words = "images come from " + description.device;
  if (!description.name.empty()) words += " (" + description.name + ')';
  return words + ", " + std::string(name(format.pixels)) + ' ' + size_text(format.width_px, format.height_px);
}

}  // namespace

CameraDriver::CameraDriver(const CameraDriverSettings& settings, StreamOpener open)
    : settings_(settings), open_(std::move(open)), back_off_(kFirstBackOff, kLongestBackOff) {}

int CameraDriver::descriptor() const { return stream_ && unread_count_ < kMaxUnread ? stream_->descriptor() : -1; }

short CameraDriver::poll_events() const { return stream_ ? stream_->poll_events() : short{0}; }

Clock::duration CameraDriver::due_in(Clock::time_point now) const {
  if (fresh_) return {};
  const auto due = stream_ ? last_image_ + patience() : back_off_.due();
  return std::clamp(due - now, Clock::duration{}, kIdle);
}

void CameraDriver::turn(Clock::time_point now) {
  // An opening may have taken long, so the time of silence counts from this turn on.
  if (std::exchange(fresh_, false)) last_image_ = now;
  if (!stream_ && back_off_.is_due(now)) return open(now);
  if (stream_) read(now);
  if (stream_) watch_silence(now);
}

void CameraDriver::wake(Clock::time_point now) { back_off_.wake(now); }

void CameraDriver::open(Clock::time_point now) {
  OpenedStream opened = open_();
  if (!opened) {
    judge_opening(opened.error());
    return fail(Connection::away, opened.error().text, now);
  }
  if (!*opened) return back_off_.postpone(now + kStillOpening);
  accept(*std::move(opened), now);
}

/// An absent camera needs no reset, even if it was silent before: it was unplugged, or is being reset.
void CameraDriver::judge_opening(const CameraTrouble& trouble) {
  if (is_absent(trouble.error_number)) state_.wants_port_reset.clear();
  hung_openings_ = is_hung(trouble.error_number) ? hung_openings_ + 1 : 0;
  if (hung_openings_ >= kHungOpenings) state_.wants_port_reset = state_.description.usb_port;
}

void CameraDriver::accept(std::unique_ptr<ImageStream> stream, Clock::time_point now) {
  state_.description = stream->description();
  if (const auto trouble = size_trouble(state_.description)) return fail(Connection::away, *trouble, now);
  stream_ = std::move(stream);
  order_.begin_stream();
  fresh_ = true;
  hung_openings_ = 0;
  if (state_.connection == Connection::away) news_.enter(Connection::starting, {}, state_);
  news_.call_running(described(state_.description));
  tell_refusals();
}

std::optional<std::string> CameraDriver::size_trouble(const StreamDescription& description) const {
  const FrameFormat& format = description.format;
  const int width_px = settings_.width_px > 0 ? settings_.width_px : format.width_px;
  const int height_px = settings_.height_px > 0 ? settings_.height_px : format.height_px;
  if (format.width_px == width_px && format.height_px == height_px) return std::nullopt;
  return description.device + ": gives images of " + size_text(format.width_px, format.height_px) +
         ", the rig's camera has " + size_text(width_px, height_px);
}

void CameraDriver::read(Clock::time_point now) {
  for (int i = 0; i < kMostReads && unread_count_ < kMaxUnread; ++i) {
    switch (stream_->read(frame_)) {
      case ImageStream::Read::image:
        receive(std::move(frame_), now);
        frame_ = Frame{};
        break;
      case ImageStream::Read::corrupt:
        ++state_.corrupt;
        order_.corrupt();
        break;
      case ImageStream::Read::nothing:
        return;
      case ImageStream::Read::failed:
        return fail(Connection::away, stream_->trouble().text, now);
    }
  }
}

void CameraDriver::receive(Frame frame, Clock::time_point now) {
  const ImageOrder::Verdict verdict = order_.judge(frame.sequence, frame.stamp, now);
  last_image_ = now;
  if (state_.connection != Connection::running) begin_running();
  state_.missing += verdict.missing;
  if (!verdict.usable) {
    ++state_.stamps_dropped;
    return;
  }
  state_.stamps_replaced += verdict.replaced ? 1 : 0;
  frame.stamp = verdict.stamp;
  frame.sequence = verdict.sequence;
  ++state_.images;
  unread_[(first_unread_ + unread_count_++) % kMaxUnread] = std::move(frame);
}

/// Only an image shows that the camera works. A camera that can be opened but sends nothing is opened at growing
/// intervals.
void CameraDriver::begin_running() {
  news_.enter(Connection::running, {}, state_);
  state_.wants_port_reset.clear();
  ++state_.openings;
  back_off_.succeeded();
}

Clock::duration CameraDriver::patience() const {
  double seconds = settings_.silent_s;
  if (state_.description.rate_hz > 0.0) seconds = std::max(seconds, kSilentIntervals / state_.description.rate_hz);
  if (state_.connection != Connection::running) seconds = std::max(seconds, settings_.first_image_s);
  return clock_duration(seconds);
}

/// Damaged images do not count: a camera that sends only damaged images is as useless as a silent one.
void CameraDriver::watch_silence(Clock::time_point now) {
  if (now - last_image_ < patience()) return;
  ++state_.silences;
  state_.wants_port_reset = state_.description.usb_port;
  fail(Connection::silent, state_.description.device + ": no image for " + seconds_text(patience()) + " s", now);
}

void CameraDriver::fail(Connection into, const std::string& trouble, Clock::time_point now) {
  news_.enter(into, trouble, state_);
  stream_.reset();
  back_off_.failed(now);
}

bool CameraDriver::take(Frame& into) {
  if (unread_count_ == 0) return false;
  into = std::move(unread_[first_unread_]);
  unread_[first_unread_] = Frame{};
  first_unread_ = (first_unread_ + 1) % kMaxUnread;
  --unread_count_;
  return true;
}

/// Reports refused settings only if they differ from those of the previous stream.
void CameraDriver::tell_refusals() {
  const std::vector<std::string>& refused = state_.description.refused;
  if (refused == told_refusals_) return;
  told_refusals_ = refused;
  for (const std::string& sentence : refused) news_.tell(state_.description.device + ": " + sentence);
}

void ImageOrder::begin_stream() {
  device_sequence_.reset();
  corrupt_ = 0;
}

ImageOrder::Verdict ImageOrder::judge(std::uint64_t sequence, Stamp stamp, Clock::time_point now) {
  Verdict verdict;
  judge_sequence(sequence, verdict);
  judge_stamp(stamp, now, verdict);
  return verdict;
}

/// Dropped images are numbered as well, so that receivers see a gap in their place.
void ImageOrder::judge_sequence(std::uint64_t sequence, Verdict& verdict) {
  std::uint64_t step = any_ ? 2 : 0;  // 2 leaves a gap at the beginning of a new stream
  if (device_sequence_) {
    verdict.restarted = sequence <= *device_sequence_;
    step = verdict.restarted ? 1 : sequence - *device_sequence_;
    const std::uint64_t between = step - 1;
    verdict.missing = between - std::min(between, corrupt_);
  }
  device_sequence_ = sequence;
  corrupt_ = 0;
  any_ = true;
  sequence_ += step;
  verdict.sequence = sequence_;
}

void ImageOrder::judge_stamp(Stamp stamp, Clock::time_point now, Verdict& verdict) {
  const Stamp arrival = stamp_at(now);
  const bool early = stamp > arrival + kFuture;
  const bool late = stamp < arrival - kOldest || (newest_ && stamp <= *newest_);
  const bool give_up = late && dropped_in_a_row_ >= kMostDropped;
  verdict.replaced = early || give_up;
  verdict.stamp = verdict.replaced ? arrival : std::min(stamp, arrival);
  verdict.usable = (verdict.replaced || !late) && (!newest_ || verdict.stamp > *newest_);
  if (verdict.usable) newest_ = verdict.stamp;
  if (verdict.usable && !give_up) dropped_in_a_row_ = 0;
  if (!verdict.usable) dropped_in_a_row_ = std::min(dropped_in_a_row_ + 1, kMostDropped);
}

}  // namespace azimuth
