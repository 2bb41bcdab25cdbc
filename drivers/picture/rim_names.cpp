#include "drivers/picture/rim_names.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "slam/geometry/angle.hpp"

namespace azimuth {
namespace {

constexpr double kBetween_px = 4.0;

/// The share of the rim that a name needs: a text of any orientation is at most as wide as its diagonal.
double share_rad(const RimNames::Name& name, double radius_px) {
  const Pixel size = Canvas::label_size_px(name.text);
  return (size.norm() + kBetween_px) / radius_px;
}

/// Adjacent names treated as one, centred between their azimuths.
struct Group {
  double middle_rad, share_rad;
  std::size_t names;

  double from_rad() const { return middle_rad - 0.5 * share_rad; }
  double to_rad() const { return middle_rad + 0.5 * share_rad; }
  void join(const Group& next) {
    // The common start that minimises the displacement of all names, each with the same weight.
    const double begin =
        (from_rad() * double(names) + (next.from_rad() - share_rad) * double(next.names)) / double(names + next.names);
    share_rad += next.share_rad;
    names += next.names;
    middle_rad = begin + 0.5 * share_rad;
  }
};

}  // namespace

void RimNames::add(double azimuth_rad, std::string text, const PictureColour& colour) {
  names_.push_back({wrap(azimuth_rad), std::move(text), colour});
}

/// The rim is a circle. It is cut at the widest gap, and azimuths increase from there.
void RimNames::begin_after_the_widest_gap() {
  if (names_.empty()) return;
  std::ranges::stable_sort(names_, {}, &Name::azimuth_rad);
  std::size_t first = 0;
  double widest_rad = names_.front().azimuth_rad + 2.0 * kPi - names_.back().azimuth_rad;
  for (std::size_t i = 1; i < names_.size(); ++i) {
    const double gap_rad = names_[i].azimuth_rad - names_[i - 1].azimuth_rad;
    if (gap_rad <= widest_rad) continue;
    widest_rad = gap_rad;
    first = i;
  }
  for (std::size_t i = 0; i < first; ++i) names_[i].azimuth_rad += 2.0 * kPi;
  std::rotate(names_.begin(), names_.begin() + static_cast<std::ptrdiff_t>(first), names_.end());
}

const std::vector<RimNames::Name>& RimNames::placed(double radius_px) {
  begin_after_the_widest_gap();
  double all_rad = 0.0;
  for (const Name& name : names_) all_rad += share_rad(name, radius_px);
  const double scale = std::min(1.0, 2.0 * kPi / all_rad);
  std::vector<Group> groups;
  for (const Name& name : names_) {
    groups.push_back({name.azimuth_rad, scale * share_rad(name, radius_px), 1});
    while (groups.size() > 1 && groups[groups.size() - 2].to_rad() > groups.back().from_rad()) {
      const Group last = groups.back();
      groups.pop_back();
      groups.back().join(last);
    }
  }
  std::size_t next = 0;
  for (const Group& group : groups) {
    double from_rad = group.from_rad();
    for (std::size_t k = 0; k < group.names; ++k, ++next) {
      const double share = scale * share_rad(names_[next], radius_px);
      names_[next].placed_rad = from_rad + 0.5 * share;
      from_rad += share;
    }
  }
  return names_;
}

}  // namespace azimuth
