#pragma once
// A recorded or simulated run, and its forms on disk: a folder of tables (docs/reference.md, "Run folders") and an LCM
// log, which a daemon splits into the segments of a session folder (session.hpp).
//
// A folder is written or exported by a person, so any violation makes it refused, with all violations named. A log is
// recorded by a robot, so it is used as far as possible, and skipped data are counted.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/file_result.hpp"
#include "drivers/storage/clock_jumps.hpp"
#include "drivers/wire/truth.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/sample/image.hpp"
#include "slam/sample/odometry.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth {

/// The position of an image in a log.
struct FramePart {
  std::uint64_t offset = 0;  ///< position of its first byte in the file
  std::uint64_t size = 0;
  FrameFormat format;  ///< as in the message; the header of a JPEG image is more reliable
  friend bool operator==(const FramePart&, const FramePart&) = default;
};

/// One image of a run: a separate JPEG or PNG file, or a part of a log.
struct FrameFile {
  Stamp stamp{};
  std::string file;  ///< relative to Run::folder
  std::optional<FramePart> part = std::nullopt;
  friend bool operator==(const FrameFile&, const FrameFile&) = default;
};

/// The data left out while reading, and the clock jumps repaired.
struct Skipped {
  std::vector<ClockJump> clock_jumps;  ///< jumps of the clock of the recording machine, or of a sensor
  // Records whose stamp repeats the previous one or, in a log, is out of order, for example because a clock jumped. As
  // few of such records as possible are left out.
  std::uint64_t odometry_not_in_order = 0;
  std::uint64_t bearings_not_in_order = 0;
  std::uint64_t truth_not_in_order = 0;
  std::uint64_t frames_not_in_order = 0;
  std::uint64_t empty_images = 0;  ///< files of zero bytes
  // For logs only.
  /// Invalid messages on the project's channels: wrong type, length or count, or values that are not finite or absurd.
  std::uint64_t malformed_messages = 0;
  /// Images with an unsupported pixel format.
  std::uint64_t unsupported_images = 0;
  std::uint64_t foreign_events = 0;  ///< events on channels of other programs
  /// A daemon's outputs (poses, maps, status), which are not needed for a replay.
  std::uint64_t output_events = 0;
  std::uint64_t damaged_bytes = 0;  ///< bytes outside complete events, including a truncated last event
  /// Segments of the session that are missing before or between the ones read: deleted, or not given.
  std::uint64_t missing_segments = 0;
  /// Events that the daemon could not write because the disk was full.
  std::uint64_t unrecorded_events = 0;
  // For the images that a session may hold in addition to its bearings.
  std::uint64_t missing_frame_segments = 0;
  std::uint64_t unrecorded_frames = 0;

  /// E.g. "3 odometry readings not in order, 17 damaged bytes"; empty when only outputs were skipped.
  std::string text() const;
  friend bool operator==(const Skipped&, const Skipped&) = default;
};

/// In each of odometry, bearings, truth and frames the stamps strictly increase.
struct Run {
  std::string name;                       ///< name of the folder, or of the log without its extension
  std::filesystem::path folder;           ///< paths of frame files are relative to it
  std::string rig_toml;                   ///< the text of rig.toml
  std::string rig_file;                   ///< name of that text in messages
  std::vector<OdometryReading> odometry;  ///< at least one
  std::vector<BearingSet> bearings;
  std::vector<FrameFile> frames;
  std::vector<TruthPose> truth;
  std::vector<TrueLandmark> landmarks;
  Skipped skipped;
  /// For a log with neither bearings nor images: "; perhaps --image-channel CAM", or empty.
  std::string perhaps;
  // For recordings of a daemon only, otherwise empty.
  std::string configuration_toml;  ///< the text of azimuth.toml: the estimator's configuration
  std::string configuration_file;  ///< name of that text in messages
  std::string map;                 ///< the bytes of the map file that the estimator started from
  /// The motion of the robot since that map, as given to the estimator.
  std::optional<OdometrySince> since_map;
  std::string recorded_by;  ///< version of the daemon
  /// False: the first segment is missing, so the recording does not contain the start of the estimator.
  bool from_the_start = true;
};

/// How a run is read and its log is written.
struct LogOptions {
  std::string channel_prefix = {};  ///< put before the project's channel names; events without it are foreign
  /// The channel of the images (image_t); messages of other types there are foreign. Other programs often record
  /// cameras, so the name is accepted with and without the prefix.
  std::string image_channel = "CAMERA";
  /// The channel of the odometry of another program: odometry_t, or bot_core's pose_t as a cumulative pose in the
  /// plane. The name is accepted with and without the prefix. Empty: the project's own channel.
  std::string odometry_channel = {};
  std::filesystem::path rig_file = {};  ///< replaces the run's own rig.toml; empty: the run's own is used
  bool odometry_alone = false;          ///< neither bearings nor images are required
  /// No rig is required either; without one, `rig_toml` is empty.
  bool rig_may_come_later = false;
};

/// A sentence for a person on how to make the first rig.toml of a run folder without one; for images it names a
/// command.
std::string first_rig(const std::filesystem::path& folder, bool has_images);

/// The earliest stamp of any sample or true pose; the epoch when there is none.
Stamp first_stamp(const Run& run);

/// Reads a run folder, a session folder (it has segments but no rig.toml; missing segments are counted), or an LCM log
/// when `path` is a file. On failure, returns all errors of all files, at most FileErrorList::kMost per file.
FileResult<Run> load_run(const std::filesystem::path& path, const LogOptions& options = {});

/// Reads truth.csv, and landmarks.csv unless its path is empty, in the format of run folders, and replaces the data in
/// `run`. For a recording whose truth comes from another source on the same clock. On errors, returns those of both
/// files and leaves `run` unchanged. Thread contract: reentrant.
FileErrors replace_truth(Run& run, const std::filesystem::path& truth_file,
                         const std::filesystem::path& landmarks_file = {});

/// Writes the tables of `run` into a folder, which is created if necessary. Existing tables are replaced or removed,
/// but a rig.toml stays when the run has none. JPEG images in a log become files below `frames`; image files are
/// neither copied nor changed. Values read back are equal bit for bit. Refuses data that tables cannot hold:
/// descriptors of features, images of a log that are not JPEG, and text with commas or line ends.
[[nodiscard]] FileResult<void> write_run_folder(const Run& run, const std::filesystem::path& folder);

/// Writes `run` as an LCM log, and replaces the file; values read back are equal bit for bit. Events are in the order
/// of their stamps. Documents come first; at equal stamps odometry comes before images, then bearings, then truth.
/// Frames become image messages; an unreadable frame becomes an empty message, so that it counts as unreadable there as
/// well. Refuses PNG images, for which messages have no format.
[[nodiscard]] FileResult<void> write_run_log(const Run& run, const std::filesystem::path& file,
                                             const LogOptions& options = {});

/// Called after each written record. An exception from it ends the writing, and leaves a part of the file.
using WriteProgress = std::function<void(std::size_t done, std::size_t all)>;

/// The same, for runs that take long.
[[nodiscard]] FileResult<void> write_run_log(const Run& run, const std::filesystem::path& file,
                                             const LogOptions& options, const WriteProgress& progress);

}  // namespace azimuth
