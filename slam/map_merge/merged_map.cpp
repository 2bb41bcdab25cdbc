#include "slam/map_merge/merged_map.hpp"

#include <algorithm>

namespace azimuth {
namespace {

/// The origin of a coordinate of the merged map: a coordinate of a, or of a landmark of b transformed to a's frame.
struct Source {
  bool of_a = true;
  Eigen::Index row = 0;   ///< Row in its map; for a landmark of b, the row of the landmark's x
  Eigen::Index part = 0;  ///< For a landmark of b: 0 for x, 1 for y, 2 for the height
};

class Merging {
 public:
  Merging(const MapGaussian& a, const MapGaussian& b, const JointFit& fit) : a_(a), b_(b), fit_(fit), merged_(*a.map) {
    merged_.views.clear();
    merged_.landmarks.clear();
    merged_.T_map_body = {fit.mean_a(0), fit.mean_a(1), wrap(fit.mean_a(2))};
    for (std::size_t i = 0; i < merged_.camera.size(); ++i) merged_.camera[i] = fit.mean_a(as_index(3 + i));
    for (Eigen::Index row = 0; row < as_index(a.map->first_landmark_entry()); ++row) sources_.push_back({true, row, 0});
  }

  MapSnapshot run(const std::vector<bool>& left_out) && {
    std::vector<bool> paired(b_.size(), false);
    for (std::size_t i = 0; i < a_.size(); ++i) {
      const auto pair = std::find_if(fit_.pairs.begin(), fit_.pairs.end(), [&](const auto& p) { return p.a == i; });
      if (pair != fit_.pairs.end()) paired[pair->b] = true;
      add_of_a(i, pair == fit_.pairs.end() ? nullptr : &*pair);
    }
    for (std::size_t k = 0; k < b_.size(); ++k)
      if (!paired[k] && !left_out[k]) add_of_b(k);
    set_covariance();
    return std::move(merged_);
  }

 private:
  /// Adds a landmark of a. A height that only b knows is taken from b.
  void add_of_a(std::size_t i, const Correspondence* pair) {
    MapLandmark landmark = a_.landmark(i);
    const Eigen::Index row = a_.row[i];
    landmark.p_map_landmark_m = fit_.mean_a.segment<2>(row);
    sources_.insert(sources_.end(), {{true, row, 0}, {true, row + 1, 0}});
    if (landmark.has_height()) {
      landmark.z_map_landmark_m = fit_.mean_a(row + 2);
      sources_.push_back({true, row + 2, 0});
    }
    if (pair != nullptr) {
      const MapLandmark& other = b_.landmark(pair->b);
      landmark.sightings += other.sightings;
      if (landmark.identity == kUnknownIdentity) landmark.identity = other.identity;
      if (landmark.kind == kAnyKind) landmark.kind = other.kind;
      if (!landmark.has_height() && other.has_height()) add_height(landmark, pair->b);
    }
    merged_.landmarks.push_back(landmark);
  }
  void add_of_b(std::size_t k) {
    MapLandmark landmark = b_.landmark(k);
    const Eigen::Index row = b_.row[k];
    landmark.id = merged_.next_id++;
    landmark.p_map_landmark_m = fit_.T_a_b * Eigen::Vector2d(fit_.mean_b.segment<2>(row));
    sources_.insert(sources_.end(), {{false, row, 0}, {false, row, 1}});
    if (landmark.has_height()) add_height(landmark, k);
    merged_.landmarks.push_back(landmark);
  }
  void add_height(MapLandmark& landmark, std::size_t k) {
    landmark.z_map_landmark_m = fit_.mean_b(b_.row[k] + 2);
    sources_.push_back({false, b_.row[k], 2});
  }

  /// Equation (9) of docs/mathematics.md, VI.30: the derivatives of each coordinate by a, by b and by T, row by row.
  void set_covariance() {
    const Eigen::Index size = as_index(sources_.size()), size_a = a_.mean.size(), size_b = b_.mean.size();
    Eigen::MatrixXd L_a = Eigen::MatrixXd::Zero(size, size_a), L_b = Eigen::MatrixXd::Zero(size, size_b);
    Eigen::MatrixXd L_T = Eigen::MatrixXd::Zero(size, 3);
    for (Eigen::Index i = 0; i < size; ++i) set_row(sources_[as_size(i)], L_a.row(i), L_b.row(i), L_T.row(i));
    const Eigen::MatrixXd LU = L_a * fit_.U_a + L_b * fit_.U_b;
    const Eigen::MatrixXd with_T = -LU * fit_.S_inverse_G * fit_.covariance_T * L_T.transpose();
    const Eigen::MatrixXd covariance = L_a * a_.covariance * L_a.transpose() + L_b * b_.covariance * L_b.transpose() -
                                       LU * fit_.Q * LU.transpose() + with_T + with_T.transpose() +
                                       L_T * fit_.covariance_T * L_T.transpose();
    merged_.covariance.resize(sources_.size());
    for (std::size_t c = 0; c < sources_.size(); ++c)
      for (std::size_t r = c; r < sources_.size(); ++r)
        merged_.covariance(r, c) = 0.5 * (covariance(as_index(r), as_index(c)) + covariance(as_index(c), as_index(r)));
  }
  template <class Row>
  void set_row(const Source& source, Row by_a, Row by_b, Row by_T) const {
    if (source.of_a)
      by_a(source.row) = 1.0;
    else if (source.part == 2)
      by_b(source.row + 2) = 1.0;
    else {
      const Gap at = gap(Eigen::Vector2d::Zero(), fit_.T_a_b, fit_.mean_b.segment<2>(source.row));
      by_b.template segment<2>(source.row) = -at.by_p_b.row(source.part);
      by_T = -at.by_T.row(source.part);
    }
  }

  const MapGaussian &a_, &b_;
  const JointFit& fit_;
  MapSnapshot merged_;
  std::vector<Source> sources_;
};

}  // namespace

MapSnapshot merged_map(const MapGaussian& a, const MapGaussian& b, const JointFit& fit,
                       const std::vector<bool>& left_out) {
  return Merging(a, b, fit).run(left_out);
}

}  // namespace azimuth
