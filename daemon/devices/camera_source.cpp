#include "daemon/devices/camera_source.hpp"

#include <fmt/format.h>
#include <iterator>
#include <pthread.h>
#include <utility>

#include "daemon/devices/status_words.hpp"

namespace azimuth {
namespace {

constexpr DeviceCondition kWithoutImages{Connection::silent, "no images"};

/// A wrapped stream. Its destructor hands the real stream to the opener's thread, which closes it.
class LentStream final : public ImageStream {
 public:
  LentStream(std::unique_ptr<ImageStream> stream, std::shared_ptr<BackgroundOpener::Desk> desk)
      : stream_(std::move(stream)), desk_(std::move(desk)) {}
  ~LentStream() override {
    const std::lock_guard lock(desk_->mutex);
    desk_->to_close.push_back(std::move(stream_));
    desk_->work.notify_one();
  }

  int descriptor() const override { return stream_->descriptor(); }
  short poll_events() const override { return stream_->poll_events(); }
  Read read(Frame& into) override { return stream_->read(into); }
  const CameraTrouble& trouble() const override { return stream_->trouble(); }
  const StreamDescription& description() const override { return stream_->description(); }

 private:
  std::unique_ptr<ImageStream> stream_;
  std::shared_ptr<BackgroundOpener::Desk> desk_;
};

}  // namespace

BackgroundOpener::BackgroundOpener(StreamOpener open) : open_(std::move(open)), thread_([this] { run(); }) {
  ::pthread_setname_np(thread_.native_handle(), "camera-opener");
}

BackgroundOpener::~BackgroundOpener() {
  const std::lock_guard lock(desk_->mutex);
  desk_->quit = true;
  desk_->work.notify_one();
}

OpenedStream BackgroundOpener::open() {
  const std::lock_guard lock(desk_->mutex);
  if (!std::exchange(desk_->opening, true)) {
    desk_->begun = false;
    desk_->work.notify_one();
  }
  if (!desk_->opened) return {};
  desk_->opening = false;
  OpenedStream opened = std::move(*desk_->opened);
  desk_->opened.reset();
  if (opened && *opened) opened = std::make_unique<LentStream>(*std::move(opened), desk_);
  return opened;
}

/// The mutex is released while the thread opens or closes a device.
void BackgroundOpener::run() {
  Desk& desk = *desk_;
  std::unique_lock lock(desk.mutex);
  while (true) {
    desk.work.wait(lock, [&] { return desk.quit || !desk.to_close.empty() || (desk.opening && !desk.begun); });
    if (!desk.to_close.empty()) {
      std::vector<std::unique_ptr<ImageStream>> closing = std::exchange(desk.to_close, {});
      lock.unlock();
      closing.clear();
      lock.lock();
      continue;
    }
    if (desk.quit) return;
    desk.begun = true;
    lock.unlock();
    OpenedStream opened = open_();
    lock.lock();
    desk.opened = std::move(opened);
  }
}

CameraSource::CameraSource(const CameraDriverSettings& settings, StreamOpener open, Duration to_stamp, UsbHelp usb)
    : to_stamp_(to_stamp),
      opener_(std::move(open)),
      driver_(settings, [this] { return opener_.open(); }),
      usb_(std::move(usb)) {}

void CameraSource::work(Clock::time_point now, SourceWires& wires) {
  if (usb_.turn()) driver_.wake(now);
  driver_.turn(now);
  help(now);
  pass_on(wires);
}

PolledSource::Polled CameraSource::polled() const {
  return {pollfd{.fd = driver_.descriptor(), .events = driver_.poll_events(), .revents = 0}, usb_.polled()};
}

void CameraSource::help(Clock::time_point now) {
  const CameraState& state = driver_.state();
  if (state.connection == Connection::running) usb_.works();
  if (usb_.take_end()) driver_.wake(now);
  if (!state.wants_port_reset.empty()) usb_.reset(state.wants_port_reset, now);
}

void CameraSource::pass_on(SourceWires& wires) {
  while (driver_.take(frame_)) {
    if (wires.frames) {
      frame_.stamp += to_stamp_;
      wires.frames->publish(frame_);
    }
    frame_ = Frame{};  // releases an unwanted frame, or the frame that publish() replaced
  }
}

void CameraSource::tell(EventRelay& relay, bool trouble, SourceWires& wires) {
  relay.pass_on(driver_, trouble, "camera: ", wires);
  relay.pass_on(usb_, "camera: ", wires);
}

void CameraSource::describe(DeviceStatus& status) const {
  const CameraState& state = driver_.state();
  const FrameFormat& format = state.description.format;
  put_state(state, status.text);
  if (state.connection == Connection::running)
    fmt::format_to(std::back_inserter(status.text), " ({}, {} {}x{})", state.description.device,
                   azimuth::name(format.pixels), format.width_px, format.height_px);
  append_losses({{state.missing, "missing"},
                 {state.corrupt, "corrupt"},
                 {state.stamps_replaced, "with a stamp replaced"},
                 {state.stamps_dropped, "dropped for their stamp"}},
                status.text);
  status.reconnects = state.reopenings();
  status.port_resets = usb_.resets();
  status.images_missing = state.missing;
  status.images_corrupt = state.corrupt;
}

SharedCameraSource::SharedCameraSource(std::filesystem::path socket, Duration epoch_minus_monotonic,
                                       Clock::duration silent_after)
    : socket_(socket.string()),
      epoch_minus_monotonic_(epoch_minus_monotonic),
      camera_(std::move(socket)),
      silent_after_(silent_after) {
  set_.bearings.reserve(kTypicalBearings);
}

void SharedCameraSource::work(Clock::time_point now, SourceWires& wires) {
  camera_.turn(now);
  const bool connected = camera_.state().connected;
  if (pass_on(wires) || connected != was_connected_) last_sample_ = now;
  was_connected_ = connected;
  condition_ = judge(wires.frames != nullptr, now);
}

/// False: no wanted sample was received.
bool SharedCameraSource::pass_on(SourceWires& wires) {
  bool any = false;
  while (camera_.take(set_)) {
    if (!wires.bearings) continue;
    any = true;
    set_.stamp += epoch_minus_monotonic_;
    wires.bearings->push(set_);
  }
  while (camera_.take(frame_)) {
    if (wires.frames) {
      any = true;
      frame_.stamp += epoch_minus_monotonic_;
      wires.frames->publish(frame_);
    }
    frame_ = Frame{};  // releases an unwanted frame, or the frame that publish() replaced
  }
  return any;
}

std::optional<DeviceCondition> SharedCameraSource::judge(bool wants_frames, Clock::time_point now) const {
  const SharedCameraState& state = camera_.state();
  // A free server sends its greeting at once, but possibly in a later turn than the connection. Until then the
  // condition stays as it was.
  if (state.waiting_since && now - *state.waiting_since <= silent_after_) return condition_;
  if (!state.connected) return kAway;
  if (wants_frames && state.format.width_px == 0) return kWithoutImages;
  return now - last_sample_ > silent_after_ ? kSilent : kRunning;
}

void SharedCameraSource::describe(DeviceStatus& status) const {
  const SharedCameraState& state = camera_.state();
  const FrameFormat& format = state.format;
  status.text.clear();
  auto out = std::back_inserter(status.text);
  if (condition_ == kAway) {
    fmt::format_to(out, "{} {}", socket_, state.error);
  } else if (condition_ == kWithoutImages) {
    fmt::format_to(out, "{} sends no images", socket_);
  } else if (condition_ == kSilent) {
    fmt::format_to(out, "{} has sent nothing for {} s", socket_, std::chrono::duration<double>(silent_after_).count());
  } else if (format.width_px == 0) {
    fmt::format_to(out, "running ({})", socket_);
  } else {
    fmt::format_to(out, "running ({}, {} {}x{})", socket_, azimuth::name(format.pixels), format.width_px,
                   format.height_px);
  }
  append_losses({{state.frames_missing + state.sets_missing, "missing"},
                 {state.frames_replaced + state.sets_replaced, "not taken in time"},
                 {state.malformed, "malformed"}},
                status.text);
  status.reconnects = state.connections > 0 ? state.connections - 1 : 0;
  status.images_missing = state.frames_missing;
}

}  // namespace azimuth
