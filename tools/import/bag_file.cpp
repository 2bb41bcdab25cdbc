#include "tools/import/bag_file.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <memory>
#include <span>
#include <string_view>
#include <tuple>
#include <utility>

#include "base/packed_file.hpp"
#include "tools/bag/unpacked_file.hpp"

namespace azimuth {
namespace {

// Built-in definitions of the ROS 2 messages that the import uses. Databases before ROS 2 Iron contain no definitions.

constexpr std::string_view kKnownHeader =
    "===== \nMSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n"
    "===== \nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n";

constexpr std::string_view kKnownPose =
    "===== \nMSG: geometry_msgs/Pose\nPoint position\nQuaternion orientation\n"
    "===== \nMSG: geometry_msgs/Point\nfloat64 x\nfloat64 y\nfloat64 z\n"
    "===== \nMSG: geometry_msgs/Quaternion\nfloat64 x\nfloat64 y\nfloat64 z\nfloat64 w\n"
    "===== \nMSG: geometry_msgs/PoseWithCovariance\nPose pose\nfloat64[36] covariance\n";

constexpr std::string_view kKnownTwist =
    "===== \nMSG: geometry_msgs/TwistWithCovariance\nTwist twist\nfloat64[36] covariance\n"
    "===== \nMSG: geometry_msgs/Twist\nVector3 linear\nVector3 angular\n"
    "===== \nMSG: geometry_msgs/Vector3\nfloat64 x\nfloat64 y\nfloat64 z\n";

struct KnownType {
  std::string_view name, fields;
  bool has_pose = false, has_twist = false;
};

constexpr std::array<KnownType, 7> kKnownTypes{
    {{"nav_msgs/Odometry",
      "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/PoseWithCovariance pose\n"
      "geometry_msgs/TwistWithCovariance twist\n",
      true, true},
     {"geometry_msgs/PoseStamped", "std_msgs/Header header\nPose pose\n", true},
     {"geometry_msgs/PoseWithCovarianceStamped", "std_msgs/Header header\nPoseWithCovariance pose\n", true},
     {"sensor_msgs/JointState",
      "std_msgs/Header header\nstring[] name\nfloat64[] position\nfloat64[] velocity\nfloat64[] effort\n"},
     {"sensor_msgs/Image",
      "std_msgs/Header header\nuint32 height\nuint32 width\nstring encoding\nuint8 is_bigendian\nuint32 step\n"
      "uint8[] data\n"},
     {"sensor_msgs/CompressedImage", "std_msgs/Header header\nstring format\nuint8[] data\n"},
     {"tf2_msgs/TFMessage",
      "geometry_msgs/TransformStamped[] transforms\n"
      "===== \nMSG: geometry_msgs/TransformStamped\nstd_msgs/Header header\nstring child_frame_id\n"
      "Transform transform\n"
      "===== \nMSG: geometry_msgs/Transform\nVector3 translation\nQuaternion rotation\n",
      true, true}}};

/// The definition of a type such as sensor_msgs/Image, for RosDefinition; empty for other types.
std::string known_definition(std::string_view type) {
  const auto known = std::ranges::find(kKnownTypes, type, &KnownType::name);
  if (known == kKnownTypes.end()) return {};
  std::string definition(known->fields);
  definition += kKnownHeader;
  if (known->has_pose) definition += kKnownPose;
  if (known->has_twist) definition += kKnownTwist;
  return definition;
}

constexpr std::string_view kAnyVersion = "#ROSBAG V";
constexpr std::array<std::string_view, 4> kBeginnings{kAnyVersion, kMcapMagic, kDatabaseMagic, kZstdMagic};
constexpr std::array<std::string_view, 3> kExtensions{".bag", ".mcap", ".db3"};

std::string sender_of(const BagConnection& connection) {
  return connection.sender.empty() ? "channel " + std::to_string(connection.id) : connection.sender;
}

bool is_of(const BagTopic& topic, const BagConnection& connection) {
  return topic.name == connection.topic && topic.type == connection.type && topic.checksum == connection.checksum &&
         (topic.sender.empty() || topic.sender == sender_of(connection));
}

std::string in_words(const BagDamage& damage, std::uint64_t strays) {
  std::string words = damage.database.empty() ? "" : "the database " + damage.database;
  const auto append = [&words](std::uint64_t count, const char* what) {
    if (count > 0) words += (words.empty() ? "" : ", ") + std::to_string(count) + ' ' + what;
  };
  append(damage.bytes, "damaged bytes");
  append(damage.chunks, "damaged chunks");
  append(strays, "messages of topics whose names are lost");
  return words;
}

std::string beyond_budget(std::size_t file_B, bool is_mcap) {
  const std::uint64_t most_MB = (kFreeUnpackingBytes + kUnpackingRatio * file_B) >> 20U;
  const bool is_tiny = file_B < 10'000;
  return "its " + std::to_string(is_tiny ? file_B : file_B / 1024) + (is_tiny ? " bytes" : " kB") +
         " unpack to more than " + std::to_string(most_MB) +
         " MB, or hold so few records that to find them is as much work, which is how a file is made that fills memory "
         "or time; where images without change explain it, unpack it "
         "first: " +
         (is_mcap ? "mcap compress --compression none" : "rosbag decompress");
}

/// Error text for a file that does not begin like a bag.
std::string what_instead(Bytes bytes) {
  const std::string_view packed = packed_as(bytes);
  return packed.empty() ? "is not a bag: it begins neither as those of ROS 1 nor as MCAP nor as a database of ROS 2"
                        : std::string(packed);
}

/// Number and period of the messages of a connection.
struct Tally {
  std::uint64_t messages = 0;
  Stamp first{}, last{};
};

/// Adds a tally to a topic or a sender.
template <class Total>
void add(Total& total, const Tally& tally) {
  if (total.messages == 0) std::tie(total.first, total.last) = std::tie(tally.first, tally.last);
  total.messages += tally.messages;
  total.first = std::min(total.first, tally.first);
  total.last = std::max(total.last, tally.last);
}

void add(std::vector<BagTopic>& topics, const BagConnection& connection, const Tally& tally) {
  auto topic = std::ranges::find_if(topics, [&](const BagTopic& each) { return is_of(each, connection); });
  if (topic == topics.end())
    topic = topics.insert(
        topic, {connection.topic, connection.type, connection.definition, connection.checksum, connection.version});
  add(*topic, tally);
  auto sender = std::ranges::find(topic->senders, sender_of(connection), &BagSender::name);
  if (sender == topic->senders.end()) sender = topic->senders.insert(sender, {sender_of(connection)});
  add(*sender, tally);
}

/// Unpacks individually compressed messages, up to most_unpacked() bytes for all messages of a file.
class MessageUnpacker {
 public:
  explicit MessageUnpacker(std::uint64_t file_bytes) : left_(most_unpacked(file_bytes)) {}

  /// The content of a message; empty if it cannot be unpacked.
  Bytes operator()(const BagConnection& connection, Bytes message) {
    // No CDR message begins with the Zstandard magic number.
    if (connection.version != RosVersion::two || !as_text(message).starts_with(kZstdMagic)) return message;
    const bool is_whole = unpack_message(message, left_, unpacked_);
    left_ -= std::min<std::uint64_t>(left_, unpacked_.size());
    return is_whole ? Bytes(unpacked_) : Bytes{};
  }

 private:
  std::uint64_t left_;
  std::vector<std::byte> unpacked_;
};

}  // namespace

bool is_bag(const std::filesystem::path& file) {
  const auto has = [](const std::filesystem::path& name) {
    return std::ranges::count(kExtensions, name.extension()) > 0;
  };
  if (has(file) || ((file.extension() == ".zstd" || file.extension() == ".zst") && has(file.stem()))) return true;
  std::array<char, 16> start{};
  std::ifstream(file, std::ios::binary).read(start.data(), start.size());
  const std::string_view begin(start.data(), start.size());
  return std::ranges::any_of(std::span(kBeginnings).first(3),
                             [&](std::string_view each) { return begin.starts_with(each); });
}

FileResult<BagFile::Part> BagFile::open_part(const std::filesystem::path& file) {
  FileResult<MappedFile> mapped = MappedFile::open(file);
  if (!mapped) return failure(mapped.error());
  const std::string_view begin = as_text(mapped->bytes());
  if (begin.starts_with(kZstdMagic)) {
    FileResult<UnpackedFile> unpacked = UnpackedFile::make(file, mapped->bytes());
    if (!unpacked) return failure(unpacked.error());
    const auto kept = std::make_shared<UnpackedFile>(*std::move(unpacked));
    FileResult<Part> part = open_part(kept->path());
    if (!part) return failure(FileError{file.string(), 0, "holds no bag that was compressed by zstd"});
    part->visit = [kept, visit = std::move(part->visit)](const BagVisitor& visitor) { return visit(visitor); };
    return part;
  }
  const auto bytes = std::make_shared<MappedFile>(*std::move(mapped));
  Part part;
  part.bytes = bytes->bytes().size();
  part.is_mcap = begin.starts_with(kMcapMagic);
  if (begin.starts_with(kDatabaseMagic))
    part.visit = [file](const BagVisitor& visitor) { return visit_database(file, visitor); };
  else if (part.is_mcap)
    part.visit = [bytes](const BagVisitor& visitor) { return visit_mcap(bytes->bytes(), visitor); };
  else if (begin.starts_with(kBagMagic))
    part.visit = [bytes](const BagVisitor& visitor) { return visit_bag(bytes->bytes(), visitor); };
  else if (begin.starts_with(kAnyVersion))
    return failure(FileError{file.string(), 0, "is a bag of a format before 2.0, which is not read"});
  else
    return failure(FileError{file.string(), 0, what_instead(bytes->bytes())});
  return FileResult<Part>(std::move(part));
}

FileResult<BagFile> BagFile::open(const std::vector<std::filesystem::path>& parts, BagProgress progress) {
  BagFile bag;
  bag.progress_ = std::move(progress);
  for (const std::filesystem::path& file : parts) {
    FileResult<Part> part = open_part(file);
    if (!part) return failure(part.error());
    const BagDamage damage = bag.survey(*part);
    if (damage.encrypted) return failure(FileError{file.string(), 0, "is encrypted; rosbag decrypt opens it"});
    if (damage.beyond_budget) return failure(FileError{file.string(), 0, beyond_budget(part->bytes, part->is_mcap)});
    bag.parts_.push_back(*std::move(part));
  }
  std::ranges::sort(bag.topics_, [](const BagTopic& a, const BagTopic& b) {
    return std::tie(a.name, a.type, a.checksum) < std::tie(b.name, b.type, b.checksum);
  });
  return FileResult<BagFile>(std::move(bag));
}

BagDamage BagFile::survey(Part& part) {
  std::map<std::uint32_t, Tally> tallies;
  BagVisitor visitor;
  visitor.progress = progress_;
  visitor.connection = [&part](const BagConnection& said) {
    BagConnection connection = said;
    if (connection.version == RosVersion::two && std::string_view(connection.definition).empty())
      connection.definition = known_definition(connection.type);
    part.connections.try_emplace(connection.id, std::move(connection));
  };
  visitor.message = [&tallies](std::uint32_t connection, Stamp recorded, Bytes) {
    Tally& tally = tallies[connection];
    if (tally.messages++ == 0) tally.first = tally.last = recorded;
    tally.first = std::min(tally.first, recorded);
    tally.last = std::max(tally.last, recorded);
  };
  const BagDamage damage = part.visit(visitor);

  std::uint64_t strays = 0;
  for (const auto& [id, tally] : tallies) {
    const auto connection = part.connections.find(id);
    if (connection == part.connections.end())
      strays += tally.messages;
    else
      add(topics_, connection->second, tally);
  }
  if (const std::string words = in_words(damage, strays); !words.empty())
    damage_ += (damage_.empty() ? "" : ", ") + words;
  return damage;
}

void BagFile::each(const BagTopic& topic, const Use& use) const {
  Arrival arrival;
  for (const Part& part : parts_) {
    MessageUnpacker unpacked(part.bytes);
    BagVisitor visitor;
    visitor.progress = progress_;
    visitor.connection = [](const BagConnection&) {};
    visitor.message = [&](std::uint32_t id, Stamp recorded, Bytes message) {
      ++arrival.place;
      arrival.recorded = recorded;
      const auto connection = part.connections.find(id);
      if (connection != part.connections.end() && is_of(topic, connection->second))
        use(arrival, unpacked(connection->second, message));
    };
    part.visit(visitor);
  }
}

}  // namespace azimuth
