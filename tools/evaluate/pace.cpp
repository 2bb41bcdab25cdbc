#include "tools/evaluate/pace.hpp"

#include <fmt/format.h>
#include <string_view>

namespace azimuth {
namespace {

/// Advice on how to speed up the front end.
std::string_view lighter_front_end(std::string_view front_end) {
  if (front_end == "sift") return "a smaller sift.side_px or sift.target_count makes looking at an image quicker";
  return "smaller images make looking at one quicker: choose a smaller size at the camera";
}

std::string_view lighter_estimator(std::string_view estimator) {
  if (estimator == "fastslam") return "fewer fastslam.particles make a step quicker";
  if (estimator == "lamp_ekf") return "a smaller lamp_ekf.max_landmarks makes a step quicker";
  if (estimator == "smoother")
    return "a smaller smoother.max_keyframes, or fewer smoother.members where bearings have no names, make a step "
           "quicker";
  return "a smaller ekf.max_landmarks makes a step quicker";
}

}  // namespace

std::string why_too_slow(const Report& report) {
  if (!(report.step.mean_us > report.image_period_us)) return "";
  const bool by_images = report.detect.mean_us > 0.5 * report.step.mean_us;
  return fmt::format(
      "a step took {:.1f} ms on the average and images came every {:.1f} ms: a daemon on this machine would leave "
      "images out; {}",
      1e-3 * report.step.mean_us, 1e-3 * report.image_period_us,
      by_images ? lighter_front_end(report.front_end) : lighter_estimator(report.estimator));
}

}  // namespace azimuth
