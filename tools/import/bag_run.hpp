#pragma once
// A run from the topics of a bag. What a robot recorded is used as far as it goes, and what is skipped is counted.
//
// Thread contract: reentrant.

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "base/file_result.hpp"
#include "drivers/storage/run.hpp"
#include "tools/import/bag_file.hpp"
#include "tools/import/bag_topics.hpp"
#include "tools/import/wheel_odometry.hpp"
#include "tools/import/wheel_path.hpp"

namespace azimuth {

/// Which joints are the wheels, and how they turn into a pose.
struct BagWheels {
  Wheels wheels;
  std::string left, right;  ///< names; empty: the joints with left and right in their names
};

/// A run on its way out of a bag.
struct BagRun {
  Run run;
  std::vector<Arrival> odometry, truth, frames;  ///< how each came
  /// What the wheels had rolled at each reading of the run's odometry, whose `sequence` counts them. Empty: the bag has
  /// poses.
  std::vector<WheelReading> rolled;
  Wheels wheels;                   ///< of these
  std::vector<std::string> notes;  ///< what was done otherwise than the bag says, for a person
};

/// Odometry and truth of a run, in the order in which they lie. Stamps are those of the messages' headers; where nobody
/// set them, when they were recorded. Odometry whose orientation was never set is made from its speeds. Errors: not one
/// message can be used, or several robots or frames are mixed.
FileResult<void> read_bag_samples(const BagFile& bag, const std::string& file, const BagChoice& choice,
                                  const BagWheels& wheels, BagRun& read);

/// The run of all that was read, its stamps in order: moved on where a clock was set, wheels that wrap unwrapped, and
/// an odometer that began anew bridged, which `notes` say after those of `read`. Errors: those of wheel_odometry().
FileResult<Run> finish_bag_run(BagRun read, const std::string& file, std::vector<std::string>& notes);

/// Takes the images of a bag, one by one.
class BagImages {
 public:
  virtual ~BagImages() = default;
  /// Gives it a place; what stands in the way.
  virtual FileResult<FrameFile> keep(std::size_t number, Stamp stamp, const ImageView& image) = 0;
};

/// Files of a run folder `out`: JPEG and PNG as they come, grey and colour as PNG. Refuses Bayer patterns and YUV,
/// which PNG cannot hold without loss. They are put into `files`, by default `out` itself.
class FolderImages : public BagImages {
 public:
  explicit FolderImages(const std::filesystem::path& out) : FolderImages(out, out) {}
  FolderImages(std::filesystem::path out, std::filesystem::path files)
      : out_(std::move(out)), files_(std::move(files)) {}
  FileResult<FrameFile> keep(std::size_t number, Stamp stamp, const ImageView& image) override;

 private:
  std::filesystem::path out_, files_;
};

/// Parts of a file beside `log`, from which write_run_log() fetches them; it is deleted at the end.
class LogImages : public BagImages {
 public:
  explicit LogImages(const std::filesystem::path& log);
  LogImages(const LogImages&) = delete;
  LogImages& operator=(const LogImages&) = delete;
  ~LogImages() override;
  FileResult<FrameFile> keep(std::size_t number, Stamp stamp, const ImageView& image) override;

 private:
  std::filesystem::path file_;
  std::uint64_t size_ = 0;
};

/// The images of a run, through `images`; what cannot be read is counted. Errors: of what keeps them, or not one can be
/// read.
FileResult<void> read_bag_images(const BagFile& bag, const std::string& file, const BagTopic& topic, BagImages& images,
                                 BagRun& read);

}  // namespace azimuth
