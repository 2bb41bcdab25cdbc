#include <cmath>
#include <gtest/gtest.h>
#include <numeric>

#include "slam/perception/sift/own_sift.hpp"
#include "tests/perception/sift/pictures.hpp"

namespace azimuth {
namespace {

using test::Blob;

double distance(const Descriptor& a, const Descriptor& b) {
  double squares = 0.0;
  for (std::size_t i = 0; i < a.values.size(); ++i) squares += std::pow(a.values[i] - b.values[i], 2);
  return std::sqrt(squares);
}

/// Blobs around (x, y), rotated and scaled.
std::vector<Blob> constellation(double x_px, double y_px, double turn_rad, double scale, double gain = 1.0) {
  std::vector<Blob> blobs;
  Random random(7, RandomPurpose::scene);
  for (int i = 0; i < 14; ++i) {
    const double away_px = scale * random.uniform(0.0, 26.0), angle_rad = turn_rad + random.uniform(0.0, 6.28);
    blobs.push_back({x_px + away_px * std::cos(angle_rad), y_px + away_px * std::sin(angle_rad),
                     scale * random.uniform(2.5, 5.0), gain * random.uniform(-50.0, 50.0)});
  }
  return blobs;
}

KeyPoint key_point(double x_px, double y_px, double sigma_px, int octave, int layer) {
  return {.x_px = static_cast<float>(x_px),
          .y_px = static_cast<float>(y_px),
          .sigma_px = static_cast<float>(sigma_px),
          .octave = octave,
          .layer = layer};
}

Descriptor described(const std::vector<Blob>& blobs, const KeyPoint& point, double axis_rad) {
  ScaleSpace space({});
  space.build(test::picture(240, blobs));
  return DescriptorMaker({}).describe(space, point,
                                      {static_cast<float>(std::cos(axis_rad)), static_cast<float>(std::sin(axis_rad))});
}

TEST(Descriptor, HasTheLengthOf512) {
  const Descriptor descriptor = described(constellation(120, 120, 0.0, 1.0), key_point(120, 120, 3.2, 0, 3), 0.0);
  EXPECT_NEAR(distance(descriptor, {}), 512.0, 8.0);
  EXPECT_LT(*std::ranges::max_element(descriptor.values), 200) << "clipped at 0.2, then made longer again";
}

TEST(Descriptor, TurnsWithItsFrame) {
  const KeyPoint point = key_point(120, 120, 3.2, 0, 3);
  const Descriptor upright = described(constellation(120, 120, 0.0, 1.0), point, 0.0);
  for (double turn_rad = 0.1; turn_rad < 6.2; turn_rad += 0.37) {
    const std::vector<Blob> turned = constellation(120, 120, turn_rad, 1.0);
    EXPECT_LT(distance(upright, described(turned, point, turn_rad)), 25.0) << turn_rad;
    if (turn_rad > 0.4 && turn_rad < 5.9) {
      EXPECT_GT(distance(upright, described(turned, point, 0.0)), 200.0) << turn_rad << ": the axes of the image";
    }
  }
}

TEST(Descriptor, GrowsWithItsScale) {
  const Descriptor small = described(constellation(120, 120, 0.0, 1.0), key_point(120, 120, 3.2, 0, 3), 0.0);
  const Descriptor large = described(constellation(120, 120, 0.0, 2.0), key_point(120, 120, 6.4, 1, 3), 0.0);
  EXPECT_LT(distance(small, large), 40.0);
}

TEST(Descriptor, MovesWithinAPixel) {
  const Descriptor here = described(constellation(120, 120, 0.0, 1.0), key_point(120, 120, 3.2, 0, 3), 0.0);
  const Descriptor there = described(constellation(120.5, 119.7, 0.0, 1.0), key_point(120.5, 119.7, 3.2, 0, 3), 0.0);
  EXPECT_LT(distance(here, there), 10.0);
}

TEST(Descriptor, LightDoesNotMatter) {
  const KeyPoint point = key_point(120, 120, 3.2, 0, 3);
  const Descriptor bright = described(constellation(120, 120, 0.0, 1.0), point, 0.0);
  const Descriptor dim = described(constellation(120, 120, 0.0, 1.0, 0.3), point, 0.0);
  EXPECT_LT(distance(bright, dim), 10.0);
}

/// A slope has one gradient direction. The descriptor counts it in eighths of a turn from the frame's axis and shares
/// directions in between among the neighbours.
TEST(Descriptor, NamesDirectionsFromItsAxis) {
  Plane<std::uint16_t> image(128, 128);
  SiftSettings settings;
  settings.clip = 1.0;
  for (const double slope_rad : {0.0, 0.4, 1.9, 3.5, 5.9}) {
    for (int y = 0; y < 128; ++y) {
      for (int x = 0; x < 128; ++x) {
        const double along = (x - 64) * std::cos(slope_rad) + (y - 64) * std::sin(slope_rad);
        image.at(x, y) = static_cast<std::uint16_t>(32000.0 + 150.0 * along);
      }
    }
    ScaleSpace space({});
    space.build(image);
    const Descriptor descriptor = DescriptorMaker(settings).describe(space, key_point(64, 64, 2.5, 0, 2), {});
    const double eighths = slope_rad / (kPi / 4.0);
    const auto here = static_cast<std::size_t>(eighths) % 8, next = (here + 1) % 8;
    for (std::size_t i = 0; i < descriptor.values.size(); ++i) {
      if (i % 8 == here || i % 8 == next) continue;
      EXPECT_LE(descriptor.values[i], 2) << slope_rad << " " << i;
    }
    const double share = eighths - std::floor(eighths);
    EXPECT_NEAR(descriptor.values[40 + next] / (1.0 * descriptor.values[40 + next] + descriptor.values[40 + here]),
                share, 0.02);
  }
}

TEST(Descriptor, OfNothingIsNothing) { EXPECT_EQ(described({}, key_point(120, 120, 3.2, 0, 3), 0.0), Descriptor{}); }

TEST(Descriptor, NothingBreaksAtTheEdge) {
  Random random(3, RandomPurpose::scene);
  ScaleSpace space({});
  space.build(test::noise(60, random));
  DescriptorMaker maker({});
  for (const double place : {-5.0, 0.0, 0.5, 59.0, 64.0})
    for (int octave = 0; octave < space.octaves(); ++octave)
      EXPECT_NEAR(distance(maker.describe(space, key_point(place, place, 3 << octave, octave, 1), {0.6F, 0.8F}), {}),
                  512.0, 200.0);
}

}  // namespace
}  // namespace azimuth
