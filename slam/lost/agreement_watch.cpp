#include "slam/lost/agreement_watch.hpp"

#include <algorithm>
#include <cmath>

namespace azimuth {
namespace {

constexpr double kMostOfAnImage = 4.0;  // what spoils one bearing may spoil them all
constexpr double kLeastShare = 0.3, kMostShare = 0.8;
constexpr double kLeastChance = 0.05, kMostChance = 0.6;
constexpr double kLearning = 0.05;
constexpr double kFading = 0.9;  // of a doubt about which an image says nothing

}  // namespace

void AgreementWatch::add(const ImageAgreement& image) {
  if (image.log_odds) {
    if (image.expected == 0) log_odds_ *= kFading;
    log_odds_ = std::max(0.0, log_odds_ + *image.log_odds);
    return;
  }
  // As many as could have been found again: a camera half covered sees fewer.
  const int trials = std::min(image.expected, image.bearings);
  if (trials == 0 || image.chance > kMostChance) {
    log_odds_ *= kFading;
    return;
  }
  const double hits = std::min(trials, image.explained), misses = trials - hits;
  if (hits == 0.0 && misses == 1.0) {  // anything may stand before one landmark, and go on to
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
