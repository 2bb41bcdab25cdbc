#include "slam/perception/lamps/lamp_blobs.hpp"

#include <gtest/gtest.h>
#include <random>

#include "tests/perception/lamps/gray_pictures.hpp"

namespace azimuth {
namespace {

constexpr int kThreshold = 100;

std::vector<PixelRun> runs_in(const test::GrayPicture& picture) {
  std::vector<PixelRun> runs, row(static_cast<std::size_t>(picture.width_px));
  for (int v = 0; v < picture.height_px; ++v) {
    const std::size_t count =
        bright_runs(picture.view().row(v), {v, 0, picture.width_px}, kThreshold, row.data(), row.size());
    runs.insert(runs.end(), row.begin(), row.begin() + static_cast<std::ptrdiff_t>(count));
  }
  return runs;
}

/// Blob number of each pixel by flood fill, in the order of the blobs' first pixels; 0: no blob.
std::vector<int> flooded(test::GrayPicture picture) {
  std::vector<int> numbers(picture.pixels.size(), 0);
  int count = 0;
  const auto index = [&](int u, int v) { return static_cast<std::size_t>(v * picture.width_px + u); };
  for (int v = 0; v < picture.height_px; ++v) {
    for (int u = 0; u < picture.width_px; ++u) {
      if (picture.at(u, v) < kThreshold || numbers[index(u, v)] != 0) continue;
      std::vector<std::pair<int, int>> open{{u, v}};
      numbers[index(u, v)] = ++count;
      while (!open.empty()) {
        const auto [x, y] = open.back();
        open.pop_back();
        for (int k = 0; k < 9; ++k) {
          const int nx = x + k % 3 - 1, ny = y + k / 3 - 1;
          if (nx < 0 || ny < 0 || nx >= picture.width_px || ny >= picture.height_px) continue;
          if (picture.at(nx, ny) < kThreshold || numbers[index(nx, ny)] != 0) continue;
          numbers[index(nx, ny)] = count;
          open.emplace_back(nx, ny);
        }
      }
    }
  }
  return numbers;
}

/// The blob's properties by definition, in floating point.
LampBlob blob_of(test::GrayPicture picture, const std::vector<int>& numbers, int number) {
  LampBlob blob;
  const auto each = [&](auto&& use) {
    for (int v = 0; v < picture.height_px; ++v)
      for (int u = 0; u < picture.width_px; ++u)
        if (numbers[static_cast<std::size_t>(v * picture.width_px + u)] == number) use(Pixel(u, v), picture.at(u, v));
  };
  each([&](const Pixel& pixel, int value) {
    ++blob.area_px;
    blob.peak = std::max(blob.peak, value);
    blob.weight += value - kThreshold + 1;
    blob.centroid += (value - kThreshold + 1) * pixel;
  });
  blob.centroid /= blob.weight;
  each([&](const Pixel& pixel, int value) {
    const Pixel away = pixel - blob.centroid;
    blob.spread_px2 += (value - kThreshold + 1) / blob.weight * away * away.transpose();
  });
  blob.spread_px2 += Eigen::Matrix2d::Identity() / 12.0;
  return blob;
}

TEST(LampBlobs, AreThoseOfFloodingWithTheirMoments) {
  std::mt19937 engine(2);
  LampBlobs blobs;
  for (const double density : {0.05, 0.2, 0.4, 0.6, 0.9}) {
    test::GrayPicture picture(61, 43);
    std::bernoulli_distribution is_bright(density);
    std::uniform_int_distribution<int> value(kThreshold, 255);
    for (std::uint8_t& pixel : picture.pixels)
      pixel = static_cast<std::uint8_t>(is_bright(engine) ? value(engine) : 99);
    const std::vector<PixelRun> runs = runs_in(picture);
    blobs.group(picture.view(), runs, kThreshold);
    const std::vector<int> numbers = flooded(picture);
    ASSERT_EQ(static_cast<int>(blobs.all().size()), *std::ranges::max_element(numbers));
    std::vector<PixelRun> own;
    for (std::size_t k = 0; k < blobs.all().size(); ++k) {
      const LampBlob& found = blobs.all()[k];
      const LampBlob wanted = blob_of(picture, numbers, static_cast<int>(k) + 1);
      EXPECT_EQ(found.area_px, wanted.area_px);
      EXPECT_EQ(found.peak, wanted.peak);
      EXPECT_EQ(found.weight, wanted.weight);
      EXPECT_LT((found.centroid - wanted.centroid).norm(), 1e-9);
      EXPECT_LT((found.spread_px2 - wanted.spread_px2).norm(), 1e-8);
      blobs.runs_of(k, own);
      int area_px = 0;
      for (const PixelRun& run : own) area_px += run.last - run.first;
      EXPECT_EQ(area_px, found.area_px);
    }
  }
}

TEST(LampBlobs, NothingBrightIsNoBlob) {
  LampBlobs blobs;
  blobs.group(test::GrayPicture(5, 5).view(), {}, kThreshold);
  EXPECT_TRUE(blobs.all().empty());
}

LampBlob only_blob(const test::GrayPicture& picture) {
  LampBlobs blobs;
  const std::vector<PixelRun> runs = runs_in(picture);
  blobs.group(picture.view(), runs, kThreshold);
  EXPECT_EQ(blobs.all().size(), 1U);
  return blobs.all().at(0);
}

TEST(LampBlobs, FillTellsConvexShapesFromJoinedOnes) {
  for (double turn_rad = 0.0; turn_rad < 3.0; turn_rad += 0.37) {
    test::GrayPicture bar(80, 80), joined(80, 80);
    bar.rectangle(40.3, 39.8, 40, 8, turn_rad, 255);
    EXPECT_GT(only_blob(bar).fill(), 0.9);
    const double away_u = 20 * std::cos(turn_rad), away_v = 20 * std::sin(turn_rad);
    joined.rectangle(40 - away_u, 40 - away_v, 10, 10, turn_rad, 255);
    joined.rectangle(40 + away_u, 40 + away_v, 10, 10, turn_rad, 255);
    joined.rectangle(40, 40, 40, 2, turn_rad, 255);
    EXPECT_LT(only_blob(joined).fill(), 0.6);
  }
}

TEST(LampBlobs, RectanglesComeBack) {
  for (double turn_rad = 0.0; turn_rad < 3.0; turn_rad += 0.37) {
    test::GrayPicture bar(80, 80);
    bar.rectangle(40.3, 39.8, 40, 8, turn_rad, 255);
    const LampBlob::Rectangle found = only_blob(bar).rectangle();
    EXPECT_NEAR(found.length_px, 40.0, 0.5);
    EXPECT_NEAR(found.thickness_px, 8.0, 0.5);
    EXPECT_NEAR(std::abs(found.along.dot(Eigen::Vector2d(std::cos(turn_rad), std::sin(turn_rad)))), 1.0, 1e-3);
  }
}

TEST(LampBlobs, CentroidFollowsAShapeByPartsOfAPixel) {
  for (double shift = 0.0; shift < 1.0; shift += 0.1) {
    test::GrayPicture picture(60, 40);
    picture.rectangle(30 + shift, 20 - 0.5 * shift, 14.4, 5.7, 0.3, 255);
    EXPECT_LT((only_blob(picture).centroid - Pixel(30 + shift, 20 - 0.5 * shift)).norm(), 0.03);
  }
}

}  // namespace
}  // namespace azimuth
