#include "tools/import/bag_file.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <string_view>
#include <tuple>

namespace azimuth {
namespace {

constexpr std::string_view kAnyVersion = "#ROSBAG V";
constexpr const char* kMcap = ".mcap";

constexpr std::size_t kLongestMagic = std::max(kAnyVersion.size(), kMcapMagic.size());

bool is_of(const BagTopic& topic, const BagConnection& connection) {
  return topic.name == connection.topic && topic.type == connection.type && topic.checksum == connection.checksum;
}

std::string in_words(const BagDamage& damage, std::uint64_t strays) {
  std::string words;
  const auto append = [&words](std::uint64_t count, const char* what) {
    if (count > 0) words += (words.empty() ? "" : ", ") + std::to_string(count) + ' ' + what;
  };
  append(damage.bytes, "damaged bytes");
  append(damage.chunks, "damaged chunks");
  append(strays, "messages of topics whose names are lost");
  return words;
}

std::string beyond_budget(std::size_t file_B, bool is_mcap) {
  const std::uint64_t most_MB = (kFreeUnpacking_B + kUnpackingRatio * file_B) >> 20U;
  const bool is_tiny = file_B < 10'000;
  return "its " + std::to_string(is_tiny ? file_B : file_B / 1024) + (is_tiny ? " bytes" : " kB") +
         " unpack to more than " + std::to_string(most_MB) +
         " MB, which is how a file is made that fills memory; where images without change explain it, unpack it "
         "first: " +
         (is_mcap ? "mcap compress --compression none" : "rosbag decompress");
}

/// How many messages of a connection there are, and when.
struct Tally {
  std::uint64_t messages = 0;
  Stamp first{}, last{};
};

}  // namespace

bool is_bag(const std::filesystem::path& file) {
  if (file.extension() == ".bag" || file.extension() == kMcap) return true;
  std::array<char, kLongestMagic> start{};
  std::ifstream(file, std::ios::binary).read(start.data(), start.size());
  const std::string_view begin(start.data(), start.size());
  return begin.starts_with(kAnyVersion) || begin.starts_with(kMcapMagic);
}

FileResult<std::filesystem::path> bag_in_folder(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> found;
  bool has_database = false;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    if (entry.path().extension() == kMcap) found.push_back(entry.path());
    has_database = has_database || entry.path().extension() == ".db3";
  }
  const auto refusal = [&](const std::string& why) { return failure(FileError{folder.string(), 0, why}); };
  if (found.size() == 1) return found.front();
  if (!found.empty())
    return refusal("holds " + std::to_string(found.size()) +
                   " MCAP files: import one of them, or make them one: ros2 bag convert");
  return refusal(has_database ? "is a bag of ROS 2 in SQLite, which is not read: make it MCAP (ros2 bag convert, "
                                "storage_id: mcap)"
                              : "is a folder: SOURCE is a table of odometry or a bag");
}

FileResult<BagFile> BagFile::open(const std::filesystem::path& file, BagProgress progress) {
  FileResult<MappedFile> mapped = MappedFile::open(file);
  if (!mapped) return failure(mapped.error());
  const std::string_view begin = as_text(mapped->bytes());
  const bool is_mcap = begin.starts_with(kMcapMagic);
  if (!is_mcap && !begin.starts_with(kAnyVersion))
    return failure(FileError{file.string(), 0, "is not a bag: it begins neither as those of ROS 1 nor as MCAP"});
  if (!is_mcap && !begin.starts_with(kBagMagic))
    return failure(FileError{file.string(), 0, "is a bag of a format before 2.0, which is not read"});
  BagFile bag(*std::move(mapped), is_mcap ? visit_mcap : visit_bag, std::move(progress));
  const BagDamage damage = bag.survey();
  if (damage.encrypted) return failure(FileError{file.string(), 0, "is encrypted; rosbag decrypt opens it"});
  if (damage.beyond_budget)
    return failure(FileError{file.string(), 0, beyond_budget(bag.file_.bytes().size(), is_mcap)});
  return FileResult<BagFile>(std::move(bag));
}

BagDamage BagFile::survey() {
  std::map<std::uint32_t, Tally> tallies;
  BagVisitor visitor;
  visitor.progress = progress_;
  visitor.connection = [this](const BagConnection& connection) { connections_.try_emplace(connection.id, connection); };
  visitor.message = [&tallies](std::uint32_t connection, Stamp recorded, Bytes) {
    Tally& tally = tallies[connection];
    if (tally.messages++ == 0) tally.first = tally.last = recorded;
    tally.first = std::min(tally.first, recorded);
    tally.last = std::max(tally.last, recorded);
  };
  const BagDamage damage = visit_(file_.bytes(), visitor);

  std::uint64_t strays = 0;
  for (const auto& [id, tally] : tallies) {
    const auto connection = connections_.find(id);
    if (connection == connections_.end()) {
      strays += tally.messages;
      continue;
    }
    const BagConnection& sender = connection->second;
    auto topic =
        std::find_if(topics_.begin(), topics_.end(), [&](const BagTopic& each) { return is_of(each, sender); });
    if (topic == topics_.end()) {
      topics_.push_back(
          {sender.topic, sender.type, sender.definition, sender.checksum, sender.version, 0, tally.first, tally.last});
      topic = topics_.end() - 1;
    }
    topic->messages += tally.messages;
    topic->first = std::min(topic->first, tally.first);
    topic->last = std::max(topic->last, tally.last);
  }
  std::sort(topics_.begin(), topics_.end(), [](const BagTopic& a, const BagTopic& b) {
    return std::tie(a.name, a.type, a.checksum) < std::tie(b.name, b.type, b.checksum);
  });
  damage_ = in_words(damage, strays);
  return damage;
}

void BagFile::each(const BagTopic& topic, const Use& use) const {
  BagVisitor visitor;
  visitor.progress = progress_;
  visitor.connection = [](const BagConnection&) {};
  visitor.message = [&](std::uint32_t id, Stamp recorded, Bytes message) {
    const auto connection = connections_.find(id);
    if (connection != connections_.end() && is_of(topic, connection->second)) use(recorded, message);
  };
  visit_(file_.bytes(), visitor);
}

}  // namespace azimuth
