#pragma once
// Where a replay's bearing sets come from: recorded ones, or the images of the run by way of a front end.

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "drivers/camera/run_images.hpp"
#include "drivers/storage/run.hpp"
#include "slam/perception/image_stage.hpp"
#include "slam/perception/make_perception.hpp"
#include "slam/perception/perception.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

/// The bearing sets of a run, in the order of their stamps. Thread contract: thread-bound.
class SetSource {
 public:
  virtual ~SetSource() = default;

  virtual std::size_t count() const = 0;
  /// Replaces what `out` holds by the next set; false when that was all.
  virtual bool next(BearingSet& out) = 0;
  /// What it took to find the last set, from the image on; 0 for what was found before.
  virtual double last_us() const { return 0.0; }
};

/// Bearings as they were recorded. Borrows the run.
class RecordedSets final : public SetSource {
 public:
  explicit RecordedSets(const Run& run) : run_(run) {}
  std::size_t count() const override { return run_.bearings.size(); }
  bool next(BearingSet& out) override;

 private:
  const Run& run_;
  std::size_t next_ = 0;
};

/// The front end that looks at a run's images.
struct ImageFrontEnd {
  std::unique_ptr<Perception> perception;
  PixelFormat decoded = PixelFormat::rgb8;  ///< see decoded_format()
};

/// Bearings found in the run's images. One that is missing, damaged or not of the rig's size gives an empty set whose
/// trouble says so. Borrows the run.
class SeenSets final : public SetSource {
 public:
  SeenSets(const Run& run, const ImageRig& rig, ImageFrontEnd front_end);

  std::size_t count() const override { return images_.count(); }
  bool next(BearingSet& out) override;
  double last_us() const override { return last_us_; }

  const std::vector<double>& decode_us() const { return decode_us_; }  ///< of each image, reading the file included
  const std::vector<double>& detect_us() const { return detect_us_; }  ///< of each image that could be looked at
  /// File and reason of the first image that could not be read; empty: there was none.
  const std::string& first_unreadable() const { return first_unreadable_; }

 private:
  ImageView next_image();
  void observe(const ImageView& image, BearingSet& out);
  std::string size_problem(const FrameFormat& format) const;

  const Run& run_;
  ImageRig rig_;
  PixelFormat decoded_;
  ImageStage stage_;
  RunImages images_;
  std::size_t next_ = 0;
  double last_us_ = 0.0;
  std::vector<double> decode_us_, detect_us_;
  std::string first_unreadable_;
};

}  // namespace azimuth
