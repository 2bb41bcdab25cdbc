#include "drivers/lcm/lcm_receiver.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <netinet/in.h>
#include <optional>
#include <span>
#include <sys/socket.h>
#include <system_error>

#include "drivers/device/device_clock.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;

constexpr std::chrono::milliseconds kFirstBackOff = 50ms, kLongestBackOff = 1s;
constexpr auto kRejoin = 5s;
/// The requested size of the receive buffer. It is large because images arrive in bursts of datagrams.
constexpr int kKernelRoom_bytes = 8 << 20;

template <class T>
bool set_option(int socket, int level, int option, const T& value) {
  return ::setsockopt(socket, level, option, &value, sizeof value) == 0;
}

/// The value of a control message that belongs to a datagram.
template <class T>
std::optional<T> control_value(msghdr& message, int kind) {
  for (cmsghdr* control = CMSG_FIRSTHDR(&message); control; control = CMSG_NXTHDR(&message, control)) {
    if (control->cmsg_level != SOL_SOCKET || control->cmsg_type != kind) continue;
    T value{};
    std::memcpy(&value, CMSG_DATA(control), sizeof value);
    return value;
  }
  return std::nullopt;
}

}  // namespace

struct LcmReceiver::Buffer {
  std::array<std::byte, kMaxDatagram> datagram;
  alignas(cmsghdr) std::array<std::byte, 128> control;
};

LcmReceiver::LcmReceiver(const LcmAddress& address, Duration epoch_minus_monotonic)
    : address_(address),
      epoch_minus_monotonic_(epoch_minus_monotonic),
      buffer_(std::make_shared<Buffer>()),
      back_off_(kFirstBackOff, kLongestBackOff) {}

void LcmReceiver::turn(Clock::time_point now, LcmSink& sink) {
  if (now >= next_turn_) {
    socket_ = UniqueFd{};
    open(now);
  }
  for (int i = 0; i < kMaxDatagramsPerTurn && socket_ && receive(now, sink); ++i) next_turn_ = now + kRejoin;
}

/// Binds to the group instead of any address, so that the kernel delivers no datagrams of other groups on the same
/// port.
void LcmReceiver::open(Clock::time_point now) {
  socket_ = UniqueFd(::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (!socket_) return void(fail("socket", now));
  const int fd = socket_.get(), on = 1;
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_port = htons(address_.port);
  std::memcpy(&place.sin_addr, address_.group.data(), address_.group.size());
  ip_mreqn group{};
  group.imr_multiaddr = place.sin_addr;
  if (!set_option(fd, SOL_SOCKET, SO_REUSEADDR, on)) return void(fail("share the port", now));
  if (::bind(fd, reinterpret_cast<const sockaddr*>(&place), sizeof place) < 0) return void(fail("bind", now));
  if (!set_option(fd, IPPROTO_IP, IP_ADD_MEMBERSHIP, group)) return void(fail("join the group", now));
  // These options may fail: the kernel's times, its counts of losses, and a larger buffer.
  set_option(fd, SOL_SOCKET, SO_TIMESTAMPNS, on);
  set_option(fd, SOL_SOCKET, SO_RXQ_OVFL, on);
  set_option(fd, SOL_SOCKET, SO_RCVBUF, kKernelRoom_bytes);
  int room = 0;
  socklen_t size = sizeof room;
  ::getsockopt(fd, SOL_SOCKET, SO_RCVBUF, &room, &size);
  state_.kernel_room_bytes = static_cast<std::size_t>(std::max(0, room));
  state_.open = true;
  state_.trouble.clear();
  dropped_before_ = 0;
  back_off_.succeeded();
  next_turn_ = now + kRejoin;
}

bool LcmReceiver::fail(const char* what, Clock::time_point now) {
  state_.trouble = text(address_) + ": " + what + ": " + std::generic_category().message(errno);
  state_.open = false;
  socket_ = UniqueFd{};
  back_off_.failed(now);
  next_turn_ = back_off_.due();
  return false;
}

/// False: there are no more datagrams.
bool LcmReceiver::receive(Clock::time_point now, LcmSink& sink) {
  sockaddr_in from{};
  iovec room{.iov_base = buffer_->datagram.data(), .iov_len = buffer_->datagram.size()};
  msghdr message{};
  message.msg_name = &from;
  message.msg_namelen = sizeof from;
  message.msg_iov = &room;
  message.msg_iovlen = 1;
  message.msg_control = buffer_->control.data();
  message.msg_controllen = buffer_->control.size();
  const ssize_t size = ::recvmsg(socket_.get(), &message, 0);
  if (size < 0) return errno == EINTR || (errno != EAGAIN && errno != EWOULDBLOCK && fail("receive", now));
  ++state_.datagrams;
  if (const auto dropped = control_value<std::uint32_t>(message, SO_RXQ_OVFL)) {
    state_.kernel_dropped += *dropped - dropped_before_;
    dropped_before_ = *dropped;
  }
  const auto packet = decode_lcm_packet(std::span(buffer_->datagram).first(static_cast<std::size_t>(size)));
  if (!packet) {
    ++state_.malformed;
    return true;
  }
  const auto kernel_time = control_value<timespec>(message, SCM_TIMESTAMPNS);
  const auto arrived = kernel_time ? std::chrono::floor<Duration>(from_timespec(*kernel_time)) : now_on(CLOCK_REALTIME);
  const LcmPeer sender = (LcmPeer{ntohl(from.sin_addr.s_addr)} << 16U) | ntohs(from.sin_port);
  sink.accept(*packet, sender, receipt(arrived));
  return true;
}

Stamp LcmReceiver::now_stamp() const { return stamp_at(Clock::now(), epoch_minus_monotonic_); }

/// The datagram arrived at `wall` on the wall clock. If that clock has just been set, the current time is the best
/// estimate.
LcmReceipt LcmReceiver::receipt(Duration wall) {
  const Stamp before = now_stamp();
  const Stamp wall_now{now_on(CLOCK_REALTIME)};
  const Stamp now = now_stamp();
  wall_lead_.look(before, wall_now, now);
  const Stamp arrived = Stamp{wall} - wall_lead_.value();
  const bool plausible = arrived <= now + LcmWallLead::kMoved && arrived >= now - Duration(1s);
  return {plausible ? arrived : now, wall_lead_.value()};
}

}  // namespace azimuth
