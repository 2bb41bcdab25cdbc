#include "tools/calibrate/learn_colours.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>

#include "slam/geometry/angle.hpp"
#include "slam/perception/colour/class_table.hpp"

namespace azimuth {
namespace {

constexpr int kClickRadius_px = 3;
constexpr std::size_t kFewestPixels = 10;
constexpr double kOdd = 0.02;  // fraction of the pixels at either end that is discarded as outliers
constexpr double kHueMargin_deg = 8.0;
constexpr double kSaturationMargin = 0.15;
constexpr double kLessLight = 0.5;
constexpr double kLeastSaturation = 0.2, kLeastValue = 0.08;  // a pixel below either limit has no usable hue

/// Parses exactly `count` integers separated by commas.
std::optional<std::vector<int>> numbers(std::string_view text, std::size_t count) {
  std::vector<int> values;
  const char *at = text.data(), *const end = text.data() + text.size();
  while (values.size() < count) {
    int value = 0;
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc{}) return std::nullopt;
    values.push_back(value);
    at = next;
    if (values.size() == count) break;
    if (at == end || *at++ != ',') return std::nullopt;
  }
  return at == end ? std::optional(values) : std::nullopt;
}

std::optional<PixelRectangle> within(const PixelRectangle& rectangle, const FrameFormat& format) {
  const bool inside = rectangle.first_u >= 0 && rectangle.first_v >= 0 && rectangle.last_u < format.width_px &&
                      rectangle.last_v < format.height_px;
  return inside ? std::optional(rectangle) : std::nullopt;
}

/// The value below which the fraction `part` of all values lies.
double quantile(std::vector<double> values, double part) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// Circular mean: the direction of the sum of the unit vectors of all hues.
double mean_hue_deg(const std::vector<Hsv>& pixels) {
  double x = 0.0, y = 0.0;
  for (const Hsv& pixel : pixels) {
    x += std::cos(degrees_to_rad(pixel.hue_deg));
    y += std::sin(degrees_to_rad(pixel.hue_deg));
  }
  return rad_to_degrees(std::atan2(y, x));
}

double in_circle(double hue_deg) { return std::fmod(std::fmod(hue_deg, 360.0) + 360.0, 360.0); }

double to_tenths(double value) { return std::round(value * 10.0) / 10.0; }
double to_hundredths(double value) { return std::round(value * 100.0) / 100.0; }

void learn_hue(const std::vector<Hsv>& pixels, ColourClass& learnt) {
  const double middle_deg = mean_hue_deg(pixels);
  std::vector<double> off_deg;
  for (const Hsv& pixel : pixels) off_deg.push_back(rad_to_degrees(wrap(degrees_to_rad(pixel.hue_deg - middle_deg))));
  learnt.hue_from_deg = to_tenths(in_circle(middle_deg + quantile(off_deg, kOdd) - kHueMargin_deg));
  learnt.hue_to_deg = to_tenths(in_circle(middle_deg + quantile(off_deg, 1.0 - kOdd) + kHueMargin_deg));
}

template <class Member>
double low_quantile(const std::vector<Hsv>& pixels, Member member) {
  std::vector<double> values;
  for (const Hsv& pixel : pixels) values.push_back(pixel.*member);
  return quantile(std::move(values), kOdd);
}

}  // namespace

std::optional<PixelRectangle> parse_rectangle(std::string_view text, const FrameFormat& format) {
  const auto c = numbers(text, 4);
  if (!c) return std::nullopt;
  const auto [u0, u1] = std::minmax((*c)[0], (*c)[2]);
  const auto [v0, v1] = std::minmax((*c)[1], (*c)[3]);
  return within({u0, v0, u1, v1}, format);
}

std::optional<PixelRectangle> parse_click(std::string_view text, const FrameFormat& format) {
  const auto c = numbers(text, 2);
  if (!c || !within({(*c)[0], (*c)[1], (*c)[0], (*c)[1]}, format)) return std::nullopt;
  const int u = (*c)[0], v = (*c)[1];
  return PixelRectangle{std::max(0, u - kClickRadius_px), std::max(0, v - kClickRadius_px),
                        std::min(format.width_px - 1, u + kClickRadius_px),
                        std::min(format.height_px - 1, v + kClickRadius_px)};
}

void add_pixels(const ImageView& image, const PixelRectangle& rectangle, std::vector<Rgb>& pixels) {
  for (int v = rectangle.first_v; v <= rectangle.last_v; ++v)
    for (int u = rectangle.first_u; u <= rectangle.last_u; ++u) {
      const std::uint8_t* const samples = image.row(v) + 3 * u;
      pixels.push_back({samples[0], samples[1], samples[2]});
    }
}

std::optional<ColourClass> learn_class(const LabelledPixels& labelled) {
  std::vector<Hsv> pixels;
  for (const Rgb& pixel : labelled.pixels) {
    const Hsv hsv = hsv_of(pixel);
    if (hsv.saturation >= kLeastSaturation && hsv.value >= kLeastValue) pixels.push_back(hsv);
  }
  if (pixels.size() < kFewestPixels || 2 * pixels.size() < labelled.pixels.size()) return std::nullopt;
  ColourClass learnt{.name = labelled.name};
  learn_hue(pixels, learnt);
  learnt.saturation_min =
      to_hundredths(std::max(kLeastSaturation, low_quantile(pixels, &Hsv::saturation) - kSaturationMargin));
  learnt.value_min = to_hundredths(std::max(kLeastValue, kLessLight * low_quantile(pixels, &Hsv::value)));
  return learnt;
}

std::vector<ColourClass> updated(std::vector<ColourClass> classes, std::span<const ColourClass> learnt) {
  for (const ColourClass& each : learnt) {
    const auto same = std::ranges::find(classes, each.name, &ColourClass::name);
    if (same == classes.end()) {
      classes.push_back(each);
    } else {
      *same = each;
    }
  }
  return classes;
}

std::string separation_text(std::span<const LabelledPixels> labelled, const std::vector<ColourClass>& classes) {
  ColourSettings settings;
  settings.classes = classes;
  std::string text;
  for (const LabelledPixels& each : labelled) {
    std::size_t own = 0, other = 0;
    for (const Rgb& pixel : each.pixels) {
      const ClassNumber number = class_of(settings, pixel);
      if (number == 0) continue;
      ++(classes[number - 1U].name == each.name ? own : other);
    }
    const double percent = 100.0 / static_cast<double>(each.pixels.size());
    text += fmt::format("# {}: {} pixels, {:.1f} % its own class, {:.1f} % another, {:.1f} % none\n", each.name,
                        each.pixels.size(), percent * static_cast<double>(own), percent * static_cast<double>(other),
                        percent * static_cast<double>(each.pixels.size() - own - other));
  }
  return text;
}

}  // namespace azimuth
