#pragma once
// An open camera of the libdc1394 stand-in.

#include <algorithm>
#include <cstdint>
#include <gtest/gtest.h>
#include <memory>
#include <string>

#include "drivers/iidc/iidc_stream.hpp"
#include "tests/drivers/iidc/fake_dc1394.hpp"

namespace azimuth::test {

class IidcBench : public testing::Test {
 public:
  ~IidcBench() override {
    stream_.reset();
    EXPECT_TRUE(fake().misuse.empty()) << "line " << fake().misuse.front() << " of the stand-in";
    EXPECT_EQ(fake().captures, 0);
    EXPECT_EQ(fake().cameras, 0);
    EXPECT_EQ(fake().contexts, 0);
  }

 protected:
  using Read = ImageStream::Read;

  IidcBench() { reset_fake(); }
  bool open() {
    stream_.reset();
    OpenedStream opened = open_iidc(settings_);
    trouble_ = opened ? CameraTrouble{} : opened.error();
    if (opened) stream_ = *std::move(opened);
    EXPECT_NE(stream_ == nullptr, trouble_.text.empty());
    return stream_ != nullptr;
  }
  Read read() { return stream_->read(frame_); }
  /// All sentences about refused settings, one per line.
  std::string refused() const {
    std::string all;
    for (const std::string& sentence : stream_->description().refused) all += sentence + "\n";
    return all;
  }
  static bool is_filled_with(const Frame& frame, std::uint8_t number) {
    return std::ranges::all_of(frame.bytes(), [&](std::byte byte) { return byte == static_cast<std::byte>(number); });
  }

  IidcSettings settings_;
  CameraTrouble trouble_;
  std::unique_ptr<ImageStream> stream_;
  Frame frame_;
};

}  // namespace azimuth::test
