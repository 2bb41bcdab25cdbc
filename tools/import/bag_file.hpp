#pragma once
// Bags of ROS as files: those of ROS 1, and MCAP.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/file_result.hpp"
#include "base/files.hpp"
#include "slam/sample/stamp.hpp"
#include "tools/bag/bag_records.hpp"

namespace azimuth {

/// The messages of one type on one topic, whoever sent them.
struct BagTopic {
  std::string name;
  std::string type;       ///< sensor_msgs/Image
  SharedText definition;  ///< what it is made of, for RosDefinition
  std::string checksum;   ///< of the definition
  RosVersion version = RosVersion::one;
  std::uint64_t messages = 0;
  Stamp first{}, last{};  ///< when they were recorded
};

/// Whether a file begins as a bag does, or has the name of one.
bool is_bag(const std::filesystem::path& file);

/// The bag in a folder that ROS 2 recorded. Errors: it holds none that is read, or several.
FileResult<std::filesystem::path> bag_in_folder(const std::filesystem::path& folder);

/// One bag, mapped into memory. Thread contract: thread-bound.
class BagFile {
 public:
  /// Reads all of it once. Refuses what is no bag of ROS 1's format 2.0 and no MCAP, one that is encrypted, and one
  /// that unpacks to more than an UnpackBudget allows. A recording that was never closed, is cut or damaged is read as
  /// far as it goes. `progress` is told of each time that it is gone through, and ends that by throwing.
  static FileResult<BagFile> open(const std::filesystem::path& file, BagProgress progress = {});

  /// In the order of their names; those with messages only.
  const std::vector<BagTopic>& topics() const { return topics_; }

  /// What is wrong with it, for a person: "4096 damaged bytes, 1 damaged chunk"; empty: nothing.
  const std::string& damage() const { return damage_; }

  using Use = std::function<void(Stamp recorded, Bytes message)>;
  /// Calls `use` for each message of `topic`, in the order in which they lie; the bytes are valid until it returns.
  void each(const BagTopic& topic, const Use& use) const;

 private:
  using Visit = BagDamage (*)(Bytes file, const BagVisitor& visitor);
  BagFile(MappedFile file, Visit visit, BagProgress progress)
      : file_(std::move(file)), visit_(visit), progress_(std::move(progress)) {}
  BagDamage survey();

  MappedFile file_;
  Visit visit_;
  BagProgress progress_;
  std::map<std::uint32_t, BagConnection> connections_;
  std::vector<BagTopic> topics_;
  std::string damage_;
};

}  // namespace azimuth
