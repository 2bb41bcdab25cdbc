#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "drivers/camera/jpeg.hpp"
#include "drivers/camera/run_images.hpp"
#include "drivers/storage/run.hpp"
#include "picture/picture.hpp"
#include "slam/estimator/estimate.hpp"
#include "slam/estimator/estimator.hpp"
#include "slam/sample/expected_bearing.hpp"

namespace azimuth {

struct PagePicture {
  Stamp stamp{};
  std::string why;  ///< the health that began here, with its reason; empty: one of those spread over the run
  std::vector<std::byte> jpeg;
};

/// How much of a page images may take.
struct PictureLimits {
  std::size_t pictures = 24;      ///< of a run; 0: none
  std::size_t bytes = 4'000'000;  ///< of a run, as JPEG
};

/// Draws some of a run's images with what was seen and what was expected in them: two thirds spread evenly over the
/// run, and where health changes as long as there is room. Large ones are drawn smaller.
///
/// Thread contract: thread-bound. Borrows the run.
class PagePictures {
 public:
  PagePictures(const Run& run, const CameraRig& rig, const PictureLimits& limits);

  void before_update(const BearingSet& set, const Estimator& estimator);
  void after_step(const Estimate& estimate);

  const std::vector<PagePicture>& pictures() const { return pictures_; }

 private:
  void take(std::size_t index, std::string why);
  std::vector<std::byte> drawn(std::size_t index);

  const Run& run_;
  PictureLimits limits_;
  std::size_t spread_;  ///< of how many pictures
  std::size_t every_;   ///< of the run's images
  RunImages images_;
  Picture picture_;
  JpegEncoder encoder_;
  std::optional<std::size_t> image_;  // of the step under way
  BearingSet seen_;
  std::vector<ExpectedBearing> expected_;
  std::vector<std::int64_t> in_map_;
  Health health_ = Health::starting;
  std::size_t of_changes_ = 0;
  std::vector<PagePicture> pictures_;
};

}  // namespace azimuth
