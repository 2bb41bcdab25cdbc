#include "tools/view/shown_map.hpp"

namespace azimuth {

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
