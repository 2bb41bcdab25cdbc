#pragma once
// Sources of bearing sets for a replay: recorded sets, or images processed by a front end.

#include <chrono>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "drivers/camera/run_images.hpp"
#include "drivers/storage/run.hpp"
#include "slam/perception/make_perception.hpp"
#include "slam/perception/perception.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

/// Measures the time since its construction.
class StopWatch {
 public:
  double elapsed_us() const {
    return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// The bearing sets of a run, in the order of their stamps. Thread contract: thread-bound.
class SetSource {
 public:
  virtual ~SetSource() = default;

  virtual std::size_t count() const = 0;
  /// Replaces the content of `out` by the next set; false if there is none.
  virtual bool next(BearingSet& out) = 0;
  /// Time that the front end took for the last set; 0 for recorded sets.
  virtual double last_us() const { return 0.0; }
};

/// Recorded bearing sets. Borrows the run.
class RecordedSets final : public SetSource {
 public:
  explicit RecordedSets(const Run& run) : run_(run) {}
  std::size_t count() const override { return run_.bearings.size(); }
  bool next(BearingSet& out) override;

 private:
  const Run& run_;
  std::size_t next_ = 0;
};

/// The front end that processes a run's images.
struct ImageFrontEnd {
  std::unique_ptr<Perception> perception;
  PixelFormat decoded = PixelFormat::rgb8;  ///< see decoded_format()
};

/// Bearing sets detected in the run's images. An image that is missing, damaged or not of the rig's size gives an empty
/// set with the corresponding trouble. Borrows the run.
class SeenSets final : public SetSource {
 public:
  SeenSets(const Run& run, const ImageRig& rig, ImageFrontEnd front_end);

  std::size_t count() const override { return images_.count(); }
  bool next(BearingSet& out) override;
  double last_us() const override { return last_us_; }

  const std::vector<double>& decode_us() const { return decode_us_; }  ///< for each image, including reading the file
  const std::vector<double>& detect_us() const { return detect_us_; }  ///< for each usable image
  /// File and reason of the first unreadable image; empty if there is none.
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
