#pragma once
// A simulated camera behind the system calls, with scripted failures. Its device nodes are in a temporary folder.

#include <cstdint>
#include <deque>
#include <functional>
#include <linux/videodev2.h>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/unique_fd.hpp"
#include "drivers/v4l2/v4l2_calls.hpp"
#include "tests/support/temporary_folder.hpp"

namespace azimuth::test {

struct FakeControl {
  int minimum = 0, maximum = 255, value = 0;
  std::vector<int> menu{};  // valid items; empty: not a menu
  bool stubborn = false;    // accepts a value, but keeps its own
};

struct FakeV4l2Format {
  std::uint32_t code;
  int bytes_per_pixel;  // 0: compressed
  double fastest_hz = 30.0;
  std::vector<std::pair<int, int>> sizes{{640, 480}, {320, 240}};
};

/// Content and metadata of a filled buffer.
struct FakeFill {
  std::uint32_t sequence = 0;
  std::int64_t stamp_us = 0;
  std::uint32_t flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
  std::optional<std::uint32_t> bytesused{};  // default: a whole image
  std::optional<std::uint32_t> index{};      // default: the buffer that has waited longest
  std::uint32_t data_offset = 0;             // for multi-planar formats
  int value = 0;                             // value of every byte
};

class FakeV4l2 final : public v4l2::Calls {
 public:
  FakeV4l2();

  // Properties.
  std::string card = "Fake Camera";
  std::uint32_t capabilities = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
  std::vector<FakeV4l2Format> formats{{V4L2_PIX_FMT_YUYV, 2}, {V4L2_PIX_FMT_MJPEG, 0}};
  std::map<std::uint32_t, FakeControl> controls;
  std::uint32_t padding_bytes = 0;  // per row
  std::uint32_t most_buffers = 32, least_buffers = 0;
  std::uint32_t buffer_bytes = 0;  // 0: as large as the image requires
  bool has_rates = true;
  std::uint32_t field = V4L2_FIELD_NONE;
  std::uint32_t stamp_flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;

  // Failures.
  std::map<unsigned long, int> failing;  // errno by request
  int fail_after = -1;                   // after this number of successful calls every call fails with `failure`
  int failure = 5;
  short poll_events = 0;
  int open_error = 0, map_error = 0;
  std::chrono::steady_clock::time_point clock{std::chrono::seconds(1000)};

  /// Adds a node and its sysfs entries; empty `port`: not a USB device.
  void add_node(const std::string& node, const std::string& port, const std::string& vendor = "1d6b",
                const std::string& product = "0105", const std::string& serial = "");
  void remove_node(const std::string& node);
  /// Marks a node that delivers no images, such as a camera's metadata node.
  void set_metadata(const std::string& node) { metadata_.push_back(node); }

  /// Fills the next buffer now; false: none is queued.
  bool fill(FakeFill image);

  std::filesystem::path nodes() const override { return folder_.path() / "dev"; }
  std::filesystem::path classes() const override { return folder_.path() / "class"; }
  int open(const std::string& path) override;
  void close(int fd) override;
  int ioctl(int fd, unsigned long request, void* argument) override;
  std::span<std::byte> map(int fd, std::size_t bytes, std::uint32_t offset, int& error) override;
  void unmap(std::span<std::byte> bytes) override;
  short poll(int) override { return poll_events; }
  std::chrono::steady_clock::time_point now() override { return clock; }

  std::size_t mapped() const { return mapped_; }
  std::size_t queued() const { return queued_.size(); }
  bool streaming() const { return streaming_; }
  std::size_t buffers() const { return memory_.size(); }
  int open_descriptors() const { return open_; }
  int calls() const { return calls_; }
  std::string opened_node;  // the last one
  std::uint32_t code() const { return code_; }
  double rate_hz() const { return rate_hz_; }

 private:
  bool has_planes() const { return (capabilities & V4L2_CAP_VIDEO_CAPTURE_MPLANE) != 0; }
  const FakeV4l2Format* format(std::uint32_t code) const;
  std::uint32_t stride() const;
  std::uint32_t image_bytes() const;
  int set_format(v4l2_format& wanted);
  void tell_format(v4l2_format& into) const;
  int query_control(v4l2_queryctrl& query) const;
  int controls_call(unsigned long request, v4l2_ext_controls& all);
  int request_buffers(v4l2_requestbuffers& request);
  int query_buffer(v4l2_buffer& buffer);
  int queue(const v4l2_buffer& buffer);
  int dequeue(v4l2_buffer& buffer);
  int parameters(unsigned long request, v4l2_streamparm& parameters);
  int answer(unsigned long request, void* argument);

  TemporaryFolder folder_;
  UniqueFd ready_;
  std::vector<std::string> metadata_;
  std::uint32_t code_ = V4L2_PIX_FMT_YUYV;
  int width_ = 640, height_ = 480;
  double rate_hz_ = 30.0;
  std::vector<std::vector<std::byte>> memory_;
  std::vector<std::vector<std::byte>> orphans_;  // freed while still mapped
  std::deque<std::uint32_t> queued_;
  std::deque<std::pair<std::uint32_t, FakeFill>> filled_;
  std::size_t mapped_ = 0;
  bool streaming_ = false;
  int open_ = 0, calls_ = 0;
};

}  // namespace azimuth::test
