#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "drivers/camera/run_images.hpp"
#include "drivers/picture/picture.hpp"
#include "drivers/storage/run.hpp"
#include "slam/estimator/estimator.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

/// Writes every n-th image of a run to a folder, overlaid with its detections and with the bearings that the estimator
/// expected. File names are the image's number in the run: 000000.jpg and so on.
///
/// Thread contract: thread-bound. Borrows the run.
class PictureFolder {
 public:
  /// `folder` must exist. `every` is at least 1.
  PictureFolder(const Run& run, const CameraRig& rig, std::filesystem::path folder, std::size_t every);

  /// Must be called before each update. Ignores bearing sets that do not belong to an image of the run.
  void before_update(const BearingSet& set, const Estimator& estimator);

  std::size_t written() const { return written_; }
  /// The first error on writing a picture; empty if there is none.
  const std::string& problem() const { return problem_; }

 private:
  void write(std::size_t index, std::span<const std::byte> jpeg);

  const Run& run_;
  std::filesystem::path folder_;
  std::size_t every_;
  RunImages images_;
  Picture picture_;
  JpegEncoder encoder_;
  std::vector<ExpectedBearing> expected_;
  std::size_t written_ = 0;
  std::string problem_;
};

}  // namespace azimuth
