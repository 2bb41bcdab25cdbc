#pragma once
#include <cstddef>

// What holds of a robot that is lost, whatever it sees. Internal to slam/estimator.
namespace azimuth {

/// A smaller map says little about being lost.
inline constexpr std::size_t kFewestEstablished = 6;
/// It can be anywhere, facing anywhere.
inline constexpr double kAnywhere_m = 100.0;
/// How far from the pose found one image may put it: little enough to be linear in.
inline constexpr double kNear_m = 0.5, kNear_rad = 0.2;
/// Of a covariance that takes the landmarks' errors as independent.
inline constexpr double kDoubtfulFactor = 4.0;

}  // namespace azimuth
