#include "tests/bench/sift_frames.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>

#include "drivers/camera/jpeg.hpp"
#include "drivers/storage/run.hpp"
#include "settings/rig.hpp"
#include "sim/renderer/renderer.hpp"
#include "sim/renderer/standard_cameras.hpp"

namespace azimuth {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kFrames = 120;
constexpr double kNearest_m = 0.3, kFarthest_m = 30.0, kConsistent_rad = 0.0175;

PosedFrame decoded(JpegDecoder& decoder, const std::filesystem::path& path, const Pose2& T_world_body) {
  std::ifstream file(path, std::ios::binary);
  const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
  const ImageView image = decoder.decode(std::as_bytes(std::span(bytes)), PixelFormat::gray8);
  return {T_world_body, image.format, {image.bytes.begin(), image.bytes.end()}};
}

std::optional<PosedDrive> office() {
  const char* const data = std::getenv("AZIMUTH_DATA");
  if (data == nullptr) return std::nullopt;
  const FileResult<Run> run = load_run(std::filesystem::path(data) / "office-a");
  if (!run) return std::nullopt;
  const FileResult<Rig> rig = read_rig(run->rig_toml, run->rig_file);
  if (!rig) return std::nullopt;
  PosedDrive drive{"office-a", rig->camera, {}};
  JpegDecoder decoder;
  for (std::size_t i = 0; i < std::min(kFrames, run->frames.size()); ++i) {
    const auto truth = std::ranges::find(run->truth, run->frames[i].stamp, &TruthPose::stamp);
    if (truth != run->truth.end())
      drive.frames.push_back(decoded(decoder, run->folder / run->frames[i].file, truth->T_world_body));
  }
  return drive;
}

PosedDrive rendered_lab() {
  PosedDrive drive{"rendered lab", *standard_camera("mirror"), {}};
  std::string problem;
  const RenderCamera camera = *render_camera_of(drive.rig, problem);
  Renderer renderer(coloured_scene(lab(1, 1)), camera);
  Pose2 T_world_body{2.5, 2.0, 0.0};
  for (std::size_t i = 0; i < kFrames; ++i) {
    const FrameFormat format = packed_format(PixelFormat::gray8, camera.width_px, camera.height_px);
    PosedFrame frame{T_world_body, format, std::vector<std::byte>(format.bytes())};
    renderer.render(T_world_body, {format, frame.bytes});
    drive.frames.push_back(std::move(frame));
    T_world_body = T_world_body * Pose2{0.2, 0.0, i % 40 < 25 ? 0.0 : 0.1};
  }
  return drive;
}

double angle_between(const Vector3d& a, const Vector3d& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

/// The smallest angle between `to` and the direction of any point along `from`, seen from the position `away`.
double inconsistency_rad(const Vector3d& from, const Vector3d& away, const Vector3d& to) {
  const auto off_at = [&](double distance_m) { return angle_between(distance_m * from - away, to); };
  double least = std::min(off_at(kNearest_m), off_at(kFarthest_m));
  const Vector3d normal = from.cross(away);
  const double denominator = from.cross(to).dot(normal);
  if (std::abs(denominator) < 1e-12) return least;
  const double distance_m = away.cross(to).dot(normal) / denominator;
  return distance_m > kNearest_m && distance_m < kFarthest_m ? std::min(least, off_at(distance_m)) : least;
}

/// Motion from the first robot's frame to the second's.
struct Step {
  explicit Step(const Pose2& T_first_second)
      : turn(Eigen::AngleAxisd(T_first_second.heading_rad, Vector3d::UnitZ())),
        away(T_first_second.x_m, T_first_second.y_m, 0.0) {}
  Eigen::AngleAxisd turn;
  Vector3d away;

  bool consistent(const Vector3d& first, const Vector3d& second) const {
    return inconsistency_rad(first, away, turn * second) < kConsistent_rad;
  }
};

int squared_distance(const Descriptor& a, const Descriptor& b) {
  int sum = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    const int off = int{a.values[i]} - int{b.values[i]};
    sum += off * off;
  }
  return sum;
}

std::optional<std::size_t> match(const Descriptor& looks, const std::vector<Descriptor>& others, double ratio) {
  int nearest = std::numeric_limits<int>::max(), second = nearest;
  std::size_t best = 0;
  for (std::size_t j = 0; j < others.size(); ++j) {
    const int away = squared_distance(looks, others[j]);
    if (away < nearest) best = j;
    second = std::min(second, std::max(away, nearest));
    nearest = std::min(nearest, away);
  }
  return nearest < ratio * ratio * second ? std::optional(best) : std::nullopt;
}

}  // namespace

const PosedDrive& bench_drive() {
  static const PosedDrive drive = [] {
    std::optional<PosedDrive> recorded = office();
    return recorded ? std::move(*recorded) : rendered_lab();
  }();
  return drive;
}

Repeated find_again(const PosedDrive& drive, const std::vector<SeenRays>& seen, std::size_t later, double ratio) {
  double features = 0.0, matches = 0.0, right = 0.0;
  for (std::size_t k = 0; k + later < seen.size(); ++k) {
    const SeenRays &first = seen[k], &second = seen[k + later];
    const Step step(inverse(drive.frames[k].T_world_body) * drive.frames[k + later].T_world_body);
    features += static_cast<double>(first.rays.size());
    for (std::size_t i = 0; i < first.rays.size(); ++i) {
      const auto j = match(first.looks[i], second.looks, ratio);
      if (!j) continue;
      ++matches;
      if (step.consistent(first.rays[i], second.rays[*j])) ++right;
    }
  }
  return {right / features, (matches - right) / std::max(1.0, matches),
          features / static_cast<double>(seen.size() - later)};
}

}  // namespace azimuth
