#include "slam/ceiling/lamp_matcher.hpp"

#include <algorithm>
#include <limits>

#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

/// nu^T S^-1 nu; infinite if the direction cannot be compared with the lamp.
double squared_distance(const MeasuredDirection& measured, const PredictedDirection& predicted) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const auto residual = measured.seen.against(predicted.offset.m);
  if (!residual) return kNever;
  const Eigen::Matrix2d& D = residual->by_offset;
  Eigen::Matrix2d S = D * predicted.covariance * D.transpose();
  S.diagonal() += measured.seen.variance();
  const Eigen::Vector2d& nu = residual->innovation;
  const double determinant = S(0, 0) * S(1, 1) - S(0, 1) * S(1, 0);
  const double scaled = S(1, 1) * nu.x() * nu.x() - 2.0 * S(0, 1) * nu.x() * nu.y() + S(0, 0) * nu.y() * nu.y();
  return determinant > 0.0 ? scaled / determinant : kNever;
}

}  // namespace

LampMatcher::LampMatcher(const LampEkfSettings& settings, const CeilingView& view)
    : settings_(settings), in_view_sr_(view.solid_angle_sr()) {
  gates_.individual_chi2 = settings.gates.chi2;
  gates_.joint_probability = settings.gates.joint_probability;
  gates_.rival_log_ratio = settings.gates.rival_log_ratio;
  matches_.predicted.reserve(kTypicalLandmarks);
  matches_.near.reserve(kTypicalLandmarks);
  matches_.of.reserve(kTypicalLandmarks);
  near_offsets_.reserve(kTypicalLandmarks);
  near_identities_.reserve(kTypicalLandmarks);
}

const LampMatches& LampMatcher::match(CeilingImage& image, std::span<const Lamp> lamps, const LampEkf& ekf) {
  predict(lamps, ekf);
  thin(image, lamps);
  find_near(image, lamps);
  const auto& near = matches_.near;
  const auto size = 2 * as_index(near.size());
  auto covariance = near_covariance_.matrix(size, size);
  for (std::size_t r = 0; r < near.size(); ++r)
    for (std::size_t c = 0; c <= r; ++c) {
      const PredictedDirection &a = matches_.predicted[near[r]], &b = matches_.predicted[near[c]];
      const Eigen::Matrix2d block = r == c ? a.covariance : ekf.covariance(a.offset, b.offset);
      const Index row = 2 * as_index(r), column = 2 * as_index(c);
      covariance.block<2, 2>(row, column) = block;
      covariance.block<2, 2>(column, row) = block.transpose();
    }
  matching_.match(image.measured, {near_offsets_, covariance, near_identities_}, gates_, matches_.of);
  return matches_;
}

void LampMatcher::predict(std::span<const Lamp> lamps, const LampEkf& ekf) {
  matches_.predicted.clear();
  for (std::size_t i = 0; i < lamps.size(); ++i)
    if (const auto offset = ekf.predict(lamps[i].at))
      matches_.predicted.push_back({i, *offset, ekf.covariance(*offset, *offset)});
}

/// Shortens a crowded image to the directions nearest to confirmed lamps, in their original order. The density of new
/// directions is raised, since chance matches are more likely in a crowded image.
void LampMatcher::thin(CeilingImage& image, std::span<const Lamp> lamps) {
  const auto room = as_size(settings_.max_directions);
  image.lights = image.measured.size();
  image.crowded = image.lights > room;
  gates_.new_density_per_sr = settings_.gates.new_density_per_sr;
  matches_.left_out = 0;
  if (!image.crowded) return;
  gates_.new_density_per_sr = std::max(gates_.new_density_per_sr, static_cast<double>(image.lights) / in_view_sr_);
  rank_by_confirmed(image, lamps);
  ranked_.resize(std::min(ranked_.size(), room));
  std::ranges::sort(ranked_, {}, &Ranked::direction);
  for (std::size_t k = 0; k < ranked_.size(); ++k) image.move(ranked_[k].direction, k);
  image.shorten(ranked_.size());
  matches_.left_out = image.lights - ranked_.size();
}

/// Ranks the directions in the gate of a confirmed lamp, the nearest first.
void LampMatcher::rank_by_confirmed(const CeilingImage& image, std::span<const Lamp> lamps) {
  ranked_.clear();
  for (std::size_t i = 0; i < image.measured.size(); ++i) {
    double nearest2 = settings_.gates.chi2;
    for (const PredictedDirection& predicted : matches_.predicted)
      if (lamps[predicted.lamp].confirmed)
        nearest2 = std::min(nearest2, squared_distance(image.measured[i], predicted));
    if (nearest2 < settings_.gates.chi2) ranked_.push_back({nearest2, i});
  }
  std::ranges::sort(ranked_, [](const Ranked& a, const Ranked& b) {
    return a.distance2 != b.distance2 ? a.distance2 < b.distance2 : a.direction < b.direction;
  });
}

/// Selects the lamps in the gate of some direction. In a crowded image only confirmed lamps are selected: a lamp on
/// probation would find some direction that fits by chance.
void LampMatcher::find_near(const CeilingImage& image, std::span<const Lamp> lamps) {
  matches_.near.clear();
  near_offsets_.clear();
  near_identities_.clear();
  for (std::size_t k = 0; k < matches_.predicted.size(); ++k) {
    const PredictedDirection& predicted = matches_.predicted[k];
    const Lamp& lamp = lamps[predicted.lamp];
    if ((image.crowded && !lamp.confirmed) || !is_near_a_direction(predicted, image)) continue;
    matches_.near.push_back(k);
    near_offsets_.push_back(predicted.offset.m);
    near_identities_.push_back(lamp.identity);
  }
}

bool LampMatcher::is_near_a_direction(const PredictedDirection& predicted, const CeilingImage& image) const {
  return std::ranges::any_of(image.measured, [&](const MeasuredDirection& measured) {
    return squared_distance(measured, predicted) < settings_.gates.chi2;
  });
}

}  // namespace azimuth
