#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace azimuth {

/// A landmark that an image might show where it should be.
struct Look {
  std::int64_t landmark_id;  ///< ids grow: what is mapped later has a higher one
  std::uint64_t sightings;   ///< so far
  bool seen;                 ///< it does
  double room;               ///< share of the view in which it would be taken to be where it should; counts if seen
};

/// What images say of the pose by the landmarks that they show and those that they do not, where an image shows but
/// some of what is there and experience alone tells which (SPEC VI.36): how often a landmark is seen again is counted
/// by how often it has been seen, how often it was missed since the last time and how far the robot has driven since,
/// for all landmarks together; what spoils an image as a whole is a hidden share of what it should show, of which is
/// learnt how often it is how small and how long it stays so. What an image misses that shows little of anything was
/// hardly missed.
///
/// Thread contract: thread-bound. Same calls, same results. Nothing allocates once no image is larger than before.
class SeenAgain {
 public:
  SeenAgain();

  /// ln P(image | the robot is elsewhere) / P(image | it is where it is thought to be), by what was learnt, of
  /// the landmarks in the field of view. `bearings`: all that the image shows.
  double weigh(std::span<const Look> looks, double path_m, int bearings);
  /// How many landmarks the image weighed last should have shown.
  double expected() const { return expected_; }

  /// The image weighed last, and those passed over before it, were taken where the robot is thought to be.
  void learn();
  /// About that there is doubt.
  void pass_over();
  /// Those passed over were taken elsewhere, and the next is not to be compared with any of them.
  void forget_images();

  /// How often a landmark is seen that was seen so often, and missed so often, and driven so far, since the last time.
  double probability(std::uint64_t sightings, double missed, double driven_m) const;

 private:
  static constexpr std::size_t kImages = 32;
  static constexpr std::size_t kSightingBins = 4, kMissBins = 5, kDistanceBins = 7, kLevels = 8;
  using Levels = std::array<double, kLevels>;
  /// Of whether a landmark was seen; bit i: in the image i before the newest.
  using History = std::uint32_t;
  struct Image {
    double path_m = 0.0;
    double misses = 0.0;         ///< how much of a miss it is to be missed in it
    std::int64_t known_below{};  ///< landmarks of this id and above were not mapped then
  };
  struct SeenLately {
    std::int64_t landmark_id;
    History history;
  };
  struct Count {
    double seen = 0.0, due = 0.0;
  };
  using Counts = std::array<Count, kSightingBins * kMissBins * kDistanceBins>;
  /// What images tell of those to come.
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

  std::array<Image, kImages> images_;    ///< in turn
  std::vector<SeenLately> seen_lately_;  ///< in those images, in the order of ids
  std::size_t next_ = 0, kept_ = 0;
  Experience experience_, undecided_;  ///< the latter of images about which there is doubt
  Levels belief_;                      ///< of the hidden share of the last image
  double usual_seen_ = 0.0, usual_bearings_ = 0.0;

  // The image weighed last.
  struct Due {
    std::int64_t landmark_id;
    std::uint64_t sightings;
    History history;
    bool seen;
    double here, accident;  ///< probabilities
  };
  std::vector<Due> due_;
  bool is_weighed_ = false;
  double path_m_ = 0.0, fullness_ = 1.0, expected_ = 0.0;
  int bearings_ = 0;
};

}  // namespace azimuth
