#include "slam/association/feature_patterns.hpp"

#include <cassert>
#include <cmath>
#include <numeric>

#include "slam/association/descriptor_block.hpp"

namespace azimuth {
namespace {

/// From the sums over n pairs: (n ab - a b) / sqrt((n aa - a a) (n bb - b b)).
double correlation_of_sums(double n, double a, double b, double aa, double bb, double ab) {
  const double spread_a = n * aa - a * a, spread_b = n * bb - b * b;
  if (!(spread_a > 0.0 && spread_b > 0.0)) return 0.0;
  return (n * ab - a * b) / (std::sqrt(spread_a) * std::sqrt(spread_b));
}

double total_of(const Descriptor& descriptor) {
  return std::accumulate(descriptor.values.begin(), descriptor.values.end(), 0);
}

}  // namespace

double correlation(std::span<const double> a, std::span<const double> b) {
  assert(a.size() == b.size());
  const auto product = [](std::span<const double> x, std::span<const double> y) {
    return std::inner_product(x.begin(), x.end(), y.begin(), 0.0);
  };
  return correlation_of_sums(static_cast<double>(a.size()), std::accumulate(a.begin(), a.end(), 0.0),
                             std::accumulate(b.begin(), b.end(), 0.0), product(a, a), product(b, b), product(a, b));
}

double correlation(const Descriptor& a, const Descriptor& b) {
  return correlation_of_sums(static_cast<double>(a.values.size()), total_of(a), total_of(b), dot_product(a, a),
                             dot_product(b, b), dot_product(a, b));
}

Pattern pattern_of(const BearingSet& image, std::size_t at) {
  Pattern pattern;
  if (at >= image.neighbours.size()) return pattern;
  for (const std::uint16_t neighbour : image.neighbours[at].index)
    if (neighbour < image.descriptors.size()) pattern.members[pattern.count++] = image.descriptors[neighbour];
  return pattern;
}

}  // namespace azimuth
