#include "drivers/camera/shared_camera.hpp"

#include <algorithm>
#include <cerrno>
#include <sys/epoll.h>
#include <system_error>

#include "drivers/camera/link_socket.hpp"

namespace azimuth {

using camera_link::FrameMessage;
using camera_link::MappedFrames;
using camera_link::MessageKind;
using camera_link::Packet;

namespace {

constexpr std::chrono::milliseconds kFirstWait{50}, kLongestWait{1000};
/// Limits the packets of one turn, so that a server that floods does not keep the thread from its other work.
constexpr int kMaxPacketsPerTurn = 64;

std::string because(std::string_view what, int error) {
  return std::string(what) + ": " + std::generic_category().message(error);
}

}  // namespace

template <class T, std::size_t Places>
T& SharedCamera::Unread<T, Places>::claim(std::uint64_t& replaced) {
  if (count == Places) {
    first = (first + 1) % Places;
    --count;
    ++replaced;
  }
  return items[(first + count++) % Places];
}

template <class T, std::size_t Places>
bool SharedCamera::Unread<T, Places>::pop(T& into) {
  if (count == 0) return false;
  std::swap(items[first], into);
  first = (first + 1) % Places;
  --count;
  return true;
}

std::uint64_t SharedCamera::Gaps::missing_before(std::uint64_t sequence) {
  const std::optional<std::uint64_t> before = std::exchange(last, sequence);
  return before && sequence > *before ? sequence - *before - 1 : 0;
}

SharedCamera::SharedCamera(std::filesystem::path path)
    : path_(std::move(path)), events_(::epoll_create1(EPOLL_CLOEXEC)), back_off_(kFirstWait, kLongestWait) {
  if (!events_) throw std::system_error(errno, std::generic_category(), "epoll_create1");
  received_.resize(camera_link::kMaxMessageBytes);
  decoded_.bearings.reserve(kTypicalBearings);
  for (BearingSet& set : unread_sets_.items) set.bearings.reserve(kTypicalBearings);
}

bool SharedCamera::watch(int fd) const {
  epoll_event readable{.events = EPOLLIN, .data = {.fd = fd}};
  return ::epoll_ctl(events_.get(), EPOLL_CTL_ADD, fd, &readable) == 0;
}

void SharedCamera::turn(Clock::time_point now) {
  if (!socket_ && back_off_.is_due(now)) connect(now);
  if (socket_) return_leases();
  if (socket_) receive(now);
}

void SharedCamera::connect(Clock::time_point now) {
  int error = 0;
  uid_t uid = 0;
  socket_ = camera_link::connect_to(path_, error);
  if (!socket_) {
    state_.error = because("cannot be connected to", error);
    back_off_.failed(now);
  } else if (!camera_link::is_trusted_server(socket_.get(), path_, uid)) {
    disconnect(now, "belongs to user " + std::to_string(uid) +
                        " and lies where anybody may put one; let its folder be one that is not writable by all");
  } else if (!watch(socket_.get())) {
    disconnect(now, because("cannot be watched", errno));
  } else {
    state_.waiting_since = now;
    state_.error = "waits for its turn: it serves another program";
  }
}

void SharedCamera::disconnect(Clock::time_point now, std::string_view why) {
  state_.connected = false;
  state_.waiting_since.reset();
  state_.error = why;
  // Leases may keep these frames and their bell alive, so the bell is removed from the events.
  if (frames_) ::epoll_ctl(events_.get(), EPOLL_CTL_DEL, frames_->descriptor(), nullptr);
  frames_.reset();
  socket_ = UniqueFd{};
  leased_ = unreturned_ = 0;
  back_off_.failed(now);
}

/// A release that the full socket refuses is sent again in the next turn.
void SharedCamera::return_leases() {
  if (frames_) unreturned_ |= frames_->take_returned() & leased_;
  for (std::uint32_t slot = 0; slot < FramePool::kMaxSlots && unreturned_ != 0; ++slot) {
    if ((unreturned_ >> slot & 1U) == 0) continue;
    encode(camera_link::Release{.slot = slot, .sequence = lease_sequence_[slot]}, sent_);
    if (camera_link::send_packet(socket_.get(), sent_) != 0) return;  // if the server is gone, receive() will notice
    leased_ &= ~(1U << slot);
    unreturned_ &= ~(1U << slot);
  }
}

void SharedCamera::receive(Clock::time_point now) {
  for (int packets = 0; packets < kMaxPacketsPerTurn; ++packets) {
    const Packet packet = camera_link::receive_packet(socket_.get(), received_);
    if (packet.outcome == Packet::Outcome::nothing_yet) return;
    if (packet.outcome == Packet::Outcome::end)
      return disconnect(now, packet.error != 0 ? because("was lost", packet.error) : "was closed by the other side");
    const auto message = std::span<const std::byte>(received_).first(packet.whole ? packet.bytes : 0);
    if (state_.connected) {
      accept(message);
    } else if (!accept_hello(message, packet.descriptor)) {
      ++state_.malformed;
      return disconnect(now, "is not a camera of ours, or of another version");
    }
  }
}

bool SharedCamera::accept_hello(std::span<const std::byte> message, const UniqueFd& memory) {
  const std::optional<camera_link::Hello> hello = camera_link::decode_hello(message);
  if (!hello) return false;
  int error = 0;
  std::shared_ptr<MappedFrames> frames = hello->slots > 0 ? MappedFrames::open(memory, *hello, error) : nullptr;
  if (error != 0 || (frames && !watch(frames->descriptor()))) return false;
  hello_ = *hello;
  frames_ = std::move(frames);
  frame_gaps_ = set_gaps_ = {};
  back_off_.succeeded();
  state_.connected = true;
  state_.waiting_since.reset();
  state_.format = hello->format;
  state_.error.clear();
  ++state_.connections;
  return true;
}

void SharedCamera::accept(std::span<const std::byte> message) {
  const std::optional<MessageKind> kind = camera_link::kind_of(message);
  const bool good = kind == MessageKind::frame      ? accept_frame(message)
                    : kind == MessageKind::bearings ? accept_bearings(message)
                                                    : false;
  if (!good) ++state_.malformed;
}

bool SharedCamera::accept_frame(std::span<const std::byte> message) {
  const std::optional<FrameMessage> frame = camera_link::decode_frame(message, hello_);
  if (!frame || (leased_ >> frame->slot & 1U) != 0) return false;
  leased_ |= 1U << frame->slot;
  lease_sequence_[frame->slot] = frame->sequence;
  Frame leased(frames_, frame->slot, hello_.format, frames_->slot(frame->slot, frame->bytes));
  leased.stamp = frame->stamp;
  leased.sequence = frame->sequence;
  unread_frames_.claim(state_.frames_replaced) = std::move(leased);
  ++state_.frames;
  state_.frames_missing += frame_gaps_.missing_before(frame->sequence);
  return true;
}

bool SharedCamera::accept_bearings(std::span<const std::byte> message) {
  if (!camera_link::decode_bearings(message, decoded_)) return false;
  ++state_.sets;
  state_.sets_missing += set_gaps_.missing_before(decoded_.sequence);
  std::swap(unread_sets_.claim(state_.sets_replaced), decoded_);
  return true;
}

bool SharedCamera::take(BearingSet& into) { return unread_sets_.pop(into); }

bool SharedCamera::take(Frame& into) {
  Frame taken;
  if (!unread_frames_.pop(taken)) return false;
  into = std::move(taken);
  return true;
}

}  // namespace azimuth
