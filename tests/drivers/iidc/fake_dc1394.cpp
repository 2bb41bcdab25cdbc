#include "tests/drivers/iidc/fake_dc1394.hpp"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <memory>
#include <poll.h>
#include <unistd.h>

namespace azimuth::test {
namespace {

std::unique_ptr<FakeIidc> g_fake;

void (*g_handlers[3])(dc1394log_t, const char*, void*) = {};

std::uint64_t wall_us() {
  timespec now{};
  ::clock_gettime(CLOCK_REALTIME, &now);
  return static_cast<std::uint64_t>(now.tv_sec) * 1'000'000U + static_cast<std::uint64_t>(now.tv_nsec) / 1000U;
}

void log(dc1394log_t type, const char* message) {
  const auto handler = g_handlers[type - DC1394_LOG_MIN];
  if (handler != nullptr)
    handler(type, message, nullptr);
  else
    std::fprintf(stderr, "libdc1394: %s\n", message);
}

}  // namespace

FakeIidc& fake() { return *g_fake; }

void reset_fake() {
  g_fake = std::make_unique<FakeIidc>();
  g_fake->start_us = wall_us();
  offer_usual_modes();
}

void offer_usual_modes() {
  const std::vector<dc1394framerate_t> rates{DC1394_FRAMERATE_7_5, DC1394_FRAMERATE_15, DC1394_FRAMERATE_30};
  fake().modes = {{DC1394_VIDEO_MODE_320x240_YUV422, rates}, {DC1394_VIDEO_MODE_640x480_MONO8, rates}};
}

bool FakeIidc::fails(const char* call) {
  if (++calls != failing_call) return false;
  failed_call = call;
  if (!complaint.empty()) log(DC1394_LOG_ERROR, complaint.c_str());
  return true;
}

void FakeIidc::send(std::uint8_t number, std::int64_t age_us, bool corrupt) {
  send_stamped(number, start_us - static_cast<std::uint64_t>(age_us), corrupt);
}

void FakeIidc::send_stamped(std::uint8_t number, std::uint64_t wall, bool corrupt) {
  if (ring.empty() || !transmitting) return;
  Slot& slot = ring[next_filled];
  if (slot.state != Slot::State::queued) {
    ++lost;
    return;
  }
  std::memset(slot.memory.data(), number, slot.memory.size());
  slot.frame.timestamp = wall;
  slot.corrupt = corrupt;
  slot.state = Slot::State::filled;
  if (wrong_width != 0) slot.frame.size[0] = wrong_width;
  next_filled = (next_filled + 1) % ring.size();
  if (::write(frame_pipe[1], "+", 1) != 1) misuse.push_back(__LINE__);
}

void FakeIidc::reset_bus() {
  ++generation;
  if (::write(frame_pipe[1], "r", 1) != 1) misuse.push_back(__LINE__);
}

}  // namespace azimuth::test

using azimuth::test::fake;
using azimuth::test::FakeIidc;
using Slot = FakeIidc::Slot;

struct __dc1394_t {};

extern "C" {

// Library, bus, camera.

dc1394_t* dc1394_new() {
  if (fake().fails(__func__)) return nullptr;
  ++fake().contexts;
  return new __dc1394_t;
}
void dc1394_free(dc1394_t* context) {
  --fake().contexts;
  if (fake().cameras > 0) fake().misuse.push_back(__LINE__);
  delete context;
}
dc1394error_t dc1394_camera_enumerate(dc1394_t* /*context*/, dc1394camera_list_t** list) {
  FAKE_CALL();
  auto* const made = new dc1394camera_list_t{};
  made->num = static_cast<std::uint32_t>(fake().guids.size());
  made->ids = new dc1394camera_id_t[fake().guids.size() + 1];
  for (std::size_t i = 0; i < fake().guids.size(); ++i) made->ids[i] = {0, fake().guids[i]};
  *list = made;
  return DC1394_SUCCESS;
}
void dc1394_camera_free_list(dc1394camera_list_t* list) {
  delete[] list->ids;
  delete list;
}
dc1394camera_t* dc1394_camera_new_unit(dc1394_t* /*context*/, uint64_t guid, int /*unit*/) {
  FakeIidc& the = fake();
  if (the.fails(__func__) || std::ranges::find(the.guids, guid) == the.guids.end()) return nullptr;
  ++the.cameras;
  the.opened_guid = the.handle.guid = guid;
  the.handle.vendor = the.vendor.data();
  the.handle.model = the.model.data();
  the.handle.bmode_capable = the.bmode ? DC1394_TRUE : DC1394_FALSE;
  the.known_generation = the.generation;
  return &the.handle;
}
void dc1394_camera_free(dc1394camera_t* /*camera*/) {
  --fake().cameras;
  if (fake().captures > 0) fake().misuse.push_back(__LINE__);
}
dc1394error_t dc1394_camera_get_platform_string(dc1394camera_t* /*camera*/, const char** platform) {
  FAKE_CALL();
  *platform = fake().platform.c_str();
  return DC1394_SUCCESS;
}
dc1394error_t dc1394_camera_get_node(dc1394camera_t* /*camera*/, uint32_t* node, uint32_t* generation) {
  FAKE_CALL();
  *node = fake().node;
  *generation = fake().known_generation;
  return DC1394_SUCCESS;
}
dc1394error_t dc1394_log_register_handler(dc1394log_t type, void (*handler)(dc1394log_t, const char*, void*),
                                          void* /*user*/) {
  azimuth::test::g_handlers[type - DC1394_LOG_MIN] = handler;
  return DC1394_SUCCESS;
}
const char* dc1394_error_get_string(dc1394error_t error) {
  return error == DC1394_FUNCTION_NOT_SUPPORTED ? "not supported" : "generic failure";
}

// Video.

dc1394error_t dc1394_video_get_supported_modes(dc1394camera_t* /*camera*/, dc1394video_modes_t* modes) {
  FAKE_CALL();
  modes->num = 0;
  for (const auto& mode : fake().modes) modes->modes[modes->num++] = mode.first;
  return DC1394_SUCCESS;
}
dc1394error_t dc1394_video_get_supported_framerates(dc1394camera_t* /*camera*/, dc1394video_mode_t mode,
                                                    dc1394framerates_t* rates) {
  FAKE_CALL();
  rates->num = 0;
  for (const auto rate : fake().modes[mode]) rates->framerates[rates->num++] = rate;
  return DC1394_SUCCESS;
}
dc1394error_t dc1394_video_set_mode(dc1394camera_t* /*camera*/, dc1394video_mode_t mode) {
  FAKE_CALL();
  if (fake().transmitting || !fake().modes.contains(mode)) return DC1394_INVALID_VIDEO_MODE;
  fake().mode = mode;
  return DC1394_SUCCESS;
}
dc1394error_t dc1394_video_set_framerate(dc1394camera_t* /*camera*/, dc1394framerate_t rate) {
  FAKE_CALL();
  fake().rate = rate;
  return DC1394_SUCCESS;
}
dc1394error_t dc1394_video_get_framerate(dc1394camera_t* /*camera*/, dc1394framerate_t* rate) {
  FAKE_CALL();
  *rate = fake().rate;
  return DC1394_SUCCESS;
}
dc1394error_t dc1394_video_set_operation_mode(dc1394camera_t* /*camera*/, dc1394operation_mode_t mode) {
  FAKE_CALL();
  fake().operation = mode;
  return DC1394_SUCCESS;
}
dc1394error_t dc1394_video_set_iso_speed(dc1394camera_t* /*camera*/, dc1394speed_t speed) {
  FAKE_CALL();
  fake().speed = speed;
  return DC1394_SUCCESS;
}
dc1394error_t dc1394_video_get_transmission(dc1394camera_t* /*camera*/, dc1394switch_t* on) {
  FAKE_CALL();
  fake().known_generation = fake().generation;
  *on = fake().transmitting && fake().keeps_sending ? DC1394_ON : DC1394_OFF;
  return DC1394_SUCCESS;
}
dc1394error_t dc1394_video_set_transmission(dc1394camera_t* /*camera*/, dc1394switch_t on) {
  FAKE_CALL();
  fake().transmitting = on == DC1394_ON;
  return DC1394_SUCCESS;
}

// Capture.

dc1394error_t dc1394_capture_setup(dc1394camera_t* camera, uint32_t buffers, uint32_t /*flags*/) {
  FAKE_CALL();
  FakeIidc& the = fake();
  if (the.setup_error != DC1394_SUCCESS) return the.setup_error;
  if (the.captures > 0) return DC1394_CAPTURE_IS_RUNNING;
  const bool format7 = the.mode >= DC1394_VIDEO_MODE_FORMAT7_MIN;
  const bool yuv = the.mode == DC1394_VIDEO_MODE_320x240_YUV422;
  const uint32_t width = format7 ? the.format7.width : yuv ? 320 : 640;
  const uint32_t height = format7 ? the.format7.height : yuv ? 240 : 480;
  const uint32_t bytes = width * height * (yuv ? 2 : 1);
  the.ring = std::vector<Slot>(buffers);
  for (Slot& slot : the.ring) {
    slot.memory.resize(bytes);
    slot.frame.image = slot.memory.data();
    slot.frame.size[0] = width;
    slot.frame.size[1] = height;
    slot.frame.image_bytes = bytes;
    slot.frame.camera = camera;
  }
  the.next_filled = the.next_taken = the.next_given = 0;
  if (::pipe(the.frame_pipe) != 0) return DC1394_FAILURE;
  the.last_descriptor = the.frame_pipe[0];
  ++the.captures;
  return DC1394_SUCCESS;
}
dc1394error_t dc1394_capture_stop(dc1394camera_t* /*camera*/) {
  FakeIidc& the = fake();
  const bool fails = the.fails(__func__);
  if (the.captures != 1) return DC1394_CAPTURE_IS_NOT_SET;
  the.ring.clear();
  --the.captures;
  ::close(the.frame_pipe[1]);
  if (the.stop_error != DC1394_SUCCESS) return the.stop_error;
  ::close(the.frame_pipe[0]);
  return fails ? DC1394_FAILURE : DC1394_SUCCESS;
}
int dc1394_capture_get_fileno(dc1394camera_t* /*camera*/) { return fake().captures == 1 ? fake().frame_pipe[0] : -1; }

dc1394error_t dc1394_capture_dequeue(dc1394camera_t* /*camera*/, dc1394capture_policy_t policy,
                                     dc1394video_frame_t** frame) {
  *frame = nullptr;
  FAKE_CALL();
  FakeIidc& the = fake();
  if (the.captures != 1 || policy != DC1394_CAPTURE_POLICY_POLL) {
    the.misuse.push_back(__LINE__);
    return DC1394_CAPTURE_IS_NOT_SET;
  }
  if (the.dequeue_error != DC1394_SUCCESS) return the.dequeue_error;
  Slot& slot = the.ring[the.next_taken];
  if (slot.state == Slot::State::taken) the.misuse.push_back(__LINE__);  // the library would block here
  char event = 0;
  if (slot.state != Slot::State::filled) {
    pollfd waiting{the.frame_pipe[0], POLLIN, 0};
    if (::poll(&waiting, 1, 0) > 0 && ::read(the.frame_pipe[0], &event, 1) != 1) the.misuse.push_back(__LINE__);
    return DC1394_SUCCESS;
  }
  if (::read(the.frame_pipe[0], &event, 1) != 1) the.misuse.push_back(__LINE__);
  slot.state = Slot::State::taken;
  the.next_taken = (the.next_taken + 1) % the.ring.size();
  *frame = &slot.frame;
  return DC1394_SUCCESS;
}
dc1394error_t dc1394_capture_enqueue(dc1394camera_t* /*camera*/, dc1394video_frame_t* frame) {
  FAKE_CALL();
  FakeIidc& the = fake();
  Slot& slot = the.ring[the.next_given];
  if (&slot.frame != frame || slot.state != Slot::State::taken) the.misuse.push_back(__LINE__);
  if (the.enqueue_error != DC1394_SUCCESS) return the.enqueue_error;
  slot.state = Slot::State::queued;
  the.next_given = (the.next_given + 1) % the.ring.size();
  return DC1394_SUCCESS;
}
dc1394bool_t dc1394_capture_is_frame_corrupt(dc1394camera_t* /*camera*/, dc1394video_frame_t* frame) {
  return std::ranges::any_of(fake().ring, [&](const Slot& slot) { return &slot.frame == frame && slot.corrupt; })
             ? DC1394_TRUE
             : DC1394_FALSE;
}

}  // extern "C"
