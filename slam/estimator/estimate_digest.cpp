#include "slam/estimator/estimate_digest.hpp"

#include <bit>

namespace azimuth {

/// The finaliser of splitmix64: every bit of the word influences every bit of the value. The old value enters too, so
/// the order of words matters.
void EstimateDigest::mix(std::uint64_t word) {
  std::uint64_t x = std::rotl(value_, 5) + word + 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  value_ = x ^ (x >> 31);
}

void EstimateDigest::mix(double value) { mix(std::bit_cast<std::uint64_t>(value)); }

void EstimateDigest::add(const Estimate& estimate) {
  if (estimate.predicted) return;
  ++estimates_;
  mix(static_cast<std::uint64_t>(to_us(estimate.stamp)));
  for (const double value : estimate.T_map_body.vector()) mix(value);
  for (const double value : estimate.pose_covariance.reshaped()) mix(value);
  mix(static_cast<std::uint64_t>(estimate.landmarks.size()));
  for (const LandmarkEstimate& landmark : estimate.landmarks) {
    mix(static_cast<std::uint64_t>(landmark.id));
    mix(static_cast<std::uint64_t>(landmark.identity));
    for (const double value : landmark.p_map_landmark_m) mix(value);
    for (const double value : landmark.covariance_m2.reshaped()) mix(value);
  }
}

std::string digest_text(std::uint64_t digest) {
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string text(16, '0');
  for (std::size_t i = text.size(); i-- > 0; digest >>= 4) text[i] = kDigits[digest & 0xf];
  return text;
}

}  // namespace azimuth
