#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace azimuth {

/// A landmark that an image might show at its predicted place.
struct Look {
  std::int64_t landmark_id;  ///< Ids grow: a landmark mapped later has a higher one
  std::uint64_t sightings;   ///< Number of bearings so far
  bool seen;                 ///< The image shows it
  double room;  ///< Share of the view in which any bearing would be accepted as this landmark's; used if `seen`
};

/// Learns which landmarks images show again, and judges the pose by it, for images that show only some of the landmarks
/// in view (mathematics VI.36). The probability that a landmark is seen again is estimated by counting, over all
/// landmarks, depending on how often it was seen, how often it was missed since, and how far the robot has driven
/// since. Causes that affect a whole image are modelled by a hidden level, the share of the expected landmarks that it
/// shows; the frequency and persistence of levels are learned too. A miss in an image with a low level hardly counts as
/// a miss.
///
/// Thread contract: thread-bound. The same calls give the same results. Nothing allocates once no image is larger than
/// any before.
class SeenAgain {
 public:
  SeenAgain();

  /// ln P(image | the robot is elsewhere) / P(image | the robot is where the filter believes), from the landmarks in
  /// the field of view. `bearings`: number of bearings in the image.
  double weigh(std::span<const Look> looks, double path_m, int bearings);
  /// Number of landmarks that the last weighed image should have shown.
  double expected() const { return expected_; }

  /// The last weighed image, and those passed over before it, were taken where the filter believes: learns from them.
  void learn();
  /// It is in doubt where the last weighed image was taken: keeps the image until learn() or forget_images().
  void pass_over();
  /// The images passed over were taken elsewhere: discards them. The next image is not compared with any previous one.
  void forget_images();

  /// Probability that a landmark is seen, given how often it was seen, and the misses and the distance driven since
  /// the last one.
  double probability(std::uint64_t sightings, double missed, double driven_m) const;

 private:
  static constexpr std::size_t kImages = 32;
  static constexpr std::size_t kSightingBins = 4, kMissBins = 5, kDistanceBins = 7, kLevels = 8;
  using Levels = std::array<double, kLevels>;
  /// When a landmark was seen; bit i stands for the image i before the newest.
  using History = std::uint32_t;
  struct Image {
    double path_m = 0.0;
    double misses = 0.0;         ///< Weight of a miss in this image
    std::int64_t known_below{};  ///< Landmarks with this id or a higher one were not yet mapped at this image
  };
  struct SeenLately {
    std::int64_t landmark_id;
    History history;
  };
  struct Count {
    double seen = 0.0, due = 0.0;
  };
  using Counts = std::array<Count, kSightingBins * kMissBins * kDistanceBins>;
  /// Statistics for predicting images.
  struct Experience {
    Counts counts{};
    Levels occurred{};
    double stayed = 0.0, followed = 0.0;

    Experience& operator+=(const Experience& more);
  };

  const Image& image(std::size_t back) const { return images_[(next_ + kImages - 1 - back) % kImages]; }
  History history_of(std::int64_t landmark_id) const;
  std::size_t bin(std::uint64_t sightings, History history, std::size_t newest, double path_m) const;
  static std::size_t bin(std::uint64_t sightings, double missed, double driven_m);
  void prepare(std::span<const Look> looks, double path_m, int bearings);
  double ln_elsewhere() const;
  Levels ln_here() const;
  double follow(const Levels& ln_likelihood);
  void count_looks();
  void keep_image();

  std::array<Image, kImages> images_;    ///< Ring
  std::vector<SeenLately> seen_lately_;  ///< Landmarks seen in those images, sorted by id
  std::size_t next_ = 0, kept_ = 0;
  Experience experience_, undecided_;  ///< `undecided_`: from images whose place is in doubt
  Levels belief_;                      ///< Probabilities of the last image's hidden level
  double usual_seen_ = 0.0, usual_bearings_ = 0.0;

  // State of the last weighed image.
  struct Due {
    std::int64_t landmark_id;
    std::uint64_t sightings;
    History history;
    bool seen;
    double here, accident;  ///< Probabilities that the image shows the landmark: if the robot is here, and by accident
  };
  std::vector<Due> due_;
  bool is_weighed_ = false;
  double path_m_ = 0.0, fullness_ = 1.0, expected_ = 0.0;
  int bearings_ = 0;
};

}  // namespace azimuth
