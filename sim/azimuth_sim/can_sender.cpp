#include "sim/azimuth_sim/can_sender.hpp"

#include <array>
#include <cerrno>
#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/socket.h>
#include <system_error>
#include <unistd.h>

namespace azimuth::sim {
namespace {

constexpr auto kRetry = std::chrono::milliseconds(100);

FileError error(const std::string& interface, int error_number) {
  return {interface, 0, std::generic_category().message(error_number)};
}

}  // namespace

FileResult<void> CanSender::open() {
  retry_at_ = std::chrono::steady_clock::now() + kRetry;
  UniqueFd fd(::socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW));
  if (!fd) return failure(error(interface_, errno));
  ::setsockopt(fd.get(), SOL_CAN_RAW, CAN_RAW_FILTER, nullptr, 0);  // The socket only sends
  const unsigned index = ::if_nametoindex(interface_.c_str());
  if (index == 0) return failure(error(interface_, errno));
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = static_cast<int>(index);
  if (::bind(fd.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) < 0)
    return failure(error(interface_, errno));
  fd_ = std::move(fd);
  return {};
}

void CanSender::send(std::span<const CanFrame> frames) {
  if (!fd_ && !frames.empty() && std::chrono::steady_clock::now() >= retry_at_) open();
  for (const CanFrame& frame : frames) lost_ += send_one(frame) ? 0 : 1;
}

bool CanSender::send_one(const CanFrame& frame) {
  if (!fd_) return false;
  std::array<std::uint8_t, kMostCanSocketBytes> datagram{};
  const std::size_t size = encode_can_frame(frame, datagram);
  if (::write(fd_.get(), datagram.data(), size) == static_cast<ssize_t>(size)) return true;
  const bool stays = errno == EAGAIN || errno == EINTR || errno == ENOBUFS || errno == ENETDOWN;
  if (!stays) fd_ = UniqueFd();
  return false;
}

}  // namespace azimuth::sim
