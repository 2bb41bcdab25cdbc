#include "drivers/picture/picture.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <utility>

#include "drivers/picture/to_rgb.hpp"
#include "slam/camera/make_camera.hpp"
#include "slam/geometry/angle.hpp"

namespace azimuth {
namespace {

constexpr double kBetween_px = 4.0;

/// The share of the rim that a name needs: a text of any orientation is at most as wide as its diagonal.
double share_rad(const RimNames::Name& name, double radius_px) {
  const Pixel size = Canvas::label_size_px(name.text);
  return (size.norm() + kBetween_px) / radius_px;
}

/// Adjacent names treated as one, centred between their azimuths.
struct Group {
  double middle_rad, share_rad;
  std::size_t names;

  double from_rad() const { return middle_rad - 0.5 * share_rad; }
  double to_rad() const { return middle_rad + 0.5 * share_rad; }
  void join(const Group& next) {
    // The common start that minimises the displacement of all names, each with the same weight.
    const double begin =
        (from_rad() * double(names) + (next.from_rad() - share_rad) * double(next.names)) / double(names + next.names);
    share_rad += next.share_rad;
    names += next.names;
    middle_rad = begin + 0.5 * share_rad;
  }
};

constexpr int kUsualWidth_px = 640, kUsualHeight_px = 480;  // For a camera without a known size

// Distances from the rim outwards.
constexpr double kArc_px = 8.0, kTick_px = 5.0, kNames_px = 24.0;
constexpr double kFeatureRadius_px = 4.0, kCross_px = 3.0, kNameBelow_px = 14.0, kNameAside_px = 18.0;
constexpr double kArcStep_rad = 0.03;

constexpr PictureColour kOutline{150, 150, 150}, kUnexpected{255, 0, 255}, kWriting{255, 255, 255}, kBad{255, 90, 60};
constexpr PictureColour kOfNoKind{0, 220, 220};
/// The colours of the kinds. The first four belong to the default colour classes: red, yellow, green, blue.
constexpr std::array<PictureColour, 8> kKinds{{{255, 70, 70},
                                               {255, 230, 60},
                                               {70, 230, 90},
                                               {110, 150, 255},
                                               {255, 160, 60},
                                               {190, 130, 255},
                                               {150, 220, 180},
                                               {230, 180, 190}}};

const PictureColour& colour_of(Kind kind) {
  return kind < 0 ? kOfNoKind : kKinds[static_cast<std::size_t>(kind) % kKinds.size()];
}

std::string two_digits(std::int64_t number) { return (number < 10 ? "0" : "") + std::to_string(number); }

/// A stamp for a person: seconds if the clock counts from a start, the date if the clock counts from 1970.
std::string time_of(Stamp stamp) {
  constexpr std::int64_t kYears_s = 1'000'000'000;  // 32 years: no machine is up for so long
  constexpr std::int64_t kDay_s = 86'400;
  const std::int64_t hundredths = std::max<std::int64_t>(0, to_us(stamp)) / 10'000, s = hundredths / 100;
  const std::string fraction = "." + two_digits(hundredths % 100);
  if (s < kYears_s) return std::to_string(s) + fraction + " s";
  const std::chrono::year_month_day date(std::chrono::sys_days(std::chrono::days(s / kDay_s)));
  const std::int64_t of_day_s = s % kDay_s;
  return std::to_string(int(date.year())) + "-" + two_digits(unsigned(date.month())) + "-" +
         two_digits(unsigned(date.day())) + " " + two_digits(of_day_s / 3600) + ":" + two_digits(of_day_s / 60 % 60) +
         ":" + two_digits(of_day_s % 60) + fraction + " UTC";
}

std::optional<CameraModel> model_of(const CameraRig& rig) {
  std::string no_matter;
  return camera_of(rig, no_matter);
}

}  // namespace

void RimNames::add(double azimuth_rad, std::string text, const PictureColour& colour) {
  names_.push_back({wrap(azimuth_rad), std::move(text), colour});
}

/// The rim is a circle. It is cut at the widest gap, and azimuths increase from there.
void RimNames::begin_after_the_widest_gap() {
  if (names_.empty()) return;
  std::ranges::stable_sort(names_, {}, &Name::azimuth_rad);
  std::size_t first = 0;
  double widest_rad = names_.front().azimuth_rad + 2.0 * kPi - names_.back().azimuth_rad;
  for (std::size_t i = 1; i < names_.size(); ++i) {
    const double gap_rad = names_[i].azimuth_rad - names_[i - 1].azimuth_rad;
    if (gap_rad <= widest_rad) continue;
    widest_rad = gap_rad;
    first = i;
  }
  for (std::size_t i = 0; i < first; ++i) names_[i].azimuth_rad += 2.0 * kPi;
  std::rotate(names_.begin(), names_.begin() + static_cast<std::ptrdiff_t>(first), names_.end());
}

const std::vector<RimNames::Name>& RimNames::placed(double radius_px) {
  begin_after_the_widest_gap();
  double all_rad = 0.0;
  for (const Name& name : names_) all_rad += share_rad(name, radius_px);
  const double scale = std::min(1.0, 2.0 * kPi / all_rad);
  std::vector<Group> groups;
  for (const Name& name : names_) {
    groups.push_back({name.azimuth_rad, scale * share_rad(name, radius_px), 1});
    while (groups.size() > 1 && groups[groups.size() - 2].to_rad() > groups.back().from_rad()) {
      const Group last = groups.back();
      groups.pop_back();
      groups.back().join(last);
    }
  }
  std::size_t next = 0;
  for (const Group& group : groups) {
    double from_rad = group.from_rad();
    for (std::size_t k = 0; k < group.names; ++k, ++next) {
      const double share = scale * share_rad(names_[next], radius_px);
      names_[next].placed_rad = from_rad + 0.5 * share;
      from_rad += share;
    }
  }
  return names_;
}

Picture::Picture(const CameraRig& rig)
    : width_px_(rig.image.width_px.value_or(kUsualWidth_px)),
      height_px_(rig.image.height_px.value_or(kUsualHeight_px)),
      axes_(axes_of(rig.image)),
      mask_(mask_of(rig.image)),
      model_(model_of(rig)) {}

ImageView Picture::draw(const ImageView& image, const BearingSet& seen, std::span<const ExpectedBearing> expected,
                        std::optional<std::span<const std::int64_t>> in_map) {
  in_map_ = in_map;
  rim_names_.clear();
  written_.clear();
  const bool readable = image.readable();
  canvas_.begin(readable ? image.format.width_px : width_px_, readable ? image.format.height_px : height_px_);
  cv::Mat pixels = canvas_.image();
  to_rgb(image, pixels);
  rim_px_ = std::min(mask_.outer_px, 0.5 * std::min(pixels.cols, pixels.rows));
  draw_mask();
  for (const ExpectedBearing& bearing : expected) draw_expected(bearing);
  write_rim_names();
  std::size_t expected_seen = 0;
  for (const Bearing& bearing : seen.bearings) {
    const bool is_expected =
        std::ranges::any_of(expected, [&](const ExpectedBearing& one) { return explains(one, bearing); });
    draw_seen(bearing, is_expected);
    expected_seen += is_expected ? 1 : 0;
  }
  write_captions(seen, expected_seen, expected.size());
  const cv::Mat& picture = canvas_.picture();
  const FrameFormat format = packed_format(PixelFormat::rgb8, picture.cols, picture.rows);
  return {format, std::as_bytes(std::span(picture.data, format.bytes()))};
}

void Picture::draw_mask() {
  if (mask_.inner_px > 0.0) draw_ring(mask_.inner_px);
  draw_ring(rim_px_);
  for (const std::vector<Pixel>& polygon : mask_.hidden) canvas_.polyline(polygon, true, kOutline);
}

/// The pixel at this radius. In the image of a tilted camera, the azimuth is that which the camera shows near this
/// radius.
Pixel Picture::at(double radius_px, double azimuth_rad) const {
  const Pixel level = axes_.pixel({radius_px, azimuth_rad});
  if (!model_ || model_->is_level()) return level;
  const auto shown = model_->tilted_pixel(level);
  return shown ? axes_.pixel({radius_px, axes_.azimuth_rad(*shown)}) : level;
}

void Picture::draw_ring(double radius_px) { draw_arc(radius_px, -kPi, kPi, kOutline, 1); }

void Picture::draw_arc(double radius_px, double from_rad, double to_rad, const PictureColour& colour,
                       int thickness_px) {
  const int steps = 1 + static_cast<int>((to_rad - from_rad) / kArcStep_rad);
  std::vector<Pixel> points;
  for (int i = 0; i <= steps; ++i) points.push_back(at(radius_px, from_rad + (to_rad - from_rad) * i / steps));
  canvas_.polyline(points, false, colour, thickness_px);
}

void Picture::draw_expected(const ExpectedBearing& expected) {
  if (draw_gate(expected)) return;
  const PictureColour& colour = colour_of(expected.kind);
  const double azimuth_rad = expected.azimuth_rad, gate_rad = std::clamp(expected.gate_rad, 0.0, kPi);
  if (!std::isfinite(azimuth_rad + gate_rad)) return;
  draw_arc(rim_px_ + kArc_px, azimuth_rad - gate_rad, azimuth_rad + gate_rad, colour, 2);
  canvas_.line(at(rim_px_ + kArc_px - kTick_px, azimuth_rad), at(rim_px_ + kArc_px + kTick_px, azimuth_rad), colour);
  if (std::string name = name_of(expected); !name.empty()) rim_names_.add(azimuth_rad, std::move(name), colour);
}

std::string Picture::name_of(const ExpectedBearing& expected) const {
  if (!in_map_) return std::to_string(expected.landmark);
  const auto found = std::ranges::lower_bound(*in_map_, expected.landmark);
  if (found == in_map_->end() || *found != expected.landmark) return {};
  return std::to_string(found - in_map_->begin() + 1);
}

/// A displaced name is connected to its azimuth by a line.
void Picture::write_rim_names() {
  for (const RimNames::Name& name : rim_names_.placed(rim_px_ + kNames_px)) {
    if (std::abs(name.placed_rad - name.azimuth_rad) * rim_px_ > kTick_px)
      canvas_.line(at(rim_px_ + kArc_px + kTick_px, name.azimuth_rad),
                   at(rim_px_ + kNames_px - kTick_px, name.placed_rad), name.colour);
    canvas_.label(at(rim_px_ + kNames_px, name.placed_rad), name.text, name.colour);
  }
}

/// Writes the text at the first of the places where it overlaps no other name; nowhere if it overlaps at all of them.
void Picture::write_where_free(std::initializer_list<Pixel> middles, const std::string& text,
                               const PictureColour& colour) {
  if (text.empty()) return;
  const Pixel half = 0.5 * Canvas::label_size_px(text) + Pixel(1.0, 1.0);
  for (const Pixel& middle : middles) {
    const Eigen::AlignedBox2d box(middle - half, middle + half);
    if (std::ranges::any_of(written_, [&](const Eigen::AlignedBox2d& other) { return other.intersects(box); }))
      continue;
    written_.push_back(box);
    return canvas_.label(middle, text, colour);
  }
}

/// Draws the gate if the elevation determines its pixel. The gate is cut off at the zenith and at the limit of the
/// camera's field of view.
bool Picture::draw_gate(const ExpectedBearing& expected) {
  if (!model_ || !std::isfinite(expected.elevation_rad + expected.gate_elevation_rad)) return false;
  const auto middle = model_->pixel(Direction{expected.azimuth_rad, expected.elevation_rad});
  if (!middle) return false;
  constexpr int kCorners = 48;
  const double gate_rad = std::clamp(expected.gate_rad, 0.0, kPi);
  std::vector<Pixel> outline;
  for (int k = 0; k < kCorners; ++k) {
    const double turn_rad = 2.0 * kPi * k / kCorners;
    const double elevation_rad = expected.elevation_rad + expected.gate_elevation_rad * std::sin(turn_rad);
    const auto corner = model_->pixel(Direction{wrap(expected.azimuth_rad + gate_rad * std::cos(turn_rad)),
                                                std::clamp(elevation_rad, -kPi / 2.0, kPi / 2.0)});
    if (corner) outline.push_back(*corner);
  }
  const PictureColour& colour = colour_of(expected.kind);
  if (outline.size() > 1) canvas_.polyline(outline, true, colour);
  canvas_.line(*middle - Pixel(kCross_px, 0.0), *middle + Pixel(kCross_px, 0.0), colour);
  canvas_.line(*middle - Pixel(0.0, kCross_px), *middle + Pixel(0.0, kCross_px), colour);
  write_where_free({*middle + Pixel(0.0, kNameBelow_px), *middle - Pixel(0.0, kNameBelow_px),
                    *middle + Pixel(kNameAside_px, 0.0), *middle - Pixel(kNameAside_px, 0.0)},
                   name_of(expected), colour);
  return true;
}

void Picture::draw_seen(const Bearing& bearing, bool is_expected) {
  const PictureColour& colour = is_expected ? colour_of(bearing.kind) : kUnexpected;
  if (model_ && std::isfinite(bearing.elevation_rad)) {
    const auto pixel = model_->pixel(Direction{bearing.azimuth_rad, bearing.elevation_rad});
    if (pixel) return canvas_.circle(*pixel, kFeatureRadius_px, colour);
  }
  canvas_.line(at(mask_.inner_px, bearing.azimuth_rad), at(rim_px_, bearing.azimuth_rad), colour);
  if (bearing.identity == kUnknownIdentity) return;
  const auto along = [&](double share) {
    return at(mask_.inner_px + share * (rim_px_ - mask_.inner_px), bearing.azimuth_rad);
  };
  write_where_free({along(0.5), along(0.62), along(0.38), along(0.74)}, std::to_string(bearing.identity), colour);
}

void Picture::write_captions(const BearingSet& seen, std::size_t expected_seen, std::size_t expected) {
  canvas_.caption(0, time_of(seen.stamp), kWriting);
  canvas_.caption(1,
                  std::to_string(seen.bearings.size()) + " seen, " + std::to_string(expected_seen) +
                      " of them in one of " + std::to_string(expected) + " gates",
                  kWriting);
  if (seen.trouble != ImageTrouble::none) canvas_.caption(2, std::string(to_string(seen.trouble)), kBad);
}

}  // namespace azimuth
