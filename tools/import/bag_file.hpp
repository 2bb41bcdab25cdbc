#pragma once
// Bags of ROS 1 as files.

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
#include "tools/import/bag_records.hpp"

namespace azimuth {

/// The messages of one type on one topic, whoever sent them.
struct BagTopic {
  std::string name;
  std::string type;        ///< sensor_msgs/Image
  std::string definition;  ///< what it is made of, for RosDefinition
  std::string checksum;    ///< of the definition
  std::uint64_t messages = 0;
  Stamp first{}, last{};  ///< when they were recorded
};

/// Whether a file begins as a bag does, or has the name of one.
bool is_bag(const std::filesystem::path& file);

/// One bag, mapped into memory. Thread contract: thread-bound.
class BagFile {
 public:
  /// Reads all of it once. Refuses what is no bag of format 2.0, and one that is encrypted. A recording that was never
  /// closed, is cut or damaged is read as far as it goes.
  static FileResult<BagFile> open(const std::filesystem::path& file);

  /// In the order of their names; those with messages only.
  const std::vector<BagTopic>& topics() const { return topics_; }

  /// What is wrong with it, for a person: "4096 damaged bytes, 1 damaged chunk"; empty: nothing.
  const std::string& damage() const { return damage_; }

  using Use = std::function<void(Stamp recorded, Bytes message)>;
  /// Calls `use` for each message of `topic`, in the order in which they lie; the bytes are valid until it returns.
  void each(const BagTopic& topic, const Use& use) const;

 private:
  explicit BagFile(MappedFile file) : file_(std::move(file)) {}
  BagDamage survey();

  MappedFile file_;
  std::map<std::uint32_t, BagConnection> connections_;
  std::vector<BagTopic> topics_;
  std::string damage_;
};

}  // namespace azimuth
