#pragma once
// A fixture with a live view, messages of a drive for it, and the events that it sends to a page.

#include <chrono>
#include <gtest/gtest.h>
#include <initializer_list>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "tests/tools/view/seen_events.hpp"
#include "tools/view/live_view.hpp"

namespace azimuth::test {

inline constexpr std::int64_t kStart_us = 1'000'000'000, kWall_us = 1'700'000'000'000'000;

inline constexpr std::string_view kRig =
    "front_end = \"bearings\"\n[camera]\nmodel = \"bearings\"\nyaw_offset_rad = 0.5\nazimuths_clockwise = true\n";

/// A pose at `ms` milliseconds after the start; `ms` is its sequence number too.
inline pose_cov_t a_pose(std::int64_t ms) {
  pose_cov_t pose{};
  pose.utime = kStart_us + 1000 * ms;
  pose.seq = ms;
  pose.x_m = 1.0 / 3.0;
  pose.odom_x_m = 1e-3 * static_cast<double>(ms);
  pose.covariance[0] = 0.25;
  pose.covariance[4] = 0.5;
  pose.covariance[8] = 0.125;
  pose.health = pose_cov_t::HEALTH_TRACKING;
  return pose;
}

/// A map piece with one landmark, whose id is the number of the piece.
inline map_chunk_t a_map_piece(std::int32_t number, std::int32_t pieces, std::int64_t sequence) {
  map_chunk_t piece{};
  piece.utime = kStart_us;
  piece.seq = sequence;
  piece.chunk = number;
  piece.chunks = pieces;
  piece.landmarks.resize(1);
  piece.landmarks[0].id = number;
  piece.n = 1;
  return piece;
}

inline BearingSet a_set(std::int64_t ms, std::initializer_list<double> azimuths_rad) {
  BearingSet set;
  set.stamp = stamp_from_us(kStart_us + 1000 * ms);
  for (const double azimuth_rad : azimuths_rad) set.bearings.push_back({.azimuth_rad = azimuth_rad});
  return set;
}

inline sightings_t sightings(std::int64_t ms, std::int64_t step,
                             std::initializer_list<std::pair<std::int64_t, double>> used) {
  sightings_t message{};
  message.utime = kStart_us + 1000 * ms;
  message.step = step;
  for (const auto& [landmark, azimuth_rad] : used) {
    sighting_t sighting{};
    sighting.landmark_id = landmark;
    sighting.azimuth_rad = azimuth_rad;
    sighting.elevation_rad = std::numeric_limits<double>::quiet_NaN();
    message.sightings.push_back(sighting);
  }
  message.n = static_cast<std::int32_t>(used.size());
  return message;
}

/// Expected bearings of the given landmarks at the given azimuths. Each has a standard deviation of 0.1 rad and a gate
/// of 0.3 rad.
inline expectations_t expectations(std::int64_t ms, std::initializer_list<std::pair<std::int64_t, double>> expected) {
  expectations_t message{};
  message.utime = kStart_us + 1000 * ms;
  for (const auto& [landmark, azimuth_rad] : expected) {
    expected_bearing_t each{};
    each.landmark_id = landmark;
    each.azimuth_rad = azimuth_rad;
    each.sigma_rad = 0.1;
    each.gate_rad = 0.3;
    each.elevation_rad = each.gate_elevation_rad = std::numeric_limits<double>::quiet_NaN();
    message.expected.push_back(each);
  }
  message.n = static_cast<std::int32_t>(expected.size());
  return message;
}

inline nlohmann::json data(const ViewEvent& event) {
  std::string text = *event.text;
  return take_events(text).at(0).data;
}

class ShownTest : public testing::Test {
 protected:
  ShownTest() { lookers_.add(outbox_); }

  Reception now() {
    collect();
    return {now_, kWall_us};
  }
  void pass(std::chrono::milliseconds time) { now_ += time; }

  /// The data of all events of this kind so far.
  std::vector<nlohmann::json> of_kind(EventKind kind) {
    collect();
    std::string text = seen_;
    std::vector<nlohmann::json> all;
    for (SeenEvent& event : take_events(text))
      if (event.name == to_string(kind)) all.push_back(std::move(event.data));
    return all;
  }

  void collect() {
    while (const std::optional<ViewEvent> event = outbox_.pop()) seen_ += *event->text;
  }

  std::chrono::steady_clock::time_point now_{std::chrono::hours(1)};
  Lookers lookers_;
  Outbox outbox_;
  LiveView view_{"azimuth test", "udpm://239.255.76.67:7667", lookers_, now_};
  std::string seen_;
};

}  // namespace azimuth::test
