#include "tools/view/shown_map.hpp"

#include <algorithm>
#include <utility>

#include "tools/view/message_json.hpp"

namespace azimuth {
namespace {

constexpr double kPerMetreOnMap = 1e4, kPerSquareMetre = 1e8, kPerMillisecond = 1e3;

}  // namespace

void LandmarkHistory::take_map(std::span<const landmark_t> landmarks, double t_s) {
  map_t_s_ = t_s;
  std::unordered_map<std::int64_t, Known> present;
  for (const landmark_t& landmark : landmarks.first(std::min(landmarks.size(), most_))) {
    const auto before = known_.find(landmark.id);
    // Landmarks of the first received map may be old.
    const double first_t_s = any_map_ ? t_s : -std::numeric_limits<double>::infinity();
    present.emplace(landmark.id, before != known_.end() ? before->second : Known{first_t_s, {}, driving_s_, 0});
  }
  known_ = std::move(present);
  any_map_ = true;
}

void LandmarkHistory::saw(std::int64_t landmark, double t_s) {
  any_sighting_ = true;
  const auto known = known_.find(landmark);
  if (known == known_.end()) return;
  known->second.last_seen_t_s = t_s;
  known->second.last_seen_driving_s = driving_s_;
}

void LandmarkHistory::contradicted(std::int64_t landmark, int in_a_row) {
  const auto known = known_.find(landmark);
  if (known != known_.end()) known->second.rejected_in_row = in_a_row;
}

/// State of a landmark. The state "unseen" needs at least one received message on sightings.
const char* LandmarkHistory::state(const Known& known) const {
  if (known.rejected_in_row >= kDoubtedFrom) return "doubted";
  if (map_t_s_ - known.first_t_s < kNew_s) return "new";
  return any_sighting_ && driving_s_ - known.last_seen_driving_s > kUnseenDriving_s ? "unseen" : "confirmed";
}

nlohmann::json LandmarkHistory::json(std::span<const landmark_t> landmarks) const {
  const std::size_t shown = std::min(landmarks.size(), most_);
  nlohmann::json rows = nlohmann::json::array();
  for (const landmark_t& each : landmarks.first(shown)) {
    const auto found = known_.find(each.id);
    const Known known = found == known_.end() ? Known{} : found->second;
    rows.push_back({each.id, each.identity, rounded_json(each.x_m, kPerMetreOnMap),
                    rounded_json(each.y_m, kPerMetreOnMap), rounded_json(each.covariance[0], kPerSquareMetre),
                    rounded_json(each.covariance[1], kPerSquareMetre),
                    rounded_json(each.covariance[2], kPerSquareMetre), rounded_json(each.z_m, kPerMetreOnMap),
                    rounded_json(each.sigma_z_m, kPerMetreOnMap),
                    known.last_seen_t_s ? rounded_json(*known.last_seen_t_s, kPerMillisecond) : nlohmann::json(nullptr),
                    state(known)});
  }
  return {{"landmarks", std::move(rows)}, {"more", landmarks.size() - shown}};
}

bool ShownMap::take(const map_chunk_t& piece) {
  if (!pieces_.take(piece)) return false;
  sequence_ = piece.seq;
  return true;
}

std::optional<nlohmann::json> ShownMap::changed(double t_s) {
  history_.take_map(pieces_.whole(), t_s);
  nlohmann::json json = history_.json(pieces_.whole());
  if (json == told_) return std::nullopt;
  told_ = json;
  json["seq"] = sequence_;
  return json;
}

void ShownMap::take(const sightings_t& sightings, double t_s) {
  for (const sighting_t& sighting : sightings.sightings) history_.saw(sighting.landmark_id, t_s);
}

void ShownMap::take(const expectations_t& expectations) {
  for (const expected_bearing_t& expected : expectations.expected)
    history_.contradicted(expected.landmark_id, expected.rejected_in_row);
}

}  // namespace azimuth
