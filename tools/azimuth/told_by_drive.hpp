#pragma once
// What a drive tells of the rig, for azimuth calibrate RUN: as printed lines, comments of rig.toml, and rows of the
// page.

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tools/drive_fit/calibration.hpp"
#include "tools/drive_fit/drive_page.hpp"
#include "tools/drive_fit/tilt_calibration.hpp"

namespace azimuth {

/// Prints the findings of the requested parts, and keeps them as comments for the rig file and as rows of the page.
///
/// Thread contract: thread-bound.
class ToldByDrive {
 public:
  /// `only`: parts from kRigParts; empty: all parts. Without a rig (`has_rig`) its values are called defaults.
  ToldByDrive(bool quiet, std::vector<std::string> only, bool has_rig)
      : quiet_(quiet), has_rig_(has_rig), only_(std::move(only)) {}

  bool asks_for(std::string_view part) const;

  /// Prints a line and keeps it as the comment above its key in the file. `sentence` begins with "table.key = ". `row`
  /// needs neither part nor key; without a judgement it gets the usual one.
  void found(const std::string& part, const std::string& name, const std::string& sentence, FoundValue row);
  void found(const std::string& part, const std::string& sentence, FoundValue row) {
    found(part, part, sentence, std::move(row));
  }
  /// A row for the page alone.
  void also_found(FoundValue row) { rows_.push_back(std::move(row)); }
  void cannot_tell(const std::string& part, const std::string& name, const std::string& what_would);
  void cannot_tell(const std::string& part, const std::string& what_would) { cannot_tell(part, part, what_would); }
  /// The drive cannot be fitted at all.
  void cannot_tell_anything(const std::string& why);

  /// Returns `found` in the requested parts, and `said` in the others.
  Rig with_those_parts(Rig found, const Rig& said) const;
  bool any() const { return !notes_.empty(); }
  /// Returns the rig's text with the kept comments above the keys.
  std::string noted(const std::string& rig) const;

  const std::vector<FoundValue>& rows() const { return rows_; }
  const std::vector<UntoldValue>& untold() const { return untold_; }

 private:
  void print(const std::string& name, const std::string& sentence) const;

  bool quiet_, has_rig_;
  std::vector<std::string> only_;
  std::map<std::string, std::string> notes_;
  std::vector<FoundValue> rows_;
  std::vector<UntoldValue> untold_;
};

/// A heading known to three degrees is better than none, and the smoother refines it by its standard deviation.
inline constexpr double kTakenYaw_rad = 0.05;

/// Azimuth 0 of the rig's kind of camera: the number in heading_text().
double heading_of(const Rig& rig);

// Each function tells one part. `said` is the rig before the drive, `taken` the rig that is written.
/// `heading_rad`: the heading that fits best, in the terms of heading_of().
void tell(const HeadingCalibration& found, double heading_rad, const Rig& said, const Rig& taken,
          ToldByDrive& told_by_drive);
void tell(const TiltCalibration& found, const Rig& said, ToldByDrive& told_by_drive);
void tell(const OdometryCalibration& found, const OdometryRig& said, const OdometryRig& taken,
          ToldByDrive& told_by_drive);
/// `noise`: that of the bearings by the rig `said`.
void tell(const Smoother::Noise& noise, const Rig& said, const Rig& taken, ToldByDrive& told_by_drive);

}  // namespace azimuth
