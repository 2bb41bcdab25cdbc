#include "tests/equipment/usb_camera/usbip_link.hpp"

#include <algorithm>
#include <cerrno>
#include <sys/socket.h>

namespace azimuth::sim {
namespace {

constexpr std::uint32_t kMaxDataBytes = 1U << 20U;  // To the device; hosts send only a few bytes to a camera

bool receive_all(int fd, std::span<std::uint8_t> into) {
  while (!into.empty()) {
    const ssize_t count = ::recv(fd, into.data(), into.size(), MSG_WAITALL);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    into = into.subspan(static_cast<std::size_t>(count));
  }
  return true;
}

bool send_all(int fd, OctetSpan bytes, int flags) {
  while (!bytes.empty()) {
    const ssize_t count = ::send(fd, bytes.data(), bytes.size(), MSG_NOSIGNAL | flags);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(count));
  }
  return true;
}

}  // namespace

bool UsbipLink::serve() {
  UsbipHeader header{};
  if (!receive_all(socket_.get(), header)) return false;
  const std::optional<UsbipCommand> command = decode_usbip(header);
  if (!command) return false;
  return command->kind == UsbipCommand::Kind::unlink ? unlink(*command) : submit(*command);
}

bool UsbipLink::submit(const UsbipCommand& command) {
  received_.clear();
  if (!command.to_host) {
    if (command.bytes > kMaxDataBytes) return false;
    received_.resize(command.bytes);
    if (!receive_all(socket_.get(), received_)) return false;
  }
  if (command.endpoint == 0) return answer_control(command);
  if (!command.to_host) return reply(encode_submit_reply(command.sequence, -EPIPE, 0));
  waiting_.push_back({command.sequence, command.bytes});
  return pump();
}

bool UsbipLink::answer_control(const UsbipCommand& command) {
  const std::optional<ControlRequest> request = parse_setup(command.setup);
  const ControlAnswer answer = request ? camera_->control(*request, received_) : std::nullopt;
  if (!answer) return reply(encode_submit_reply(command.sequence, -EPIPE, 0));
  if (!command.to_host) {
    return reply(encode_submit_reply(command.sequence, 0, static_cast<std::uint32_t>(received_.size())));
  }
  const OctetSpan data = OctetSpan(*answer).first(std::min<std::size_t>(answer->size(), command.bytes));
  return reply(encode_submit_reply(command.sequence, 0, static_cast<std::uint32_t>(data.size())), data);
}

/// Cancels a transfer. A cancelled transfer gets no other reply.
bool UsbipLink::unlink(const UsbipCommand& command) {
  const auto victim = std::ranges::find(waiting_, command.victim, &WaitingTransfer::sequence);
  const bool found = victim != waiting_.end();
  if (found) waiting_.erase(victim);
  return reply(encode_unlink_reply(command.sequence, found ? -ECONNRESET : 0));
}

bool UsbipLink::pump() {
  while (!waiting_.empty()) {
    const std::optional<BulkAnswer> answer = camera_->next_transfer(waiting_.front().room);
    if (!answer) return true;
    const int status = answer->failed ? -EPROTO : 0;
    const auto bytes = static_cast<std::uint32_t>(answer->bytes.size());
    const std::uint32_t sequence = waiting_.front().sequence;
    waiting_.pop_front();
    if (!reply(encode_submit_reply(sequence, status, bytes), answer->bytes)) return false;
  }
  return true;
}

bool UsbipLink::reply(const UsbipHeader& header, OctetSpan data) {
  return send_all(socket_.get(), header, data.empty() ? 0 : MSG_MORE) && send_all(socket_.get(), data, 0);
}

}  // namespace azimuth::sim
