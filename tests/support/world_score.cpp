#include "tests/support/world_score.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "settings/configured_estimator.hpp"
#include "settings/rig.hpp"
#include "tools/replay/replay.hpp"
#include "tools/replay/replay_record.hpp"

namespace azimuth {

WorldScore score_without_names(const Run& run, const Configuration& configuration) {
  Rig rig = read_rig(run.rig_toml, run.rig_file).value();
  rig.camera.identities = false;
  const ReplayResult result = replay(run, rig, configured_estimator(rig, configuration), configuration.stage);
  const ReplayRecord record =
      replay_record(run, rig, std::string(name(chosen_estimator(rig, configuration))), 0, result);
  WorldScore score{evaluate(record), {}};
  std::vector<StampedPose> estimated;
  for (const EstimateRecord& estimate : result.estimates) estimated.push_back({estimate.stamp, estimate.T_map_body});
  for (const RelativeError& error : relative_errors(pair_with_truth(estimated, record.truth), result.estimates))
    if (const std::optional<TwoSigmaShare> share = two_sigma_share(error))
      score.images.push_back({*share, result.healths[error.index].health == Health::tracking});
  return score;
}

std::vector<double> two_sigma_shares(std::span<const WorldScore> worlds, SigmaMeasure measure, bool tracking_only) {
  std::vector<double> shares;
  for (const WorldScore& world : worlds)
    for (const ImageScore& image : world.images)
      if (image.tracking || !tracking_only)
        shares.push_back(measure == SigmaMeasure::ellipse ? image.share.of_ellipse : image.share.of_direction);
  std::sort(shares.begin(), shares.end());
  return shares;
}

double share_within(std::span<const double> sorted, double limit) {
  if (sorted.empty()) return kNotMeasured;
  const auto within = std::upper_bound(sorted.begin(), sorted.end(), limit) - sorted.begin();
  return static_cast<double>(within) / static_cast<double>(sorted.size());
}

double quantile(std::span<const double> sorted, double share) {
  if (sorted.empty()) return kNotMeasured;
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(sorted.size())));
  return sorted[std::clamp<std::size_t>(rank, 1, sorted.size()) - 1];
}

}  // namespace azimuth
