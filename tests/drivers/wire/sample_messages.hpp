#pragma once
// Messages for the tests of encoding and decoding.

#include <azimuth/pose_t.hpp>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "drivers/wire/messages.hpp"
#include "tests/drivers/wire/samples.hpp"

namespace azimuth::test {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <class Message>
Buffer encoded(const Message& message) {
  Buffer out;
  encode(message, out);
  return out;
}

/// Overwrites a big-endian int32.
inline void put_int32(Buffer& data, std::size_t at, std::int64_t value) {
  for (std::size_t i = 0; i < 4; ++i) data[at + i] = static_cast<std::byte>((value >> (24 - 8 * i)) & 0xFF);
}

inline const BearingSet kSet{stamp_from_us(1'700'000'000'123'456), 9, {{0.5, kNaN, -1}, {-3.0, 0.25, 12}}};
inline const OdometryReading kReading{stamp_from_us(-5), 3, 0xFFFFFFFFU, {1.0, -2.0, 3.0}, 0.25, 0.125};

inline path_t a_path() {
  path_t path{};
  path.seq = 3;
  path.chunk = 1;
  path.chunks = 2;
  path.n = 2;
  path.poses.resize(2);
  path.poses[1].x_m = 1.5;
  return path;
}

/// Each text has a different length.
inline status_t a_status() {
  status_t status{};
  std::string letters = "few";
  for (std::string* text :
       {&status.reason, &status.image_trouble, &status.input_trouble, &status.map_trouble, &status.picture_trouble,
        &status.odometer, &status.camera, &status.recorder, &status.realtime, &status.configuration})
    *text = letters += '!';
  status.robot_flags = 77;
  status.battery_v = 12.5;
  status.landmarks = 9;
  return status;
}

inline sightings_t some_sightings() {
  sightings_t message{};
  message.step = 5;
  message.rejected = 3;
  message.n = 2;
  message.sightings.resize(2);
  message.sightings[1].landmark_id = 7;
  message.sightings[1].azimuth_rad = -0.5;
  message.sightings[1].elevation_rad = kNaN;
  return message;
}

inline expectations_t some_expectations() {
  expectations_t message{};
  message.step = 5;
  message.nis = 2.5;
  message.compared = 2;
  message.n = 2;
  message.expected.resize(2);
  message.expected[0].elevation_rad = kNaN;
  message.expected[1].landmark_id = 7;
  message.expected[1].azimuth_rad = -0.5;
  message.expected[1].rejected_in_row = 3;
  return message;
}

inline kept_t some_kept() {
  kept_t message{};
  message.log_size = 1'000'000;
  message.disk_free = -1;
  message.map_utime = 1'700'000'000'000'000;
  return message;
}

}  // namespace azimuth::test
