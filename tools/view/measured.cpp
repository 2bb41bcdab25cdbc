#include "tools/view/measured.hpp"

#include <cmath>
#include <utility>

#include "tools/view/message_json.hpp"

namespace azimuth {
namespace {

using Json = nlohmann::json;

/// A stamp that differs more from the wall clock belongs to another clock, such as that of a recording.
constexpr double kSameClock_s = 10.0;

}  // namespace

void Measured::pose(std::int64_t utime_us, const Reception& heard) {
  ++poses_;
  const double latency_s = 1e-6 * static_cast<double>(heard.wall_us - utime_us);
  latency_s_ = std::abs(latency_s) < kSameClock_s ? latency_s : std::numeric_limits<double>::quiet_NaN();
}

void Measured::innovations(double nis, std::int32_t compared) {
  nis_ += nis;
  compared_ += compared;
}

void Measured::put_into(Json& status, Clock::time_point now) {
  status["rates"] = rates(now);
  status["latency_s"] = number_json(latency_s_);
  const double nis = std::exchange(nis_, 0.0);
  const std::int64_t compared = std::exchange(compared_, 0);
  status["nis"] = compared > 0 ? Json({{"value", rounded_json(nis, 1e4)}, {"degrees", compared}}) : Json(nullptr);
}

Json Measured::rates(Clock::time_point now) {
  const double seconds = std::chrono::duration<double>(now - std::exchange(since_, now)).count();
  const auto rate = [seconds](std::uint64_t& count) {
    const auto number = static_cast<double>(std::exchange(count, 0));
    return seconds > 0.1 ? rounded_json(number / seconds, 100.0) : Json(nullptr);
  };
  return {{"pose_hz", rate(poses_)}, {"odometry_hz", rate(odometry_)}, {"image_hz", rate(images_)}};
}

}  // namespace azimuth
