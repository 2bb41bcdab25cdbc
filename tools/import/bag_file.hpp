#pragma once
// ROS bag files: ROS 1, MCAP, and ROS 2 in SQLite. A bag consists of one file or of several parts.

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

/// A sender of messages on a topic: a node in ROS 1, a channel in MCAP.
struct BagSender {
  std::string name;
  std::uint64_t messages = 0;
  Stamp first{}, last{};  ///< recording times
};

/// The messages of one type on one topic, from all senders.
struct BagTopic {
  std::string name;
  std::string type;       ///< for example sensor_msgs/Image
  SharedText definition;  ///< message definition, for RosDefinition
  std::string checksum;   ///< checksum of the definition
  RosVersion version = RosVersion::one;
  std::uint64_t messages = 0;
  Stamp first{}, last{};  ///< recording times
  std::vector<BagSender> senders = {};
  std::string sender = {};  ///< if not empty, only messages of this sender are used
  std::string frame = {};   ///< if not empty, read_bag_samples() uses only messages with this frame
};

/// True if a file has the first bytes or the name of a bag.
bool is_bag(const std::filesystem::path& file);

/// The parts, in order, of the bag in a folder. The parts are the files named in metadata.yaml (ROS 2), otherwise the
/// files whose names differ only by the last number (drive_0.bag, drive_1.bag). Fails if the folder contains no bag,
/// several bags, or not all parts of a bag.
FileResult<std::vector<std::filesystem::path>> bag_in_folder(const std::filesystem::path& folder);

/// Number of parts of the recording to which the file belongs; 1 if it is the only one.
std::size_t parts_beside(const std::filesystem::path& file);

/// A bag whose files are mapped into memory. Thread contract: thread-bound.
class BagFile {
 public:
  /// Reads the whole bag once. Accepts ROS 1 bags (format 2.0), MCAP, and ROS 2 databases. Rejects encrypted bags and
  /// bags that unpack to more than an UnpackBudget allows. An unclosed, truncated or damaged recording is read as far
  /// as possible. `progress` is called during each pass through the bag and may throw to end it.
  static FileResult<BagFile> open(const std::vector<std::filesystem::path>& parts, BagProgress progress = {});
  static FileResult<BagFile> open(const std::filesystem::path& file) { return open(std::vector{file}); }

  /// Topics that have messages, sorted by name.
  const std::vector<BagTopic>& topics() const { return topics_; }

  /// Damage of the bag as text for the user, for example "4096 damaged bytes, 1 damaged chunk"; empty if there is none.
  const std::string& damage() const { return damage_; }

  using Use = std::function<void(const Arrival& arrival, Bytes message)>;
  /// Calls `use` for each message of `topic`, in file order. The bytes are valid until `use` returns. Individually
  /// compressed messages are unpacked. The bytes are empty if a compressed message is damaged or unpacks to too much
  /// for the size of the file.
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
