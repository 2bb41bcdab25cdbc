#include "drivers/storage/kept_odometry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "base/files.hpp"
#include "drivers/storage/byte_order.hpp"
#include "drivers/wire/plausible.hpp"
#include "slam/geometry/principal_axes.hpp"

namespace azimuth {
namespace {

constexpr std::size_t kRoom = 192;  // largest size of a string [bytes]
constexpr std::size_t kPose = 3 * 8, kSymmetric = 6 * 8;
constexpr std::size_t kClock = 2 + kRoom + 2 * 8;
constexpr std::size_t kSince = 8 + (kPose + kSymmetric + 2 * 8) + (8 + 8 + 4 + kPose + 2 * 8) + kPose;
constexpr std::size_t kMemory = 2 * (2 + kRoom) + 4 + 8 + kPose + 8 * OdometerMemory::kMostNumbers;
constexpr std::size_t kSum = 4;
constexpr std::size_t kSize = kKeptOdometryMagic.size() + 4 + kClock + 4 + kSince + kMemory + kSum;

static_assert(std::tuple_size_v<KeptRecords> * kSize <= 4096, "a kill does not divide what is written to one page");

constexpr Duration kSlept{100'000};         // precision with which two clocks can be compared
constexpr double kLeastEigenvalue = -1e-9;  // tolerance for rounding in a covariance
constexpr double kMostCovariance = 1e6;     // largest plausible covariance [m^2]

void put(ByteWriter& writer, const std::string& text) {
  std::array<char, kRoom> room{};
  const std::size_t size = text.copy(room.data(), kRoom);
  writer.put(static_cast<std::uint16_t>(size));
  writer.bytes(room.data(), kRoom);
}

void put(ByteWriter& writer, const Pose2& pose) {
  for (const double value : {pose.x_m, pose.y_m, pose.heading_rad}) writer.put(value);
}

void put(ByteWriter& writer, const OdometrySince& since) {
  writer.put(to_us(since.map));
  put(writer, since.motion.T_start_end);
  for (Eigen::Index column = 0; column < 3; ++column)
    for (Eigen::Index row = column; row < 3; ++row) writer.put(since.motion.covariance(row, column));
  writer.put(since.motion.path_m);
  writer.put(since.motion.turned_rad);
  writer.put(to_us(since.reading.stamp));
  writer.put(since.reading.sequence);
  writer.put(since.reading.origin);
  put(writer, since.reading.T_odom_body);
  writer.put(since.reading.sigma_gap_m);
  writer.put(since.reading.sigma_gap_rad);
  put(writer, since.T_odom_body);
}

void put(ByteWriter& writer, const OdometerMemory& memory) {
  put(writer, memory.odometer);
  put(writer, memory.robot);
  writer.put(memory.origin);
  writer.put(to_us(memory.at));
  put(writer, memory.T_odom_body);
  for (const std::uint64_t number : memory.numbers) writer.put(number);
}

/// Reads values, and records whether all of them are plausible.
class Reader {
 public:
  explicit Reader(Bytes bytes) : bytes_(bytes) {}

  bool sound() const { return sound_; }
  template <class Integer>
  Integer get() {
    return bytes_.get<Integer>();
  }
  std::string text() {
    const std::size_t size = bytes_.get<std::uint16_t>();
    std::array<char, kRoom> room{};
    bytes_.bytes(room.data(), kRoom);
    expect(size <= kRoom &&
           std::all_of(room.begin() + std::min(size, kRoom), room.end(), [](char c) { return c == 0; }));
    return {room.data(), std::min(size, kRoom)};
  }
  Duration duration() {
    const auto us = bytes_.get<std::int64_t>();
    expect(is_plausible_stamp(us));
    return Duration{us};
  }
  Stamp stamp() { return Stamp{duration()}; }
  /// Reads a value that must not be negative.
  double amount() {
    const double value = bytes_.number();
    expect(is_plausible_sigma(value));
    return value;
  }
  Pose2 pose() {
    Pose2 pose;
    for (double* value : {&pose.x_m, &pose.y_m, &pose.heading_rad}) *value = bytes_.number();
    expect(is_plausible(pose));
    return pose;
  }
  Eigen::Matrix3d covariance() {
    Eigen::Matrix3d covariance;
    for (Eigen::Index column = 0; column < 3; ++column)
      for (Eigen::Index row = column; row < 3; ++row)
        covariance(row, column) = covariance(column, row) = bytes_.number();
    if (!(covariance.cwiseAbs().maxCoeff() <= kMostCovariance) || !covariance.allFinite()) {
      expect(false);
      return covariance;
    }
    expect(eigenvalues(covariance).minCoeff() >= kLeastEigenvalue);
    return covariance;
  }

 private:
  void expect(bool sound) { sound_ = sound_ && sound; }

  ByteReader bytes_;
  bool sound_ = true;
};

OdometrySince get_since(Reader& reader) {
  OdometrySince since;
  since.map = reader.stamp();
  since.motion.T_start_end = reader.pose();
  since.motion.covariance = reader.covariance();
  since.motion.path_m = reader.amount();
  since.motion.turned_rad = reader.amount();
  since.reading.stamp = reader.stamp();
  since.reading.sequence = reader.get<std::uint64_t>();
  since.reading.origin = reader.get<std::uint32_t>();
  since.reading.T_odom_body = reader.pose();
  since.reading.sigma_gap_m = reader.amount();
  since.reading.sigma_gap_rad = reader.amount();
  since.T_odom_body = reader.pose();
  return since;
}

OdometerMemory get_memory(Reader& reader) {
  OdometerMemory memory;
  memory.odometer = reader.text();
  memory.robot = reader.text();
  memory.origin = reader.get<std::uint32_t>();
  memory.at = reader.stamp();
  memory.T_odom_body = reader.pose();
  for (std::uint64_t& number : memory.numbers) number = reader.get<std::uint64_t>();
  return memory;
}

bool is_whole(Bytes bytes) {
  if (bytes.size() != kSize) return false;
  if (std::memcmp(bytes.data(), kKeptOdometryMagic.data(), kKeptOdometryMagic.size()) != 0) return false;
  return ByteReader(bytes.last(kSum)).get<std::uint32_t>() == checksum(bytes.first(kSize - kSum));
}

}  // namespace

void encode(const KeptOdometry& kept, std::vector<std::byte>& out) {
  ByteWriter writer(out, kSize);
  writer.bytes(kKeptOdometryMagic.data(), kKeptOdometryMagic.size());
  writer.put(kKeptOdometryVersion);
  put(writer, kept.clock.boot);
  writer.put(std::int64_t{kept.clock.asleep.count()});
  writer.put(std::int64_t{kept.clock.epoch_minus_monotonic.count()});
  writer.put(kept.map_checksum);
  put(writer, kept.since);
  put(writer, kept.odometer);
  writer.put(checksum(Bytes(out).first(writer.size())));
}

std::optional<KeptOdometry> decode_kept_odometry(Bytes bytes) {
  if (!is_whole(bytes)) return std::nullopt;
  Reader reader(bytes.subspan(kKeptOdometryMagic.size()));
  if (reader.get<std::uint32_t>() != kKeptOdometryVersion) return std::nullopt;
  KeptOdometry kept;
  kept.clock.boot = reader.text();
  kept.clock.asleep = reader.duration();
  kept.clock.epoch_minus_monotonic = reader.duration();
  kept.map_checksum = reader.get<std::uint32_t>();
  kept.since = get_since(reader);
  kept.odometer = get_memory(reader);
  return reader.sound() ? std::optional(kept) : std::nullopt;
}

std::filesystem::path kept_odometry_file(const std::filesystem::path& map) {
  return std::filesystem::path(map) += ".odometry";
}

KeptRecords read_kept_odometry(const std::filesystem::path& file) {
  KeptRecords records;
  const FileResult<MappedFile> mapped = MappedFile::open(file);
  if (!mapped) return records;
  const Bytes bytes = mapped->bytes();
  for (std::size_t i = 0; i < records.size() && bytes.size() >= (i + 1) * kSize; ++i)
    records[i] = decode_kept_odometry(bytes.subspan(i * kSize, kSize));
  return records;
}

std::optional<KeptOdometry> on_clock(KeptOdometry kept, const StampClock& clock) {
  const Duration slept = clock.asleep - kept.clock.asleep;
  if (kept.clock.boot != clock.boot || slept > kSlept || slept < -kSlept) return std::nullopt;
  const Duration shift = clock.epoch_minus_monotonic - kept.clock.epoch_minus_monotonic;
  kept.since.reading.stamp += shift;
  kept.odometer.at += shift;
  kept.clock = clock;
  return kept;
}

}  // namespace azimuth
