#include "daemon/devices/background_opener.hpp"

#include <pthread.h>
#include <utility>

namespace azimuth {
namespace {

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

}  // namespace azimuth
