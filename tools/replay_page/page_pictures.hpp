#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "drivers/camera/jpeg.hpp"
#include "drivers/camera/run_images.hpp"
#include "drivers/picture/picture.hpp"
#include "drivers/storage/run.hpp"
#include "slam/estimator/estimate.hpp"
#include "slam/estimator/estimator.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

struct PagePicture {
  Stamp stamp{};
  std::string why;  ///< the new health and its reason at a change of health; empty for evenly spread pictures
  std::vector<std::byte> jpeg;
};

/// Limits of the pictures on a page.
struct PictureLimits {
  std::size_t pictures = 24;      ///< largest number per run; 0: no pictures
  std::size_t bytes = 4'000'000;  ///< total size per run, as JPEG
};

/// Draws some of a run's images with detections and expected bearings. Two thirds of the pictures are spread evenly
/// over the run; the remaining third shows images at changes of health. Large images are scaled down.
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
  std::size_t spread_;  ///< number of evenly spread pictures
  std::size_t every_;   ///< interval between evenly spread pictures, in images
  RunImages images_;
  Picture picture_;
  JpegEncoder encoder_;
  std::optional<std::size_t> image_;  // image of the present step
  BearingSet seen_;
  std::vector<ExpectedBearing> expected_;
  std::vector<std::int64_t> in_map_;
  Health health_ = Health::starting;
  std::size_t of_changes_ = 0;
  std::vector<PagePicture> pictures_;
};

}  // namespace azimuth
