#include "tools/import/bag_file.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <string_view>
#include <tuple>

namespace azimuth {
namespace {

constexpr std::string_view kAnyVersion = "#ROSBAG V";

/// Whether a file begins with `magic`.
bool begins_with(Bytes bytes, std::string_view magic) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  return text.starts_with(magic);
}

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

/// How many messages of a connection there are, and when.
struct Tally {
  std::uint64_t messages = 0;
  Stamp first{}, last{};
};

}  // namespace

bool is_bag(const std::filesystem::path& file) {
  std::array<char, kAnyVersion.size()> start{};
  std::ifstream(file, std::ios::binary).read(start.data(), start.size());
  return file.extension() == ".bag" || std::string_view(start.data(), start.size()) == kAnyVersion;
}

FileResult<BagFile> BagFile::open(const std::filesystem::path& file) {
  FileResult<MappedFile> mapped = MappedFile::open(file);
  if (!mapped) return failure(mapped.error());
  if (!begins_with(mapped->bytes(), kAnyVersion))
    return failure(FileError{file.string(), 0, "is not a bag of ROS 1: it does not begin as one"});
  if (!begins_with(mapped->bytes(), kBagMagic))
    return failure(FileError{file.string(), 0, "is a bag of a format before 2.0, which is not read"});
  BagFile bag(*std::move(mapped));
  if (bag.survey().encrypted) return failure(FileError{file.string(), 0, "is encrypted; rosbag decrypt opens it"});
  return FileResult<BagFile>(std::move(bag));
}

BagDamage BagFile::survey() {
  std::map<std::uint32_t, Tally> tallies;
  BagVisitor visitor;
  visitor.connection = [this](const BagConnection& connection) { connections_.try_emplace(connection.id, connection); };
  visitor.message = [&tallies](std::uint32_t connection, Stamp recorded, Bytes) {
    Tally& tally = tallies[connection];
    if (tally.messages++ == 0) tally.first = tally.last = recorded;
    tally.first = std::min(tally.first, recorded);
    tally.last = std::max(tally.last, recorded);
  };
  const BagDamage damage = visit_bag(file_.bytes(), visitor);

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
      topics_.push_back({sender.topic, sender.type, sender.definition, sender.checksum, 0, tally.first, tally.last});
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
  visitor.connection = [](const BagConnection&) {};
  visitor.message = [&](std::uint32_t id, Stamp recorded, Bytes message) {
    const auto connection = connections_.find(id);
    if (connection != connections_.end() && is_of(topic, connection->second)) use(recorded, message);
  };
  visit_bag(file_.bytes(), visitor);
}

}  // namespace azimuth
