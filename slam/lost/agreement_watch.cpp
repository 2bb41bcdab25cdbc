#include "slam/lost/agreement_watch.hpp"

#include <algorithm>
#include <cmath>

namespace azimuth {
namespace {

constexpr double kMostOfAnImage = 4.0;  // limit per image, since a common cause may spoil all its bearings
constexpr double kLeastShare = 0.3, kMostShare = 0.8;
constexpr double kLeastChance = 0.05, kMostChance = 0.6;
constexpr double kLearning = 0.05;
constexpr double kFading = 0.9;  // decay of the log odds when an image carries no evidence

}  // namespace

void AgreementWatch::add(const ImageAgreement& image) {
  if (image.log_odds) {
    if (image.expected == 0) log_odds_ *= kFading;
    log_odds_ = std::max(0.0, log_odds_ + *image.log_odds);
    return;
  }
  // Number of landmarks that could have been found again: a half-covered camera sees fewer.
  const int trials = std::min(image.expected, image.bearings);
  if (trials == 0 || image.chance > kMostChance) {
    log_odds_ *= kFading;
    return;
  }
  const double hits = std::min(trials, image.explained), misses = trials - hits;
  if (hits == 0.0 && misses == 1.0) {  // a single landmark may be occluded, for any length of time
    log_odds_ *= kFading;
    return;
  }
  const double chance = std::clamp(image.chance, kLeastChance, kMostChance);
  const double usual = std::clamp(usual_share_, std::max(kLeastShare, std::min(1.3 * chance, kMostShare)), kMostShare);
  const double said = hits * std::log(chance / usual) + misses * std::log((1.0 - chance) / (1.0 - usual));
  log_odds_ = std::max(0.0, log_odds_ + std::clamp(said, -kMostOfAnImage, kMostOfAnImage));
  if (!doubts()) usual_share_ += kLearning * (hits / trials - usual_share_);
}

}  // namespace azimuth
