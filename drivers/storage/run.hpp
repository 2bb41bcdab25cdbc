#pragma once
// A recorded or simulated run, and its forms on disk: a folder of tables (docs/reference.md, "Run folders") and an LCM
// log, which a daemon cuts into the segments of a session folder (session.hpp).
//
// Read strictly: what a person wrote or exported (a folder) is refused with every violation named; what a robot
// recorded (a log) is used as far as it goes, and what is skipped is counted.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/file_result.hpp"
#include "drivers/storage/clock_jumps.hpp"
#include "drivers/wire/truth.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/sample/image.hpp"
#include "slam/sample/odometry.hpp"
#include "slam/sample/odometry_since.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth {

/// Where an image lies in a log.
struct FramePart {
  std::uint64_t offset = 0;  ///< of its first byte in the file
  std::uint64_t size = 0;
  FrameFormat format;  ///< as the message says; of a JPEG image its header says it better
  friend bool operator==(const FramePart&, const FramePart&) = default;
};

/// One image of a run: a JPEG or PNG file of its own, or a part of a log.
struct FrameFile {
  Stamp stamp{};
  std::string file;  ///< relative to Run::folder
  std::optional<FramePart> part = std::nullopt;
  friend bool operator==(const FrameFile&, const FrameFile&) = default;
};

/// What was left out while reading, and what stamps had to be moved.
struct Skipped {
  std::vector<ClockJump> clock_jumps;  ///< of the recording machine, or of a sensor
  // Records whose stamp repeats the last one's or, in a log, lies out of order: a clock that jumped. Of such records
  // as few as possible are left out.
  std::uint64_t odometry_not_in_order = 0;
  std::uint64_t bearings_not_in_order = 0;
  std::uint64_t truth_not_in_order = 0;
  std::uint64_t frames_not_in_order = 0;
  std::uint64_t empty_images = 0;  ///< files without a byte
  // Logs only.
  std::uint64_t malformed_messages = 0;  ///< on our channels: wrong type, length or count, values not finite or absurd
  std::uint64_t unsupported_images = 0;  ///< of pixel formats that nothing here can read
  std::uint64_t foreign_events = 0;      ///< on channels of others
  std::uint64_t output_events = 0;       ///< what a daemon published: poses, maps, status; not needed to replay
  std::uint64_t damaged_bytes = 0;       ///< not part of any whole event, a cut last event included
  std::uint64_t missing_segments = 0;  ///< of the session, between the ones read and before them: deleted, or not given
  std::uint64_t unrecorded_events = 0;  ///< which the daemon could not write: the disk was full
  // Of the images that a session may hold beside its bearings.
  std::uint64_t missing_frame_segments = 0;
  std::uint64_t unrecorded_frames = 0;

  std::uint64_t records_not_in_order() const {
    return odometry_not_in_order + bearings_not_in_order + truth_not_in_order + frames_not_in_order;
  }
  /// E.g. "3 odometry readings not in order, 17 damaged bytes"; empty when nothing was skipped but outputs.
  std::string text() const;
  friend bool operator==(const Skipped&, const Skipped&) = default;
};

/// Stamps strictly increase within each of odometry, bearings, truth and frames.
struct Run {
  std::string name;                       ///< of the folder, or of the log without its extension
  std::filesystem::path folder;           ///< what the frames' files are relative to
  std::string rig_toml;                   ///< the text of rig.toml
  std::string rig_file;                   ///< how messages about that text should name it
  std::vector<OdometryReading> odometry;  ///< at least one
  std::vector<BearingSet> bearings;
  std::vector<FrameFile> frames;
  std::vector<TruthPose> truth;
  std::vector<TrueLandmark> landmarks;
  Skipped skipped;
  std::string perhaps;  ///< of a log with neither bearings nor images: "; perhaps --image-channel CAM", or empty
  // Recordings of a daemon only, else empty.
  std::string configuration_toml;          ///< the text of azimuth.toml: what the estimator was told
  std::string configuration_file;          ///< how messages about that text should name it
  std::string map;                         ///< the bytes of the map file that the estimator started from
  std::optional<OdometrySince> since_map;  ///< how the robot had gone on from there, as the estimator was told
  std::string recorded_by;                 ///< version of the daemon
  bool from_the_start = true;  ///< false: the first segment is missing, so the estimator was not at its start
};

/// How a run is read, and its log written.
struct LogOptions {
  std::string channel_prefix = {};  ///< before each of our channel names; events without it are foreign
  /// Of the images (image_t); what else is found there is foreign. Cameras are often recorded by programs of others, so
  /// its name counts with the prefix and without it.
  std::string image_channel = "CAMERA";
  /// Of the odometry, when that is another program's: odometry_t, or bot_core's pose_t as a cumulative pose in the
  /// plane. Its name counts with the prefix and without it. Empty: our own.
  std::string odometry_channel = {};
  std::filesystem::path rig_file = {};  ///< in place of the run's own rig.toml; empty: that is used
  bool odometry_alone = false;          ///< neither bearings nor images are needed
  bool rig_may_come_later = false;      ///< no rig is needed either; where there is none, `rig_toml` is empty
};

/// What makes the first rig.toml of a run folder that has none, for a person: a command, where it is for images.
std::string first_rig(const std::filesystem::path& folder, bool has_images);

/// The earliest stamp of any sample or true pose; that of the epoch when there is none.
Stamp first_stamp(const Run& run);

/// Reads a run folder, a session folder (segments but no rig.toml in it; some may be missing, which is counted), or an
/// LCM log when `path` is a file. All errors of all files, at most FileErrorList::kMost a file.
FileResult<Run> load_run(const std::filesystem::path& path, const LogOptions& options = {});

/// Reads truth.csv, and landmarks.csv unless its path is empty, in the form they have in run folders, in place of what
/// `run` holds of either: for a recording whose truth is known elsewhere, stamped by the same clock. All errors of both
/// files; `run` is then left as it was. Reentrant.
FileErrors replace_truth(Run& run, const std::filesystem::path& truth_file,
                         const std::filesystem::path& landmarks_file = {});

/// Writes the tables of `run` into a folder, made if need be; tables already there are replaced or removed, but a
/// rig.toml stays when the run has none. JPEG images that lie in a log become files below `frames`; image files are
/// neither copied nor touched. Values read back are equal bit for bit. Refuses what tables cannot hold: what features
/// look like, images of a log that are not JPEG, text with commas or line ends.
[[nodiscard]] FileResult<void> write_run_folder(const Run& run, const std::filesystem::path& folder);

/// Writes `run` as an LCM log, replacing the file; values read back are equal bit for bit. Events are in the order of
/// their stamps: documents first, then odometry before images before bearings before truth at equal stamps. Frames
/// become image messages; one that cannot be read becomes an empty one, so that it counts as unreadable there as well.
/// Refuses PNG images, which messages have no format for.
[[nodiscard]] FileResult<void> write_run_log(const Run& run, const std::filesystem::path& file,
                                             const LogOptions& options = {});

}  // namespace azimuth
