#include "drivers/storage/map_codec.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "drivers/storage/byte_order.hpp"
#include "drivers/wire/plausible.hpp"

namespace azimuth {
namespace {

// Tolerance for negative eigenvalues of the correlations due to rounding. A filter works with them all the same.
constexpr double kRounding = 1e-6;
constexpr double kMostVariance = 1e12;

bool is_plausible(const MapLandmark& landmark) {
  return landmark.id >= 0 && is_plausible_identity(landmark.identity) && is_plausible_kind(landmark.kind) &&
         is_plausible_coordinate(landmark.p_map_landmark_m.x()) &&
         is_plausible_coordinate(landmark.p_map_landmark_m.y()) &&
         (!landmark.has_height() || is_plausible_coordinate(landmark.z_map_landmark_m));
}

bool repeats(std::vector<std::int64_t>& values) {
  std::ranges::sort(values);
  return std::ranges::adjacent_find(values) != values.end();
}

/// The correlations, which have the same scale for all units. None when the matrix is evidently not a covariance.
std::optional<Eigen::MatrixXd> correlations(const PackedSymmetric& P) {
  const std::size_t size = P.size();
  std::vector<double> scale(size);
  for (std::size_t i = 0; i < size; ++i) {
    if (!(P(i, i) >= 0.0 && P(i, i) <= kMostVariance)) return std::nullopt;
    scale[i] = P(i, i) > 0.0 ? 1.0 / std::sqrt(P(i, i)) : 0.0;
  }
  Eigen::MatrixXd R(size, size);
  for (std::size_t c = 0; c < size; ++c) {
    const auto column = P.below(c);
    for (std::size_t r = c; r < size; ++r) {
      const double correlation = column[r - c] * scale[r] * scale[c];
      const bool certain = scale[r] == 0.0 || scale[c] == 0.0;
      if (!(std::abs(correlation) <= 1.0 + kRounding) || (certain && column[r - c] != 0.0)) return std::nullopt;
      R(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) = correlation;
    }
  }
  return R;
}

bool is_covariance(const PackedSymmetric& P) {
  auto R = correlations(P);
  if (!R) return false;
  R->diagonal().array() += kRounding;
  Eigen::Ref<Eigen::MatrixXd> in_place(*R);
  return Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>>(in_place).info() == Eigen::Success;
}

std::optional<std::string> problem_with_views(const MapSnapshot& map) {
  if (map.names != MapNames::looks && !map.views.empty()) return "has looks of landmarks that are not known by them";
  std::vector<std::int64_t> identities;
  for (const MapLandmark& landmark : map.landmarks) identities.push_back(landmark.identity);
  std::ranges::sort(identities);
  for (const MapView& view : map.views) {
    if (!is_plausible_coordinate(view.p_map_robot_m.x()) || !is_plausible_coordinate(view.p_map_robot_m.y()))
      return "has looks from an absurd place";
    if (!std::ranges::binary_search(identities, view.identity)) return "has looks of a landmark it has not";
  }
  return std::nullopt;
}

// Header: magic, version, size of the file, counts of landmarks, camera entries and views, names, stamp, next ids.
constexpr std::size_t kHeaderSize = 12 + 4 + 8 + 4 * 4 + 3 * 8;
constexpr std::size_t kChecksumSize = 4;
constexpr std::size_t kLandmarkSize = 3 * 8 + 8 + 3 * 8;  // id, identity, sightings; kind; x, y, z
constexpr std::size_t kViewSize = 3 * 8 + sizeof(Descriptor::values);
constexpr std::uint32_t kMostCamera = 64;

/// The sizes given in the header.
struct Counts {
  std::uint64_t landmarks, camera, views, entries;

  std::uint64_t bytes() const {
    return kHeaderSize + 8 * (MapSnapshot::kPoseEntries + camera + PackedSymmetric::packed_size(entries)) +
           kLandmarkSize * landmarks + kViewSize * views + kChecksumSize;
  }
};

Counts counts_of(const MapSnapshot& map) {
  return {map.landmarks.size(), map.camera.size(), map.views.size(), map.entries()};
}

void put(ByteWriter& writer, const MapLandmark& landmark) {
  writer.put(landmark.id);
  writer.put(landmark.identity);
  writer.put(landmark.sightings);
  writer.put(std::int64_t{landmark.kind});
  writer.put(landmark.p_map_landmark_m.x());
  writer.put(landmark.p_map_landmark_m.y());
  writer.put(landmark.z_map_landmark_m);
}

MapLandmark get_landmark(ByteReader& reader) {
  MapLandmark landmark;
  landmark.id = reader.get<std::int64_t>();
  landmark.identity = reader.get<std::int64_t>();
  landmark.sightings = reader.get<std::uint64_t>();
  const auto kind = reader.get<std::int64_t>();
  constexpr Kind kImplausible = std::numeric_limits<Kind>::min();
  landmark.kind = kind >= kAnyKind && kind <= std::numeric_limits<Kind>::max() ? static_cast<Kind>(kind) : kImplausible;
  landmark.p_map_landmark_m.x() = reader.number();
  landmark.p_map_landmark_m.y() = reader.number();
  landmark.z_map_landmark_m = reader.number();
  return landmark;
}

/// The checksum at the end of the file.
std::uint32_t recorded_checksum(Bytes bytes) { return ByteReader(bytes.last(kChecksumSize)).get<std::uint32_t>(); }

}  // namespace

std::optional<std::string> implausible(const MapSnapshot& map) {
  if (!is_plausible_stamp(to_us(map.stamp))) return "has an absurd stamp";
  if (!is_plausible(map.T_map_body)) return "has an absurd pose";
  const auto is_finite = [](double value) { return std::isfinite(value); };
  if (!std::ranges::all_of(map.camera, is_finite)) return "has an absurd camera";
  std::vector<std::int64_t> ids;
  for (const MapLandmark& landmark : map.landmarks) {
    if (!is_plausible(landmark)) return "has an absurd landmark";
    if (landmark.id >= map.next_id) return "has a landmark with the number of one to come";
    if (map.names == MapNames::looks && (landmark.identity < 0 || landmark.identity >= map.next_identity))
      return "has a landmark with the name of one to come";
    ids.push_back(landmark.id);
  }
  if (repeats(ids)) return "has two landmarks of one number";
  if (auto problem = problem_with_views(map)) return problem;
  if (map.covariance.size() != map.entries()) return "has a covariance of another size";
  if (!is_covariance(map.covariance)) return "has a covariance that is none";
  return std::nullopt;
}

std::uint32_t map_checksum(Bytes bytes) { return recorded_checksum(bytes); }

std::size_t encoded_size(const MapSnapshot& map) { return counts_of(map).bytes(); }

void encode(const MapSnapshot& map, std::vector<std::byte>& out) {
  const Counts counts = counts_of(map);
  ByteWriter writer(out, counts.bytes());
  writer.bytes(kMapMagic.data(), kMapMagic.size());
  writer.put(kMapVersion);
  writer.put(std::uint64_t{counts.bytes()});
  writer.put(static_cast<std::uint32_t>(counts.landmarks));
  writer.put(static_cast<std::uint32_t>(counts.camera));
  writer.put(static_cast<std::uint32_t>(counts.views));
  writer.put(static_cast<std::uint32_t>(map.names));
  writer.put(to_us(map.stamp));
  writer.put(map.next_id);
  writer.put(map.next_identity);
  for (const double value : {map.T_map_body.x_m, map.T_map_body.y_m, map.T_map_body.heading_rad}) writer.put(value);
  for (const double value : map.camera) writer.put(value);
  for (const MapLandmark& landmark : map.landmarks) put(writer, landmark);
  for (const double value : map.covariance.lower()) writer.put(value);
  for (const MapView& view : map.views) {
    writer.put(view.identity);
    writer.put(view.p_map_robot_m.x());
    writer.put(view.p_map_robot_m.y());
    writer.bytes(view.looks.values.data(), view.looks.values.size());
  }
  writer.put(checksum(Bytes(out).first(writer.size())));
}

std::optional<std::string> damage_of(Bytes bytes) {
  if (bytes.size() < kMapMagic.size() || std::memcmp(bytes.data(), kMapMagic.data(), kMapMagic.size()) != 0)
    return "is no map";
  if (bytes.size() < kHeaderSize + kChecksumSize) return "is cut short";
  const auto size = ByteReader(bytes.subspan(kMapMagic.size() + 4)).get<std::uint64_t>();
  if (size > bytes.size()) return "is cut short";
  if (size < bytes.size()) return "is longer than it says";
  if (recorded_checksum(bytes) != checksum(bytes.first(bytes.size() - kChecksumSize)))
    return "is damaged: its checksum is wrong";
  const auto version = ByteReader(bytes.subspan(kMapMagic.size())).get<std::uint32_t>();
  if (version == kMapVersion) return std::nullopt;
  return "is of version " + std::to_string(version) + ", and this program reads version " + std::to_string(kMapVersion);
}

std::optional<std::string> decode_map(Bytes bytes, MapSnapshot& out) {
  if (auto damage = damage_of(bytes)) return damage;
  ByteReader reader(bytes.subspan(kMapMagic.size()));
  reader.get<std::uint32_t>();
  reader.get<std::uint64_t>();
  Counts counts{};
  counts.landmarks = reader.get<std::uint32_t>();
  counts.camera = reader.get<std::uint32_t>();
  counts.views = reader.get<std::uint32_t>();
  const auto names = reader.get<std::uint32_t>();
  if (names > static_cast<std::uint32_t>(MapNames::looks)) return "names its landmarks in an unknown way";
  // A landmark has at least two coordinates. This limit is checked before any multiplication, which could overflow.
  if (counts.camera > kMostCamera || counts.landmarks > bytes.size() / kLandmarkSize)
    return "contradicts itself about its size";
  out.clear();
  out.names = static_cast<MapNames>(names);
  out.stamp = stamp_from_us(reader.get<std::int64_t>());
  out.next_id = reader.get<std::int64_t>();
  out.next_identity = reader.get<std::int64_t>();
  // The number of landmarks with a height determines the size of the covariance. So the landmarks are read first; the
  // check makes sure that they fit.
  const std::uint64_t fixed =
      kHeaderSize + 8 * (MapSnapshot::kPoseEntries + counts.camera) + kLandmarkSize * counts.landmarks + kChecksumSize;
  if (fixed > bytes.size()) return "contradicts itself about its size";
  for (double* value : {&out.T_map_body.x_m, &out.T_map_body.y_m, &out.T_map_body.heading_rad})
    *value = reader.number();
  for (std::uint64_t i = 0; i < counts.camera; ++i) out.camera.push_back(reader.number());
  for (std::uint64_t i = 0; i < counts.landmarks; ++i) out.landmarks.push_back(get_landmark(reader));
  counts.entries = out.entries();
  if (counts.bytes() != bytes.size()) return "contradicts itself about its size";
  out.covariance.resize(counts.entries);
  for (double& value : out.covariance.lower()) value = reader.number();
  for (std::uint64_t i = 0; i < counts.views; ++i) {
    MapView& view = out.views.emplace_back();
    view.identity = reader.get<std::int64_t>();
    view.p_map_robot_m.x() = reader.number();
    view.p_map_robot_m.y() = reader.number();
    reader.bytes(view.looks.values.data(), view.looks.values.size());
  }
  return implausible(out);
}

}  // namespace azimuth
