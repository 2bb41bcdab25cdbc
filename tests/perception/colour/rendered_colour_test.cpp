// Detections in the simulated lab and in a rendered office: missed landmarks, false detections and accuracy.

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>

#include "drivers/camera/jpeg.hpp"
#include "drivers/storage/run.hpp"
#include "settings/rig.hpp"
#include "slam/geometry/angle.hpp"
#include "slam/perception/colour/colour_perception.hpp"
#include "tests/sim/renderer/views.hpp"
#include "tests/support/data.hpp"
#include "tests/support/printed_choices.hpp"
#include "tests/support/printed_name.hpp"

namespace azimuth {
namespace {

struct Visible {
  Kind kind = 0;
  double azimuth_rad = 0.0, distance_m = 0.0;
};

/// Counts over several images. Each bearing is matched with the nearest true landmark of its kind.
class Score {
 public:
  static constexpr double kGate_rad = 0.03;

  void add(const std::vector<Visible>& there, const std::vector<bool>& in_sight, const std::vector<Bearing>& bearings) {
    std::vector<bool> found(there.size());
    for (const Bearing& bearing : bearings) match(there, bearing, found);
    for (std::size_t i = 0; i < there.size(); ++i) {
      in_sight_ += in_sight[i] ? 1 : 0;
      found_in_sight_ += in_sight[i] && found[i] ? 1 : 0;
    }
    ++images_;
  }

  double recall() const { return found_in_sight_ / static_cast<double>(in_sight_); }
  double false_per_image() const { return false_ / static_cast<double>(images_); }
  double rms_rad() const { return std::sqrt(squared_ / matched_); }
  double normalised_rms() const { return std::sqrt(normalised_ / matched_); }
  int in_sight() const { return in_sight_; }

 private:
  void match(const std::vector<Visible>& there, const Bearing& bearing, std::vector<bool>& found) {
    std::size_t best = there.size();
    double error_rad = kGate_rad;
    for (std::size_t i = 0; i < there.size(); ++i) {
      const double off_rad = std::abs(wrap(bearing.azimuth_rad - there[i].azimuth_rad));
      if (there[i].kind != bearing.kind || found[i] || off_rad >= error_rad) continue;
      best = i;
      error_rad = off_rad;
    }
    if (best == there.size()) {
      ++false_;
      return;
    }
    found[best] = true;
    ++matched_;
    squared_ += error_rad * error_rad;
    normalised_ += std::pow(error_rad / bearing.sigma_rad, 2);
  }

  int images_ = 0, in_sight_ = 0, found_in_sight_ = 0, false_ = 0, matched_ = 0;
  double squared_ = 0.0, normalised_ = 0.0;
};

constexpr double kCylinderRadius_m = 0.075;

Visible seen_from(const Pose2& T_world_body, const Eigen::Vector2d& p_world, Kind kind) {
  const Eigen::Vector2d p_body = inverse(T_world_body) * p_world;
  return {kind, std::atan2(p_body.y(), p_body.x()), p_body.norm()};
}

/// Whether no nearer landmark appears within some pixels of it.
bool is_clear(const Visible& landmark, const std::vector<Visible>& all) {
  return std::ranges::none_of(all, [&](const Visible& other) {
    const double apart_rad = std::abs(wrap(other.azimuth_rad - landmark.azimuth_rad));
    const double widths_rad = kCylinderRadius_m / other.distance_m + kCylinderRadius_m / landmark.distance_m;
    return other.distance_m < landmark.distance_m && apart_rad < widths_rad + 0.02;
  });
}

std::vector<bool> clear_within(const std::vector<Visible>& all, double distance_m) {
  std::vector<bool> clear;
  for (const Visible& each : all) clear.push_back(each.distance_m < distance_m && is_clear(each, all));
  return clear;
}

CameraRig rig_of(const RenderCamera& camera) {
  CameraRig rig{.model = RadialRig{}, .image = {}};
  if (!camera.model.is_level())
    rig.model = HyperbolicMirrorRig{.a_mm = 28.095, .b_mm = 23.4125, .focal_length_px = 1035.376};
  rig.roll_rad = camera.model.tilt().roll_rad;
  rig.pitch_rad = camera.model.tilt().pitch_rad;
  rig.image.width_px = camera.width_px;
  rig.image.height_px = camera.height_px;
  rig.image.centre_px = {camera.model.axes().centre_px.x(), camera.model.axes().centre_px.y()};
  rig.image.azimuth_offset_rad = camera.model.axes().azimuth_offset_rad;
  rig.image.mask_inner_px = camera.mask.inner_px;
  rig.image.mask_outer_px = camera.mask.outer_px;
  return rig;
}

std::vector<Visible> landmarks_of(const RenderScene& scene, const Pose2& T_world_body) {
  std::vector<Visible> landmarks;
  for (const RenderCylinder& cylinder : scene.cylinders) {
    const auto paint = std::ranges::find(kPaints, cylinder.paint);
    if (paint == kPaints.end()) continue;  // the stand of a landmark
    landmarks.push_back(seen_from(T_world_body, cylinder.p_world_m, static_cast<Kind>(paint - kPaints.begin())));
  }
  return landmarks;
}

class RenderedLab : public testing::TestWithParam<PixelFormat> {};
INSTANTIATE_TEST_SUITE_P(Formats, RenderedLab, testing::Values(PixelFormat::rgb8, PixelFormat::yuyv),
                         test::PrintedName());

Score score_of_lab(const CameraTilt& tilt, PixelFormat pixels) {
  Score score;
  for (const std::uint64_t seed : {1U, 2U}) {
    const Scenario scenario = lab(seed, 1);
    const RenderScene scene = coloured_scene(scenario);
    RenderCamera camera = test::mirror_camera();
    camera.model = CameraModel(camera.model.axes(), camera.model.profile(), tilt);
    camera.sensor = {2.0, 0.3, 376.0, seed};
    Renderer renderer(scene, camera);
    ColourPerception perception(rig_of(camera), {});
    BearingSet set;
    for (std::size_t i = 0; i < 8; ++i) {
      const Eigen::Vector2d& from = scenario.path[i % 4];
      const Eigen::Vector2d place = from + 0.4 * static_cast<double>(i / 4) * (scenario.path[i % 4 + 1] - from);
      const Pose2 T_world_body{place.x(), place.y(), 0.7 * static_cast<double>(i)};
      const auto bytes = test::frame_of(renderer, camera, T_world_body, pixels);
      perception.observe({packed_format(pixels, camera.width_px, camera.height_px), bytes}, set);
      const std::vector<Visible> there = landmarks_of(scene, T_world_body);
      score.add(there, clear_within(there, 5.0), set.bearings);
    }
  }
  return score;
}

void expect_good(const Score& score) {
  EXPECT_GT(score.in_sight(), 50);
  EXPECT_GT(score.recall(), 0.85);
  EXPECT_LT(score.false_per_image(), 0.7);
  EXPECT_LT(score.rms_rad(), 2e-3);
  EXPECT_LT(score.normalised_rms(), 2.0);
  EXPECT_GT(score.normalised_rms(), 0.2);
}

TEST_P(RenderedLab, CylindersAreFoundPostersAreNot) {
  const Score score = score_of_lab({}, GetParam());
  RecordProperty("recall", std::to_string(score.recall()));
  expect_good(score);
}

TEST_P(RenderedLab, AMirrorThatLeansSeesAsWell) {
  expect_good(score_of_lab({.roll_rad = 0.025, .pitch_rad = -0.025}, GetParam()));
  expect_good(score_of_lab({.roll_rad = -0.05, .pitch_rad = 0.08}, GetParam()));
}

Kind kind_named(const std::string& name) {
  const ColourSettings settings;
  const auto found = std::ranges::find(settings.classes, name, &ColourClass::name);
  return found == settings.classes.end() ? kAnyKind : static_cast<Kind>(found - settings.classes.begin());
}

/// The inner block of the office hides some distant landmarks; those within 2.5 m are never hidden.
TEST(RenderedOffice, LandmarksNearbyAreFoundPostersAreNot) {
  AZIMUTH_REQUIRE_DATA("office-a");
  const std::filesystem::path folder = test::data_folder() / "office-a";
  const FileResult<azimuth::Run> run = load_run(folder);
  ASSERT_TRUE(run);
  const FileResult<Rig> rig = read_rig_file(folder / "rig.toml");
  ASSERT_TRUE(rig);
  CameraRig camera = rig->camera;
  camera.image.centre_px = {511.5, 383.5};  // the renderer counts from pixel corners, Azimuth from pixel centres
  ColourPerception perception(camera, {});
  JpegDecoder decoder;
  BearingSet set;
  Score score;
  for (std::size_t i = 0; i < run->truth.size(); i += 20) {
    char name[32];
    std::snprintf(name, sizeof name, "%06zu.jpg", i);
    std::ifstream file(folder / "frames" / name, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    perception.observe(decoder.decode(std::as_bytes(std::span(bytes)), PixelFormat::rgb8), set);
    ASSERT_EQ(set.trouble, ImageTrouble::none) << name;
    std::vector<Visible> there;
    for (const auto& landmark : run->landmarks)
      there.push_back(seen_from(run->truth[i].T_world_body, Eigen::Vector2d(landmark.x_m, landmark.y_m),
                                kind_named(landmark.kind)));
    score.add(there, clear_within(there, 2.5), set.bearings);
  }
  EXPECT_GT(score.in_sight(), 20);
  EXPECT_GT(score.recall(), 0.85);
  EXPECT_LT(score.false_per_image(), 0.8);
  EXPECT_LT(score.rms_rad(), 3e-3);
  EXPECT_LT(score.normalised_rms(), 3.0);
}

}  // namespace
}  // namespace azimuth
