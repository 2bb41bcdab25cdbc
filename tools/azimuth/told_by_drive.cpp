#include "tools/azimuth/told_by_drive.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <sstream>
#include <utility>

#include "slam/geometry/angle.hpp"

namespace azimuth {
namespace {

/// The value of a text "key = value".
std::string value_in(const std::string& text) { return text.substr(text.find(" = ") + 3); }

std::string angle_text(double angle_rad) {
  return fmt::format("{:.4f} ({:.2f}\u00b0)", angle_rad, rad_to_degrees(angle_rad));
}

}  // namespace

bool ToldByDrive::asks_for(std::string_view part) const {
  return only_.empty() || std::ranges::find(only_, part) != only_.end();
}

void ToldByDrive::found(const std::string& part, const std::string& name, const std::string& sentence, FoundValue row) {
  if (!asks_for(part)) return;
  print(name, sentence);
  row.part = name;
  row.key = sentence.substr(0, sentence.find(' '));
  notes_[row.key] = sentence;
  if (row.judgement.empty())
    row.judgement = row.is_replaced
                        ? (has_rig_ ? "contradicts the rig: replaced" : "differs from the default: replaced")
                        : (has_rig_ ? "fits the rig: kept" : "fits the default: kept");
  rows_.push_back(std::move(row));
}

void ToldByDrive::cannot_tell_anything(const std::string& why) {
  print("drive", "cannot tell: " + why);
  untold_.push_back({"drive", why});
}

void ToldByDrive::cannot_tell(const std::string& part, const std::string& name, const std::string& what_would) {
  if (!asks_for(part)) return;
  print(name, "cannot tell: " + what_would);
  untold_.push_back({name, what_would});
}

Rig ToldByDrive::with_those_parts(Rig found, const Rig& said) const {
  CameraRig& camera = found.camera;
  const auto keep = [&](std::string_view part, auto& value, const auto& said_value) {
    if (!asks_for(part)) value = said_value;
  };
  keep("heading", camera.yaw_offset_rad, said.camera.yaw_offset_rad);
  keep("heading", camera.image.azimuth_offset_rad, said.camera.image.azimuth_offset_rad);
  keep("heading", camera.sigma_yaw_rad, said.camera.sigma_yaw_rad);
  keep("position", camera.position_m, said.camera.position_m);
  keep("position", camera.sigma_position_m, said.camera.sigma_position_m);
  keep("bearings", camera.sigma_bearing_rad, said.camera.sigma_bearing_rad);
  const OdometryRig odometry = found.odometry;
  if (!asks_for("noise")) found.odometry = said.odometry;
  const auto take_over = [&](std::string_view part, auto OdometryRig::*value) {
    found.odometry.*value = (asks_for(part) ? odometry : said.odometry).*value;
  };
  take_over("turn", &OdometryRig::scale_turn);
  take_over("turn", &OdometryRig::sigma_scale_turn);
  take_over("drift", &OdometryRig::drift_rad_per_m);
  take_over("drift", &OdometryRig::sigma_drift_rad_per_m);
  take_over("lag", &OdometryRig::lag_s);
  take_over("lag", &OdometryRig::sigma_lag_s);
  return found;
}

std::string ToldByDrive::noted(const std::string& rig) const {
  std::istringstream lines(rig);
  std::string text, table;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('[')) table = line.substr(1, line.find(']') - 1) + '.';
    const auto note = notes_.find(table + line.substr(0, line.find(' ')));
    if (note != notes_.end()) text += "# Found: " + note->second + ".\n";
    text += line + '\n';
  }
  return text;
}

void ToldByDrive::print(const std::string& name, const std::string& sentence) const {
  if (!quiet_) fmt::print("{:<11} {}\n", name, sentence);
}

double heading_of(const Rig& rig) {
  return sees_images(rig) ? rig.camera.image.azimuth_offset_rad : rig.camera.yaw_offset_rad;
}

void tell(const HeadingCalibration& found, double heading_rad, const Rig& said, const Rig& taken,
          ToldByDrive& told_by_drive) {
  if (!found.hand_told) {
    told_by_drive.cannot_tell("heading", "direction", "whether azimuths grow clockwise; drive longer, and turn");
  } else {
    const std::string before = value_in(direction_text(said)), after = value_in(direction_text(taken));
    told_by_drive.found("heading", "direction", direction_text(taken),
                        {.said = before, .found = after, .two_sigma = "sure", .is_replaced = before != after});
  }
  // The drive is fitted twice, and the rig gets the first value if the second fit agrees with it. The row shows that
  // value, so that it agrees with the file.
  const bool is_replaced = heading_of(said) != heading_of(taken);
  if (!(found.yaw.sigma > 0.0 && found.yaw.sigma < kTakenYaw_rad))
    told_by_drive.cannot_tell("heading", "where azimuth 0 is; drive straight on past landmarks");
  else
    told_by_drive.found("heading",
                        fmt::format("{} +- {:.2f} degrees", heading_text(taken), rad_to_degrees(found.yaw.sigma)),
                        {.said = angle_text(heading_of(said)),
                         .found = angle_text(is_replaced ? heading_of(taken) : heading_rad),
                         .two_sigma = angle_text(2.0 * found.yaw.sigma),
                         .is_replaced = is_replaced});
  if (!found.ahead.told)
    return told_by_drive.cannot_tell("position", "where the camera stands; turn on the spot both ways, near landmarks");
  const auto place_text = [](double ahead_m, double left_m) {
    return fmt::format("[{:.3f}, {:.3f}]", ahead_m, left_m);
  };
  const std::array<double, 2>&before = said.camera.position_m, &after = taken.camera.position_m;
  told_by_drive.found(
      "position",
      fmt::format("camera.position_m = {} +- {:.3f} m", place_text(after[0], after[1]), taken.camera.sigma_position_m),
      {.said = place_text(before[0], before[1]),
       .found = before != after ? place_text(after[0], after[1]) : place_text(found.ahead.value, found.left.value),
       .two_sigma = fmt::format("{:.3f}", 2.0 * std::max(found.ahead.sigma, found.left.sigma)),
       .is_replaced = before != after});
}

void tell(const TiltCalibration& found, const Rig& said, ToldByDrive& told_by_drive) {
  if (!found.told)
    return told_by_drive.cannot_tell("tilt",
                                     "how the camera leans; drive near things that are higher and lower than it");
  const char* const kept = found.contradicts ? "" : ", as it was: the drive does not contradict that";
  const auto tell_angle = [&](const char* key, double taken, double likeliest, double before) {
    told_by_drive.found("tilt", fmt::format("camera.{} = {:.4f} +- {:.4f}{}", key, taken, found.sigma_rad, kept),
                        {.said = angle_text(before),
                         .found = angle_text(likeliest),
                         .two_sigma = angle_text(2.0 * found.sigma_rad),
                         .is_replaced = found.contradicts});
  };
  tell_angle("roll_rad", found.tilt.roll_rad, found.likeliest.roll_rad, said.camera.roll_rad);
  tell_angle("pitch_rad", found.tilt.pitch_rad, found.likeliest.pitch_rad, said.camera.pitch_rad);
}

void tell(const OdometryCalibration& found, const OdometryRig& said, const OdometryRig& taken,
          ToldByDrive& told_by_drive) {
  const auto tell_number = [&](const FoundNumber& number, double before, double after, const std::string& name,
                               const std::string& key, const char* unit) {
    if (!number.told)
      return told_by_drive.cannot_tell(name, key + "; drive longer, among landmarks, with turns both ways");
    const bool is_replaced = number.value == after;
    const char* const kept = is_replaced ? "" : ", as it was: the drive does not contradict that";
    told_by_drive.found(name, fmt::format("odometry.{} = {:.4f} +- {:.4f}{}{}", key, after, number.sigma, unit, kept),
                        {.said = fmt::format("{:.4f}", before),
                         .found = fmt::format("{:.4f}", number.value),
                         .two_sigma = fmt::format("{:.4f}", 2.0 * number.sigma),
                         .is_replaced = is_replaced});
  };
  tell_number(found.turn, said.scale_turn, taken.scale_turn, "turn", "scale_turn", "");
  tell_number(found.drift, said.drift_rad_per_m, taken.drift_rad_per_m, "drift", "drift_rad_per_m", " rad/m");
  tell_number(found.lag, said.lag_s, taken.lag_s, "lag", "lag_s", " s");
  const auto tell_noise = [&](NoiseSort sort, const char* key, double power, double before, double after) {
    const OdometryNoise::Told& told = found.noise.of(sort);
    if (!told.is_told()) return;
    const std::string likeliest = fmt::format("{:.2g}", std::pow(told.variance, power));
    told_by_drive.found("noise",
                        fmt::format("odometry.{} = {:.2g}, {} +- {:.0f} % is likeliest", key, after, likeliest,
                                    100.0 * power * told.sigma_relative),
                        {.said = fmt::format("{:.2g}", before),
                         .found = likeliest,
                         .two_sigma = fmt::format("{:.0f} %", 200.0 * power * told.sigma_relative),
                         .is_replaced = true,
                         .judgement = fmt::format("replaced by {:.2g}, {}", after,
                                                  told.is_held() ? "since one drive does not prove less noise"
                                                                 : "one standard deviation more, to be safe")});
  };
  tell_noise(NoiseSort::distance, "lambda_distance_m", 1.0, said.lambda_distance_m, taken.lambda_distance_m);
  tell_noise(NoiseSort::rotation, "lambda_rotation_rad", 1.0, said.lambda_rotation_rad, taken.lambda_rotation_rad);
  tell_noise(NoiseSort::drift, "lambda_drift_rad2_per_m", 1.0, said.lambda_drift_rad2_per_m,
             taken.lambda_drift_rad2_per_m);
  tell_noise(NoiseSort::lateral, "sigma_lateral_m_per_sqrt_m", 0.5, said.sigma_lateral_m_per_sqrt_m,
             taken.sigma_lateral_m_per_sqrt_m);
  if (found.creep.is_told())
    told_by_drive.found(
        "noise", "creep",
        fmt::format("odometry.floor_rotation_rad = {:.4f}, floor_distance_m = {:.4f}: it goes on by "
                    "{:.4f} rad and {:.4f} m a second at a standstill",
                    taken.floor_rotation_rad, taken.floor_distance_m, found.creep.rad_per_s(), found.creep.m_per_s()),
        {.said = fmt::format("{:.4f}", said.floor_rotation_rad),
         .found = fmt::format("{:.4f}", taken.floor_rotation_rad),
         .is_replaced = true,
         .judgement = fmt::format("replaced, and floor_distance_m by {:.4f}: odometry goes on at a standstill",
                                  taken.floor_distance_m)});
  told_by_drive.cannot_tell(
      "turn", "distance", "bearings know no lengths: azimuth calibrate odometry --measured FROM,TO,METRES, or --truth");
}

void tell(const Smoother::Noise& noise, const Rig& said, const Rig& taken, ToldByDrive& told_by_drive) {
  const double sigma_relative = 1.0 / std::sqrt(2.0 * noise.told), taken_rad = taken.camera.sigma_bearing_rad;
  FoundValue row{.said = angle_text(said.camera.sigma_bearing_rad),
                 .found = angle_text(said.camera.sigma_bearing_rad * noise.ratio),
                 .two_sigma = fmt::format("{:.0f} %", 200.0 * sigma_relative),
                 .is_replaced = true};
  if (std::abs(noise.ratio - 1.0) <= 2.0 * sigma_relative) {
    row.is_replaced = false;
    row.judgement = fmt::format("fits: refined to {:.4f}", taken_rad);
  } else if (noise.ratio < 1.0) {
    row.judgement =
        fmt::format("replaced by {:.4f}, since the bearings of an image share errors that do not show", taken_rad);
  }
  told_by_drive.found("bearings",
                      fmt::format("camera.sigma_bearing_rad = {:.4f} +- {:.0f} %", taken_rad, 100.0 * sigma_relative),
                      std::move(row));
}

}  // namespace azimuth
