#pragma once
// Makes a run from the topics of a bag. Unusable messages are skipped and counted.
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

/// The wheel joints and their dimensions.
struct BagWheels {
  Wheels wheels;
  std::string left, right;  ///< joint names; empty: the joints whose names contain left and right
};

/// Intermediate result of the import of a bag.
struct BagRun {
  Run run;
  std::vector<Arrival> odometry, truth, frames;  ///< arrival of each sample of the run
  /// Distances that the wheels have rolled at the odometry readings; OdometryReading::sequence is the index. Empty if
  /// the bag contains poses.
  std::vector<WheelReading> rolled;
  Wheels wheels;                   ///< dimensions of the wheels of `rolled`
  std::vector<std::string> notes;  ///< deviations from the content of the bag, as text for the user
};

/// Reads odometry and truth of a run, in file order. Stamps are those of the message headers; if a header has none, the
/// recording time is used. If the orientation of odometry was never set, odometry is computed from its speeds. Fails if
/// no message is usable, or if several robots or frames are mixed.
FileResult<void> read_bag_samples(const BagFile& bag, const std::string& file, const BagChoice& choice,
                                  const BagWheels& wheels, BagRun& read);

/// Completes the run. Stamps are put in order and corrected where a clock was set; wheel counters are unwrapped;
/// restarts of the odometer are bridged. `notes` gets the notes of `read` and a note for each correction. Fails if
/// wheel_odometry() fails.
FileResult<Run> finish_bag_run(BagRun read, const std::string& file, std::vector<std::string>& notes);

/// Stores the images of a bag one by one.
class BagImages {
 public:
  virtual ~BagImages() = default;
  /// Stores an image.
  virtual FileResult<FrameFile> keep(std::size_t number, Stamp stamp, const ImageView& image) = 0;
};

/// Stores images as files of the run folder `out`. JPEG and PNG are copied; grey and colour images become PNG. Bayer
/// patterns and YUV are rejected, since PNG cannot hold them without loss. The files are written to `files`, by default
/// `out` itself.
class FolderImages : public BagImages {
 public:
  explicit FolderImages(const std::filesystem::path& out) : FolderImages(out, out) {}
  FolderImages(std::filesystem::path out, std::filesystem::path files)
      : out_(std::move(out)), files_(std::move(files)) {}
  FileResult<FrameFile> keep(std::size_t number, Stamp stamp, const ImageView& image) override;

 private:
  std::filesystem::path out_, files_;
};

/// Stores images in a temporary file beside `log`, from which write_run_log() reads them. The destructor deletes the
/// file.
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

/// Reads the images of a run and stores them with `images`. Unreadable images are counted. Fails if an image cannot be
/// stored or if no image is readable.
FileResult<void> read_bag_images(const BagFile& bag, const std::string& file, const BagTopic& topic, BagImages& images,
                                 BagRun& read);

}  // namespace azimuth
