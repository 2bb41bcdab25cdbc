#include "sim/azimuth_sim/can_base.hpp"

#include <array>
#include <cerrno>
#include <cmath>
#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/socket.h>
#include <system_error>
#include <unistd.h>

namespace azimuth::sim {
namespace {

constexpr std::uint32_t kWheels = 0x181, kPower = 0x182;
constexpr double kTicksPerM = 20000.0;
constexpr std::uint64_t kPowerEvery = 25;  // In cycles
constexpr unsigned kEmergencyStop = 1U, kBumper = 2U;

CanFrame frame_of(std::uint32_t id, std::uint8_t size) {
  CanFrame frame;
  frame.id.number = id;
  frame.size = size;
  return frame;
}

std::uint8_t byte_of(std::int64_t number, int index) { return static_cast<std::uint8_t>(number >> (8 * index)); }

/// Writes 24 bits, the most significant byte first.
void put_ticks(double way_m, std::size_t at, CanFrame& frame) {
  const auto ticks = static_cast<std::int64_t>(std::floor(way_m * kTicksPerM));
  for (int i = 0; i < 3; ++i) frame.data.at(at + static_cast<std::size_t>(i)) = byte_of(ticks, 2 - i);
}

constexpr auto kRetry = std::chrono::milliseconds(100);

FileError error(const std::string& interface, int error_number) {
  return {interface, 0, std::generic_category().message(error_number)};
}

}  // namespace

void CanBase::report(const CanBaseReport& report, std::vector<CanFrame>& frames) {
  CanFrame wheels = frame_of(kWheels, 8);
  put_ticks(report.rolled.left_m - left_zero_m_, 0, wheels);
  put_ticks(report.rolled.right_m - right_zero_m_, 3, wheels);
  wheels.data[6] =
      static_cast<std::uint8_t>((report.emergency_stop ? kEmergencyStop : 0U) | (report.bumper ? kBumper : 0U));
  wheels.data[7] = static_cast<std::uint8_t>(cycles_);
  frames.push_back(wheels);
  if (cycles_++ % kPowerEvery != 0) return;
  CanFrame power = frame_of(kPower, 2);
  const std::int64_t centivolts = std::llround(100.0 * report.battery_v);
  power.data[0] = byte_of(centivolts, 0);
  power.data[1] = byte_of(centivolts, 1);
  frames.push_back(power);
}

void CanBase::restart(const WheelMotion& rolled) {
  left_zero_m_ = rolled.left_m;
  right_zero_m_ = rolled.right_m;
}

std::string can_base_help() {
  return "Frames of --can, as in config/simulated-can.dbc:\n"
         "  0x181  8 bytes, 50 times a second\n"
         "         bytes 0 to 2: ticks of the left wheel, signed, most significant byte first, 20000 a metre\n"
         "         bytes 3 to 5: ticks of the right wheel, likewise; both wrap after two metres, and then every 839 m\n"
         "         byte 6: bit 0 emergency stop, bit 1 bumper, bit 2 charging (never set)\n"
         "         byte 7: counts the frames\n"
         "  0x182  2 bytes, twice a second: battery in 0.01 V, least significant byte first\n"
         "The wheels are 2000/5.6 mm apart with the usual subclass. The faults reboot, silence, unplug, bumpers and "
         "estop "
         "are those of this base, too.\n";
}

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
