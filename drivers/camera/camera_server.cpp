#include "drivers/camera/camera_server.hpp"

#include <algorithm>
#include <cerrno>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <sys/stat.h>

#include "base/file_result.hpp"
#include "drivers/camera/link_socket.hpp"

namespace azimuth {

using camera_link::FrameMemory;
using camera_link::FrameMessage;
using camera_link::Hello;
using camera_link::Packet;

namespace {

constexpr std::size_t kPage = 4096;
/// More messages than a correct client sends between two turns. It limits the work that a faulty client can cause.
constexpr int kMaxAnswersPerTurn = 2 * static_cast<int>(FramePool::kMaxSlots);

std::uint32_t whole_pages(std::size_t bytes) {
  return static_cast<std::uint32_t>(std::min((bytes + kPage - 1) / kPage * kPage, camera_link::kMaxSlotBytes + 1));
}

ino_t inode_of(const std::filesystem::path& path) {
  struct stat status {};
  return ::lstat(path.c_str(), &status) == 0 ? status.st_ino : 0;
}

}  // namespace

FileResult<CameraServer> CameraServer::listen(const std::filesystem::path& path, const Offer& offer) {
  const bool jpeg = offer.format.pixels == PixelFormat::mjpeg;
  const Hello hello{.format = offer.format,
                    .slot_bytes = whole_pages(jpeg ? offer.max_jpeg_bytes : offer.format.bytes()),
                    .slots = offer.slots};
  if (offer.slots == 0 || !is_valid(hello))
    return failure(FileError{path.string(), 0, "cannot serve frames of this format, size and number"});
  return start(path, hello);
}

FileResult<CameraServer> CameraServer::listen_for_bearings(const std::filesystem::path& path) {
  return start(path, Hello{});
}

FileResult<CameraServer> CameraServer::start(const std::filesystem::path& path, const Hello& hello) {
  int error = 0;
  FrameMemory memory = hello.slots > 0 ? FrameMemory::create(hello.memory_bytes(), error) : FrameMemory{};
  if (error != 0) return failure(system_error(path, "no memory for frames", error));
  CameraServer server(path, hello, std::move(memory));
  if ((error = server.open()) != 0) return failure(system_error(path, "cannot be listened at", error));
  return server;
}

CameraServer::CameraServer(std::filesystem::path path, const Hello& hello, FrameMemory memory)
    : path_(std::move(path)), hello_(hello), memory_(std::move(memory)) {
  message_.reserve(camera_link::kMaxMessageBytes);
}

CameraServer::CameraServer(CameraServer&&) noexcept = default;

CameraServer::~CameraServer() {
  // Another server may have taken over the path, or this object may have been moved from.
  if (listener_ && inode_of(path_) == socket_file_) ::unlink(path_.c_str());
}

int CameraServer::open() {
  int error = 0;
  events_ = UniqueFd(::epoll_create1(EPOLL_CLOEXEC));
  if (!events_) return errno;
  listener_ = camera_link::listen_at(path_, error);
  if (!listener_) return error;
  socket_file_ = inode_of(path_);
  return watch(listener_.get()) ? 0 : errno;
}

bool CameraServer::watch(int fd) const {
  epoll_event readable{.events = EPOLLIN, .data = {.fd = fd}};
  return ::epoll_ctl(events_.get(), EPOLL_CTL_ADD, fd, &readable) == 0;
}

void CameraServer::turn() {
  if (client_) read_client();
  if (!client_) accept_client();
}

void CameraServer::accept_client() {
  UniqueFd client(::accept4(listener_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
  if (!client) return;
  if (!camera_link::is_trusted_client(client.get(), path_)) {
    ++counts_.strangers;
    return;
  }
  encode(hello_, message_);
  if (camera_link::send_packet(client.get(), message_, memory_.descriptor()) != 0 || !watch(client.get())) return;
  // While this client is connected, connection attempts of others must not wake the event loop.
  ::epoll_ctl(events_.get(), EPOLL_CTL_DEL, listener_.get(), nullptr);
  client_ = std::move(client);
  ++counts_.clients;
}

void CameraServer::drop_client() {
  client_ = UniqueFd{};
  slots_.fill({});
  static_cast<void>(watch(listener_.get()));
}

void CameraServer::read_client() {
  std::array<std::byte, 64> room{};
  for (int packets = 0; client_ && packets < kMaxAnswersPerTurn; ++packets) {
    const Packet packet = camera_link::receive_packet(client_.get(), room);
    if (packet.outcome == Packet::Outcome::nothing_yet) return;
    if (packet.outcome == Packet::Outcome::end) return drop_client();
    take_back(packet.whole ? std::span(room).first(packet.bytes) : std::span(room).first(0));
  }
}

void CameraServer::take_back(std::span<const std::byte> message) {
  const auto release = camera_link::decode_release(message);
  Slot* const slot = release ? &slots_[release->slot] : nullptr;
  if (slot && slot->leased && slot->sequence == release->sequence) {
    slot->leased = false;
  } else {  // the client's bookkeeping is wrong, so its leases are unknown
    ++counts_.malformed;
    drop_client();
  }
}

std::span<std::byte> CameraServer::next_frame() {
  next_sequence_ = ++sequence_;
  const auto slots = std::span(slots_).first(hello_.slots);
  const auto free = std::ranges::find(slots, false, &Slot::leased);
  next_slot_ = client_ && free != slots.end() ? static_cast<unsigned>(free - slots.begin()) : kNoSlot;
  if (next_slot_ == kNoSlot) {
    ++counts_.frames_skipped;
    return {};
  }
  const std::size_t room = hello_.format.pixels == PixelFormat::mjpeg ? hello_.slot_bytes : hello_.format.bytes();
  return memory_.bytes().subspan(std::size_t{next_slot_} * hello_.slot_bytes, room);
}

void CameraServer::skip_frame() {
  ++sequence_;
  ++counts_.frames_skipped;
}

bool CameraServer::send_frame(Stamp stamp) { return send_jpeg(stamp, hello_.format.bytes()); }

bool CameraServer::send_jpeg(Stamp stamp, std::size_t bytes) {
  const unsigned slot = std::exchange(next_slot_, kNoSlot);
  if (slot == kNoSlot || bytes == 0 || bytes > hello_.slot_bytes) {
    ++counts_.frames_skipped;
    return false;
  }
  const auto length = static_cast<std::uint32_t>(bytes);
  encode(FrameMessage{.slot = slot, .sequence = next_sequence_, .stamp = stamp, .bytes = length}, message_);
  const bool sent = transmit();
  if (sent) slots_[slot] = {true, next_sequence_};
  ++(sent ? counts_.frames : counts_.frames_skipped);
  return sent;
}

bool CameraServer::send(const BearingSet& set) {
  const bool fits = set.bearings.size() <= camera_link::kMaxBearings;
  if (fits) camera_link::encode(set, message_);
  const bool sent = fits && transmit();
  ++(sent ? counts_.sets : counts_.sets_skipped);
  return sent;
}

bool CameraServer::transmit() {
  if (!client_) return false;
  const int error = camera_link::send_packet(client_.get(), message_);
  const bool passes = error == EAGAIN || error == EMSGSIZE || error == ENOBUFS || error == ENOMEM;
  if (error != 0 && !passes) drop_client();
  return error == 0;
}

}  // namespace azimuth
