// Real light shapes: ceiling tubes seen from a moving car through a tilted fisheye, thresholded.
//
// AZIMUTH_PICTURES=FOLDER writes FOLDER/ceiling-tubes.jpg: the last image, its spots and their tracks.

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <numeric>
#include <optional>

#include "drivers/camera/jpeg.hpp"
#include "drivers/camera/run_images.hpp"
#include "drivers/picture/canvas.hpp"
#include "slam/perception/lamps/lamp_finder.hpp"
#include "tests/perception/lamps/ceiling_motion.hpp"
#include "tests/perception/lamps/gray_pictures.hpp"
#include "tests/support/data.hpp"

namespace azimuth {
namespace {

constexpr int kImages = 100, kWidth_px = 640, kHeight_px = 480;
constexpr double kNearBorder_px = 12.0;  // the next image may cut a spot this near to the border
constexpr double kLost_px = 1e3;         // distance that is reported for a spot that is not found again

VisibleRows ceiling_pixels(const test::TiltedFisheye& camera) {
  std::vector<std::uint8_t> visible;
  for (int v = 0; v < kHeight_px; ++v)
    for (int u = 0; u < kWidth_px; ++u) visible.push_back(camera.ceiling({u, v}) ? 255 : 0);
  return {visible, kWidth_px, kHeight_px};
}

bool stays_in_view(const test::TiltedFisheye& camera, const Pixel& pixel) {
  const auto seen = [&](double u, double v) {
    return u >= 0.0 && v >= 0.0 && u < kWidth_px && v < kHeight_px && camera.ceiling({u, v});
  };
  return seen(pixel.x() - kNearBorder_px, pixel.y()) && seen(pixel.x() + kNearBorder_px, pixel.y()) &&
         seen(pixel.x(), pixel.y() - kNearBorder_px) && seen(pixel.x(), pixel.y() + kNearBorder_px);
}

/// The spots of one image, and the number of the track that each belongs to.
struct Spots {
  std::vector<Pixel> pixels;
  std::vector<std::size_t> tracks;
};

/// Tracks of the spots, and their distances from the positions that the ceiling's motion predicts.
class Tracks {
 public:
  void add(std::vector<Pixel> pixels) {
    Spots now{std::move(pixels), {}};
    now.tracks.assign(now.pixels.size(), kNew);
    if (!spots_.pixels.empty()) follow(now);
    for (std::size_t k = 0; k < now.pixels.size(); ++k) {
      if (now.tracks[k] == kNew) {
        now.tracks[k] = ways_.size();
        ways_.emplace_back();
      }
      ways_[now.tracks[k]].push_back(now.pixels[k]);
    }
    spots_ = std::move(now);
  }

  /// Distance from the predicted position for each spot that should reappear; kLost_px if it does not.
  std::vector<double> jitter_px() const { return jitter_px_; }
  const std::vector<std::vector<Pixel>>& ways() const { return ways_; }
  const Spots& last() const { return spots_; }

 private:
  static constexpr std::size_t kNew = static_cast<std::size_t>(-1);

  void follow(Spots& now) {
    const test::CeilingMotion motion = test::fit_motion(camera_, spots_.pixels, now.pixels, T_last_);
    T_last_ = motion.T_after_before;
    std::vector<std::size_t> found(spots_.pixels.size(), kNew);
    for (const test::SpotPair& pair : motion.pairs) {
      found[pair.before] = pair.after;
      now.tracks[pair.after] = spots_.tracks[pair.before];
    }
    for (std::size_t k = 0; k < found.size(); ++k) {
      const auto there = test::moved(camera_, spots_.pixels[k], T_last_);
      if (!there || !stays_in_view(camera_, *there)) continue;
      jitter_px_.push_back(found[k] == kNew ? kLost_px : (now.pixels[found[k]] - *there).norm());
    }
  }

  test::TiltedFisheye camera_;
  Pose2 T_last_;
  Spots spots_;
  std::vector<std::vector<Pixel>> ways_;
  std::vector<double> jitter_px_;
};

double quantile(std::vector<double> values, double share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size()));
  std::ranges::nth_element(values, at);
  return *at;
}

Run images_of_tubes() {
  Run run;
  run.folder = test::data_folder() / "ceiling-tubes";
  for (int k = 0; k < kImages; ++k) run.frames.push_back({stamp_from_us(k), fmt::format("{:06}.png", k)});
  return run;
}

void draw(const ImageView& image, const Tracks& tracks, const std::filesystem::path& file) {
  constexpr PictureColour kSpot{255, 60, 60}, kWays[] = {{80, 220, 255}, {255, 210, 80}, {120, 255, 140}};
  Canvas canvas;
  canvas.begin(kWidth_px, kHeight_px);
  for (int v = 0; v < kHeight_px; ++v)
    for (int u = 0; u < kWidth_px; ++u) canvas.image().at<cv::Vec3b>(v, u) = cv::Vec3b::all(image.row(v)[u] / 2);
  for (std::size_t k = 0; k < tracks.ways().size(); ++k)
    if (tracks.ways()[k].size() > 1) canvas.polyline(tracks.ways()[k], false, kWays[k % std::size(kWays)]);
  for (const Pixel& spot : tracks.last().pixels) canvas.circle(spot, 5.0, kSpot);
  canvas.caption(0,
                 fmt::format("{} spots now, {:.2f} px of jitter in the median", tracks.last().pixels.size(),
                             quantile(tracks.jitter_px(), 0.5)),
                 {255, 255, 255});
  const cv::Mat& picture = canvas.picture();
  const FrameFormat format = packed_format(PixelFormat::rgb8, picture.cols, picture.rows);
  JpegEncoder encoder;
  const auto jpeg = encoder.encode({format, std::as_bytes(std::span(picture.data, format.bytes()))}, 92);
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(jpeg.data()), static_cast<std::streamsize>(jpeg.size()));
}

/// Measures the stability of the spots. For each pair of consecutive images one motion of the ceiling, with three
/// degrees of freedom, is fitted to all spots through the camera's calibration. The jitter is the distance of a spot
/// from the motion's prediction. It contains the noise of two centroids and the errors of calibration and floor.
TEST(CeilingTubes, SpotsAreStableFromImageToImage) {
  AZIMUTH_REQUIRE_DATA("ceiling-tubes");
  const azimuth::Run run = images_of_tubes();
  RunImages images(run);
  const VisibleRows visible = ceiling_pixels({});
  LampFinder finder({});
  Tracks tracks;
  std::vector<LampBlob> blobs;
  ImageView image;
  for (std::size_t k = 0; k < images.count(); ++k) {
    image = images.pixels(k, PixelFormat::gray8);
    ASSERT_TRUE(image.readable()) << images.problem();
    finder.find({image.row(0), image.format.stride_bytes, kWidth_px, kHeight_px}, visible, blobs);
    std::vector<Pixel> pixels;
    for (const LampBlob& blob : blobs) pixels.push_back(blob.centroid);
    tracks.add(std::move(pixels));
  }
  const std::vector<double> jitter_px = tracks.jitter_px();
  const auto lost = std::ranges::count(jitter_px, kLost_px);
  fmt::print("{} steps of spots: jitter {:.3f} px in the median, {:.3f} px for 75%, {:.3f} px for 90%; {} lost\n",
             jitter_px.size(), quantile(jitter_px, 0.5), quantile(jitter_px, 0.75), quantile(jitter_px, 0.9), lost);
  if (const char* const folder = std::getenv("AZIMUTH_PICTURES"))
    draw(image, tracks, std::filesystem::path(folder) / "ceiling-tubes.jpg");
  EXPECT_GT(jitter_px.size(), 8u * kImages) << "hardly anything was looked at";
  EXPECT_LE(quantile(jitter_px, 0.5), 0.5);
  EXPECT_LE(quantile(jitter_px, 0.9), 2.0);
}

/// Tests the measure itself: spots that are displaced by a known amount must give this jitter.
TEST(CeilingTubes, JitterIsWhatItIsSaidToBe) {
  constexpr double kShaken_px = 0.6;
  const test::TiltedFisheye camera;
  Tracks tracks;
  unsigned turn = 0;
  for (int image = 0; image < 20; ++image) {
    std::vector<Pixel> pixels;
    for (int i = -4; i <= 4; ++i)
      for (int j = -3; j <= 3; ++j) {
        const Eigen::Vector2d point =
            Pose2{0.02 * image, 0.01 * image, 0.005 * image} * Eigen::Vector2d(0.6 * i, 0.5 * j);
        const Pixel pixel = camera.pixel(point);
        if (!camera.ceiling(pixel)) continue;
        turn = turn * 1664525U + 1013904223U;
        const double angle_rad = 2.0 * kPi * (turn >> 8U) / (1U << 24U);
        pixels.push_back(pixel + kShaken_px * Pixel(std::cos(angle_rad), std::sin(angle_rad)));
      }
    tracks.add(std::move(pixels));
  }
  // The median distance of two random points on a circle of this radius is sqrt(2) times the radius.
  EXPECT_NEAR(quantile(tracks.jitter_px(), 0.5), std::sqrt(2.0) * kShaken_px, 0.08);
}

}  // namespace
}  // namespace azimuth
