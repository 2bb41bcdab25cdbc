#include "drivers/can/can_socket.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/ioctl.h>
#include <system_error>
#include <utility>

namespace azimuth {
namespace {

using namespace std::chrono_literals;

constexpr auto kStep = 100us;  // a change larger than this is a step, not a slow correction of the clock
constexpr auto kSlack = 2ms;   // the two clocks are not read at the same instant

constexpr int kReceiveBuffer_bytes = 1 << 20;
constexpr can_err_mask_t kErrors = CAN_ERR_TX_TIMEOUT | CAN_ERR_CRTL | CAN_ERR_ACK | CAN_ERR_BUSOFF | CAN_ERR_RESTARTED;

template <class Value>
bool set(const UniqueFd& fd, int level, int option, const Value& value) {
  return ::setsockopt(fd.get(), level, option, &value, sizeof value) == 0;
}

/// 0: there is no interface of that name.
int index_of(int fd, const std::string& interface) {
  ifreq request{};
  if (interface.empty() || interface.size() >= sizeof request.ifr_name) return 0;
  std::ranges::copy(interface, std::begin(request.ifr_name));
  return ::ioctl(fd, SIOCGIFINDEX, &request) < 0 ? 0 : request.ifr_ifindex;
}

/// Enlarges the receive buffer. Returns a note if the kernel, whose limit is a system setting, grants less.
std::string grow_buffer(const UniqueFd& fd) {
  set(fd, SOL_SOCKET, SO_RCVBUF, kReceiveBuffer_bytes);
  int granted = 0;
  socklen_t size = sizeof granted;
  ::getsockopt(fd.get(), SOL_SOCKET, SO_RCVBUF, &granted, &size);
  granted /= 2;  // the kernel doubles the requested size to have room for its own structures
  if (granted >= kReceiveBuffer_bytes) return "";
  return fmt::format("receive buffer of {} kB instead of {} kB (net.core.rmem_max)", granted / 1024,
                     kReceiveBuffer_bytes / 1024);
}

std::optional<int> apply_filters(const UniqueFd& fd, std::span<const CanId> ids) {
  const std::vector<can_filter> filters = can_filters(ids);
  const auto size = static_cast<socklen_t>(filters.size() * sizeof(can_filter));
  if (::setsockopt(fd.get(), SOL_CAN_RAW, CAN_RAW_FILTER, filters.data(), size) < 0) return errno;
  if (!set(fd, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, kErrors)) return errno;
  return std::nullopt;
}

}  // namespace

void WallClockStamps::look(Wall wall_now, DeviceClock::time_point now) {
  const std::chrono::nanoseconds difference = now.time_since_epoch() - wall_now;
  const bool first = now_ == DeviceClock::time_point{};
  if (first || difference - monotonic_minus_wall_ > kStep || monotonic_minus_wall_ - difference > kStep)
    before_ = first ? difference : monotonic_minus_wall_;
  monotonic_minus_wall_ = difference;
  now_ = now;
}

bool WallClockStamps::can_be(DeviceClock::time_point at) const {
  return at >= empty_at_ - kSlack && at <= now_ + kSlack;
}

DeviceClock::time_point WallClockStamps::monotonic(Wall stamp) {
  const DeviceClock::time_point at(stamp + monotonic_minus_wall_), at_before(stamp + before_);
  if (can_be(at)) return std::min(at, now_);
  if (can_be(at_before)) return std::min(at_before, now_);
  ++replaced_;
  return now_;
}

std::string CanTrouble::text() const {
  const std::string begin = interface + ": " + what;
  if (error_number == EAFNOSUPPORT)
    return begin + ": the kernel has no CAN, or the service may not use it (the drop-in can.conf allows it)";
  return error_number == 0 ? begin : begin + ": " + std::generic_category().message(error_number);
}

std::vector<can_filter> can_filters(std::span<const CanId> ids) {
  std::vector<can_filter> filters;
  for (const CanId& id : ids) {
    const canid_t number_mask = id.extended ? CAN_EFF_MASK : CAN_SFF_MASK;
    filters.push_back({.can_id = id.number | (id.extended ? CAN_EFF_FLAG : 0U),
                       .can_mask = number_mask | CAN_EFF_FLAG | CAN_RTR_FLAG});
  }
  return filters;
}

CanSocket::CanSocket(std::string interface, UniqueFd fd, int index)
    : interface_(std::move(interface)), fd_(std::move(fd)), index_(index) {
  const int on = 1;
  set(fd_, SOL_SOCKET, SO_TIMESTAMPNS, on);  // without it, frames are stamped when they are read
  set(fd_, SOL_SOCKET, SO_RXQ_OVFL, on);
  note_ = grow_buffer(fd_);
  look_at_clocks();
}

OpenedCanLink CanSocket::open(const std::string& interface, std::span<const CanId> ids) {
  UniqueFd fd(::socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW));
  if (!fd) return tl::unexpected(CanTrouble{interface, "CAN socket", errno});
  const int index = index_of(fd.get(), interface);
  if (index == 0) return tl::unexpected(CanTrouble{interface, "no such interface", 0});
  if (const auto error_number = apply_filters(fd, ids))
    return tl::unexpected(CanTrouble{interface, "CAN filters", *error_number});
  const int on = 1;
  set(fd, SOL_CAN_RAW, CAN_RAW_FD_FRAMES, on);  // refused by kernels without CAN FD, which have only classic frames
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = index;
  auto link = std::make_unique<CanSocket>(interface, std::move(fd), index);
  if (::bind(link->descriptor(), reinterpret_cast<const sockaddr*>(&address), sizeof address) < 0)
    return tl::unexpected(CanTrouble{interface, "bind", errno});
  return link;
}

bool CanSocket::is_present() const { return index_of(fd_.get(), interface_) == index_; }

void CanSocket::look_at_clocks() {
  const auto wall = std::chrono::system_clock::now().time_since_epoch();
  now_ = DeviceClock::now();
  stamps_.look(wall, now_);
}

/// Prepares the buffers again, because the kernel has overwritten the lengths.
void CanSocket::prepare() {
  for (std::size_t i = 0; i < kBatch; ++i) {
    Slot& slot = slots_.at(i);
    slot.place = {slot.datagram.data(), slot.datagram.size()};
    messages_.at(i) = {};
    messages_.at(i).msg_hdr.msg_iov = &slot.place;
    messages_.at(i).msg_hdr.msg_iovlen = 1;
    messages_.at(i).msg_hdr.msg_control = slot.control.data();
    messages_.at(i).msg_hdr.msg_controllen = slot.control.size();
  }
}

CanLink::Received CanSocket::receive(std::span<CanReception> into) {
  Received received;
  const auto began = DeviceClock::now();
  for (bool empty = false; !empty && received.count < into.size();) {
    const std::size_t room = std::min(kBatch, into.size() - received.count);
    prepare();
    const int count = ::recvmmsg(fd_.get(), messages_.data(), static_cast<unsigned>(room), MSG_DONTWAIT, nullptr);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0 && errno != EAGAIN && errno != EWOULDBLOCK) {
      Received failed = trouble(errno);
      failed.count = received.count;
      return failed;
    }
    look_at_clocks();
    empty = count < static_cast<int>(room);
    for (int i = 0; i < count; ++i) {
      const auto slot = static_cast<std::size_t>(i);
      if (const auto frame = reception(messages_.at(slot), slots_.at(slot))) {
        into[received.count++] = *frame;
      } else {
        ++malformed_;
      }
    }
    if (empty) stamps_.note_empty(began);
  }
  return received;
}

CanLink::Received CanSocket::trouble(int error_number) const {
  if (error_number == ENETDOWN) return {0, true, {}};
  return {0, false, CanTrouble{interface_, "read", error_number}};
}

std::optional<CanReception> CanSocket::reception(const mmsghdr& message, const Slot& slot) {
  const DeviceClock::time_point at = read_control(message.msg_hdr);
  if ((message.msg_hdr.msg_flags & MSG_TRUNC) != 0) return std::nullopt;
  const auto frame = decode_can_frame(std::span(slot.datagram).first(message.msg_len));
  return frame ? std::optional(CanReception{*frame, at}) : std::nullopt;
}

DeviceClock::time_point CanSocket::read_control(const msghdr& header) {
  DeviceClock::time_point at = now_;
  msghdr walked = header;  // CMSG_NXTHDR takes no const
  for (cmsghdr* part = CMSG_FIRSTHDR(&walked); part != nullptr; part = CMSG_NXTHDR(&walked, part)) {
    if (part->cmsg_level != SOL_SOCKET) continue;
    if (part->cmsg_type == SO_TIMESTAMPNS && part->cmsg_len >= CMSG_LEN(sizeof(timespec))) {
      timespec stamp{};
      std::memcpy(&stamp, CMSG_DATA(part), sizeof stamp);
      at = stamps_.monotonic(from_timespec(stamp));
    }
    if (part->cmsg_type == SO_RXQ_OVFL && part->cmsg_len >= CMSG_LEN(sizeof(std::uint32_t))) {
      std::uint32_t drops = 0;  // drops of the socket so far, modulo 2^32
      std::memcpy(&drops, CMSG_DATA(part), sizeof drops);
      dropped_ += static_cast<std::uint32_t>(drops - std::exchange(last_drops_, drops));
    }
  }
  return at;
}

}  // namespace azimuth
