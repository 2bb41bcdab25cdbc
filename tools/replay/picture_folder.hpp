#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "drivers/camera/run_images.hpp"
#include "drivers/storage/run.hpp"
#include "picture/picture.hpp"
#include "slam/estimator/estimator.hpp"
#include "slam/sample/expected_bearing.hpp"

namespace azimuth {

/// Draws every n-th image of a run, with what was seen in it and what the estimator expected, into a folder:
/// 000000.jpg and so on, by the image's number in the run.
///
/// Thread contract: thread-bound. Borrows the run.
class PictureFolder {
 public:
  /// The folder is there already. `every` is at least 1.
  PictureFolder(const Run& run, const CameraRig& rig, std::filesystem::path folder, std::size_t every);

  /// To be called before each update. Sets that are of no image of the run are passed over.
  void before_update(const BearingSet& set, const Estimator& estimator);

  std::size_t written() const { return written_; }
  /// Why a picture could not be written, the first of them; empty: all were.
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
