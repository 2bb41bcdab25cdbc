#pragma once
// Bags of ROS as files: those of ROS 1, MCAP, and those of ROS 2 in SQLite; in one file or in parts.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "base/file_result.hpp"
#include "base/files.hpp"
#include "drivers/storage/clock_jumps.hpp"
#include "slam/sample/stamp.hpp"
#include "tools/bag/bag_records.hpp"

namespace azimuth {

/// Who sent messages on a topic: a node of ROS 1, a channel of MCAP.
struct BagSender {
  std::string name;
  std::uint64_t messages = 0;
  Stamp first{}, last{};  ///< when they were recorded
};

/// The messages of one type on one topic, whoever sent them.
struct BagTopic {
  std::string name;
  std::string type;       ///< sensor_msgs/Image
  SharedText definition;  ///< what it is made of, for RosDefinition
  std::string checksum;   ///< of the definition
  RosVersion version = RosVersion::one;
  std::uint64_t messages = 0;
  Stamp first{}, last{};  ///< when they were recorded
  std::vector<BagSender> senders = {};
  std::string sender = {};  ///< the one whose messages are meant; empty: all
  std::string frame = {};   ///< likewise, of the frame in the messages: read_bag_samples() looks at it
};

/// Whether a file begins as a bag does, or has the name of one.
bool is_bag(const std::filesystem::path& file);

/// The bag in a folder, its parts in their order: what metadata.yaml of ROS 2 names, else the files that differ by
/// their last number alone (drive_0.bag, drive_1.bag). Errors: it holds none, several, or not all parts.
FileResult<std::vector<std::filesystem::path>> bag_in_folder(const std::filesystem::path& folder);

/// How many parts of one recording lie beside a file that is one of them; 1: it is alone.
std::size_t parts_beside(const std::filesystem::path& file);

/// One bag, its files mapped into memory. Thread contract: thread-bound.
class BagFile {
 public:
  /// Reads all of it once. Refuses what is no bag of ROS 1's format 2.0, no MCAP and no database of ROS 2, one that is
  /// encrypted, and one that unpacks to more than an UnpackBudget allows. A recording that was never closed, is cut or
  /// damaged is read as far as it goes. `progress` is told of each time that it is gone through, and ends that by
  /// throwing.
  static FileResult<BagFile> open(const std::vector<std::filesystem::path>& parts, BagProgress progress = {});
  static FileResult<BagFile> open(const std::filesystem::path& file) { return open(std::vector{file}); }

  /// In the order of their names; those with messages only.
  const std::vector<BagTopic>& topics() const { return topics_; }

  /// What is wrong with it, for a person: "4096 damaged bytes, 1 damaged chunk"; empty: nothing.
  const std::string& damage() const { return damage_; }

  using Use = std::function<void(const Arrival& arrival, Bytes message)>;
  /// Calls `use` for each message of `topic`, in the order in which they lie; the bytes are valid until it returns. Of
  /// messages that are compressed one by one what is in them; nothing where that is damaged, or too much for a file of
  /// its size.
  void each(const BagTopic& topic, const Use& use) const;

 private:
  struct Part {
    std::uint64_t bytes = 0;
    bool is_mcap = false;
    std::function<BagDamage(const BagVisitor&)> visit;
    std::map<std::uint32_t, BagConnection> connections;
  };
  static FileResult<Part> open_part(const std::filesystem::path& file);
  BagDamage survey(Part& part);

  std::vector<Part> parts_;
  BagProgress progress_;
  std::vector<BagTopic> topics_;
  std::string damage_;
};

}  // namespace azimuth
