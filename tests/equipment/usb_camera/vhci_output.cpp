#include "tests/equipment/usb_camera/vhci_output.hpp"

#include <array>
#include <cerrno>
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <system_error>
#include <unistd.h>

#include "tests/equipment/usb_camera/log_line.hpp"

namespace azimuth::sim {
namespace {

using std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr int kHighSpeed = 3;  // The kernel's number for this USB speed
constexpr auto kPatience = 2000ms;
constexpr int kPause_ms = 20;

std::string because(std::string_view what, int error) {
  return fmt::format("{}: {}", what, std::generic_category().message(error));
}

int write_once(const std::string& path, const std::string& text) {
  const UniqueFd file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
  if (!file) return errno;
  return ::write(file.get(), text.data(), text.size()) < 0 ? errno : 0;
}

}  // namespace

std::optional<std::string> VhciOutput::tell_kernel(std::string_view file, const std::string& text) const {
  const std::string path = controller_ / file;
  const auto limit = steady_clock::now() + kPatience;
  int error = write_once(path, text);
  while ((error == EBUSY || error == EINVAL || error == EAGAIN) && steady_clock::now() < limit) {
    ::poll(nullptr, 0, kPause_ms);
    error = write_once(path, text);
  }
  return error == 0 ? std::nullopt : std::optional(because(path, error));
}

std::optional<std::string> VhciOutput::plug() {
  if (link_) return "is plugged in already";
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) return because("socketpair", errno);
  UniqueFd ours(ends[0]);
  const UniqueFd kernels(ends[1]);  // The kernel takes a reference of its own
  const int device = 0x10000 | (port_ + 1);
  camera_->power_up();
  if (auto error = tell_kernel("attach", fmt::format("{} {} {} {}", port_, kernels.get(), device, kHighSpeed))) {
    return error;
  }
  link_ = std::make_unique<UsbipLink>(std::move(ours), *camera_);
  return std::nullopt;
}

std::optional<std::string> VhciOutput::unplug() {
  if (!link_) return "is not plugged in";
  auto error = tell_kernel("detach", std::to_string(port_));
  drain(kPatience);
  link_.reset();
  return error;
}

/// Reads and discards data until the kernel closes its end. Nothing is answered, since the cable is unplugged.
void VhciOutput::drain(std::chrono::milliseconds limit) {
  const auto until = steady_clock::now() + limit;
  std::array<char, 4096> ignored{};
  while (steady_clock::now() < until) {
    pollfd watched{link_->descriptor(), POLLIN, 0};
    if (::poll(&watched, 1, kPause_ms) <= 0) continue;
    if (::recv(link_->descriptor(), ignored.data(), ignored.size(), MSG_DONTWAIT) <= 0 && errno != EAGAIN) return;
  }
  log_line("the kernel did not close its end");
}

void VhciOutput::turn() {
  if (!link_ || link_->serve()) return;
  log_line("the kernel closed its end");
  link_.reset();
}

void VhciOutput::send(OctetSpan image, ImageFlaw flaw) {
  camera_->begin_image(image, flaw);
  if (link_->pump()) return;
  log_line("the kernel closed its end while an image was sent");
  link_.reset();
}

bool VhciOutput::hang() {
  camera_->hang();
  return true;
}

std::string VhciOutput::status() const {
  const WireShape shape = camera_->shape();
  return fmt::format("plugged={:d} streaming={:d} hung={:d} resets={} waiting={} size={}x{} rate_hz={:g}", plugged(),
                     camera_->streaming(), camera_->hung(), camera_->resets(), link_ ? link_->waiting() : 0,
                     shape.width_px, shape.height_px, camera_->rate_hz());
}

}  // namespace azimuth::sim
