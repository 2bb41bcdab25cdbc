#include "slam/lost/seen_again.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "slam/estimator/estimate.hpp"
#include "slam/geometry/index.hpp"
#include "slam/lost/lost_robot.hpp"

namespace azimuth {
namespace {

constexpr double kNearest_m = 0.125;  // distance driven; each bin reaches twice as far as the bin before
constexpr unsigned kOften = 8;        // seen this often: well known; missed this often: out of sight
constexpr double kInSight = 0.9;      // share of the visible landmarks that a usual image shows
constexpr double kFirstCounts = 2.0;  // weight of the initial probabilities, in landmarks
constexpr double kFirstImages = 4.0;  // weight of the initial levels, in images
constexpr double kOfAnImage = 0.05;   // weight of one image in running averages
constexpr double kMostLikely = 0.98, kMostByAccident = 0.5;
/// Possible levels: the share of the expected landmarks that an image shows; 1 is usual.
constexpr std::array<double, 8> kLevels_{0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 1.0, 1.15};

/// Numbers of recent images that are ignored when an image is evaluated; the last one reaches back some metres of
/// driving.
constexpr std::array<std::size_t, 10> kReferences{0, 1, 2, 3, 4, 6, 8, 12, 16, 24};

double sum(const auto& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

}  // namespace

SeenAgain::SeenAgain() {
  static_assert(kLevels_.size() == kLevels && 8 * sizeof(History) == kImages);
  experience_.stayed = 1.0;
  experience_.followed = 2.0;
  experience_.occurred.fill(kFirstImages / kLevels);
  belief_.fill(1.0 / kLevels);
  for (std::size_t at = 0; at < experience_.counts.size(); ++at) {
    const std::size_t far = at % kDistanceBins, missed = at / kDistanceBins % kMissBins;
    const double thought = std::exp2(-1.0 - static_cast<double>(missed) - kNearest_m * std::exp2(far));
    experience_.counts[at] = {kFirstCounts * thought, kFirstCounts};
  }
  due_.reserve(kTypicalLandmarks);
  seen_lately_.reserve(kTypicalLandmarks);
}

SeenAgain::Experience& SeenAgain::Experience::operator+=(const Experience& more) {
  for (std::size_t at = 0; at < counts.size(); ++at) {
    counts[at].seen += more.counts[at].seen;
    counts[at].due += more.counts[at].due;
  }
  for (std::size_t level = 0; level < kLevels; ++level) occurred[level] += more.occurred[level];
  stayed += more.stayed;
  followed += more.followed;
  return *this;
}

double SeenAgain::weigh(std::span<const Look> looks, double path_m, int bearings) {
  if (kept_ > 0 && path_m - image(0).path_m > kMoment_m) forget_images();
  prepare(looks, path_m, bearings);
  is_weighed_ = bearings > 0 && !looks.empty();
  if (is_weighed_ && kept_ > 0) return ln_elsewhere() - follow(ln_here());
  expected_ = 0.0;
  return 0.0;
}

void SeenAgain::prepare(std::span<const Look> looks, double path_m, int bearings) {
  path_m_ = path_m;
  bearings_ = bearings;
  expected_ = 0.0;
  due_.clear();
  // An image that shows less of everything also shows fewer known landmarks.
  fullness_ = usual_bearings_ > 0.0 ? std::min(1.0, bearings / usual_bearings_) : 1.0;
  // At another place of the map as many of its landmarks would be seen, but arbitrary ones in arbitrary directions.
  const double any = std::min(1.0, (usual_seen_ + 1.0) / static_cast<double>(std::max<std::size_t>(looks.size(), 1)));
  for (const Look& look : looks) {
    const History history = history_of(look.landmark_id);
    const Count& count = experience_.counts[bin(look.sightings, history, 0, path_m)];
    const double here = fullness_ * count.seen / count.due;
    expected_ += here;
    due_.push_back(
        {look.landmark_id, look.sightings, history, look.seen, here, std::min(kMostByAccident, any * look.room)});
  }
}

SeenAgain::History SeenAgain::history_of(std::int64_t landmark_id) const {
  const auto at = std::ranges::lower_bound(seen_lately_, landmark_id, {}, &SeenLately::landmark_id);
  return at != seen_lately_.end() && at->landmark_id == landmark_id ? at->history : 0;
}

/// The bin of a landmark as if the images after number `newest` (counted back) did not exist. A landmark that was out
/// of sight is more likely to come into sight the farther the robot drives.
std::size_t SeenAgain::bin(std::uint64_t sightings, History history, std::size_t newest, double path_m) const {
  double missed = 0.0;
  for (std::size_t back = newest; history >> newest != 0 && back < kept_; ++back) {
    if ((history >> back & 1U) != 0) return bin(sightings, missed, path_m - image(back).path_m);
    missed += image(back).misses;
  }
  return bin(sightings, kOften, newest < kept_ ? path_m - image(newest).path_m : 0.0);
}

/// Bins of the numbers of observations and of misses: 1, 2 to 3, 4 to 7, 8 or more; misses also have a bin for none.
std::size_t SeenAgain::bin(std::uint64_t sightings, double missed, double driven_m) {
  const int seen_bin = std::bit_width(static_cast<unsigned>(std::clamp<std::uint64_t>(sightings, 1, kOften))) - 1;
  const int miss_bin = std::bit_width(static_cast<unsigned>(std::lround(std::min(missed, 1.0 * kOften))));
  std::size_t far = 0;
  for (double limit_m = kNearest_m; far + 1 < kDistanceBins && driven_m >= limit_m; limit_m *= 2.0) ++far;
  return (as_size(seen_bin) * kMissBins + as_size(miss_bin)) * kDistanceBins + far;
}

double SeenAgain::probability(std::uint64_t sightings, double missed, double driven_m) const {
  const Count& count = experience_.counts[bin(sightings, missed, driven_m)];
  return count.seen / count.due;
}

double SeenAgain::ln_elsewhere() const {
  double ln = 0.0;
  for (const Due& due : due_) ln += std::log(due.seen ? due.accident : 1.0 - due.accident);
  return ln;
}

/// ln P(image) for each level. A landmark can be shown by accident even if the robot is where the filter believes.
SeenAgain::Levels SeenAgain::ln_here() const {
  Levels ln{};
  for (const Due& due : due_)
    for (std::size_t level = 0; level < kLevels; ++level) {
      const double shown = std::min(kMostLikely, kLevels_[level] * due.here);
      const double missed = (1.0 - shown) * (1.0 - due.accident);
      ln[level] += std::log(due.seen ? 1.0 - missed : missed);
    }
  return ln;
}

/// One step of the hidden level: it stays, or changes to any level with that level's frequency. Returns ln P(image).
double SeenAgain::follow(const Levels& ln_likelihood) {
  const double most = *std::ranges::max_element(ln_likelihood);
  const double stays = experience_.stayed / experience_.followed, images = sum(experience_.occurred);
  double as_before = 0.0;
  for (std::size_t level = 0; level < kLevels; ++level) {
    const double likelihood = std::exp(ln_likelihood[level] - most);
    const double stayed = stays * belief_[level] * likelihood;
    as_before += stayed;
    belief_[level] = stayed + (1.0 - stays) * experience_.occurred[level] / images * likelihood;
  }
  const double all = sum(belief_);
  for (double& each : belief_) each /= all;
  undecided_.stayed += as_before / all;
  undecided_.followed += 1.0;
  return most + std::log(all);
}

void SeenAgain::learn() {
  if (!is_weighed_) return;
  const auto average = [](double& mean, double value) {
    mean = mean == 0.0 ? value : mean + kOfAnImage * (value - mean);
  };
  average(usual_bearings_, bearings_);
  average(usual_seen_, static_cast<double>(std::ranges::count(due_, true, &Due::seen)));
  pass_over();
  experience_ += undecided_;
  undecided_ = {};
}

void SeenAgain::pass_over() {
  if (!is_weighed_) return;
  is_weighed_ = false;
  for (std::size_t level = 0; level < kLevels; ++level) undecided_.occurred[level] += belief_[level];
  count_looks();
  keep_image();
}

/// Counts, for each of the last images, the present image as if it were the next one after it: images get lost, or show
/// nothing.
void SeenAgain::count_looks() {
  for (const std::size_t newest : kReferences) {
    if (newest >= kept_) return;
    const History since = (History{1} << newest) - 1U;
    for (const Due& due : due_) {
      if (due.landmark_id >= image(newest).known_below) continue;
      // The landmark may have been shown at its place without being associated.
      const auto sightings =
          due.sightings - std::min<std::uint64_t>(due.sightings, as_size(std::popcount(due.history & since)));
      Count& count = undecided_.counts[bin(sightings, due.history, newest, path_m_)];
      count.seen += due.seen ? 1.0 : 0.0;
      count.due += 1.0;
    }
  }
}

/// By Bayes' rule, a miss makes it less probable that the landmark is in sight, depending on the share of landmarks
/// that the image shows.
void SeenAgain::keep_image() {
  Image& kept = images_[next_];
  next_ = (next_ + 1) % kImages;
  kept_ = std::min(kept_ + 1, kImages);
  double not_shown = 0.0;
  for (std::size_t level = 0; level < kLevels; ++level)
    not_shown += belief_[level] * (1.0 - kInSight * fullness_ * std::min(1.0, kLevels_[level]));
  kept.misses = std::log(not_shown) / std::log(1.0 - kInSight);
  kept.path_m = path_m_;
  kept.known_below = 0;
  for (const Due& due : due_) kept.known_below = std::max(kept.known_below, due.landmark_id + 1);
  for (SeenLately& lately : seen_lately_) lately.history <<= 1U;
  std::erase_if(seen_lately_, [](const SeenLately& lately) { return lately.history == 0; });
  for (const Due& due : due_) {
    if (!due.seen) continue;
    const auto at = std::ranges::lower_bound(seen_lately_, due.landmark_id, {}, &SeenLately::landmark_id);
    if (at != seen_lately_.end() && at->landmark_id == due.landmark_id)
      at->history |= 1U;
    else
      seen_lately_.insert(at, {due.landmark_id, 1U});
  }
}

void SeenAgain::forget_images() {
  kept_ = 0;
  seen_lately_.clear();
  is_weighed_ = false;
  undecided_ = {};
  const double images = sum(experience_.occurred);
  for (std::size_t level = 0; level < kLevels; ++level) belief_[level] = experience_.occurred[level] / images;
}

}  // namespace azimuth
