#include "tools/import/foreign_samples.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>

#include "drivers/wire/plausible.hpp"
#include "tools/import/foreign_rows.hpp"

namespace azimuth {
namespace {

// Columns of bearings.
constexpr std::array<WantedColumn, 8> kBearing{{{"t_s"},
                                                {"azimuth_rad"},
                                                {"elevation_rad", false},
                                                {"landmark_id", false},
                                                {"kind", false},
                                                {"sigma_rad", false},
                                                {"radius_px", false},
                                                {"sigma_elevation_rad", false}}};

/// Reads the number in an optional column into `value`, which keeps its content if the field is empty. Returns false if
/// the number is invalid.
bool read_number(ForeignTable& reader, std::size_t column, bool (*fits)(double), double& value) {
  if (reader.field(column).empty()) return true;
  const std::optional<double> number = reader.number(column, fits);
  value = number.value_or(value);
  return number.has_value();
}

template <class Integer>
bool read_integer(ForeignTable& reader, std::size_t column, bool (*fits)(std::int64_t), Integer& value) {
  if (reader.field(column).empty()) return true;
  const std::optional<std::int64_t> number = reader.integer(column, fits);
  if (number) value = static_cast<Integer>(*number);
  return number.has_value();
}

std::optional<Bearing> read_bearing(ForeignTable& reader) {
  Bearing bearing;
  const std::optional<double> azimuth_rad = reader.number(1, is_plausible_azimuth);
  bool good = azimuth_rad.has_value();
  if (good) bearing.azimuth_rad = wrap(*azimuth_rad);
  good = read_number(reader, 2, is_plausible_elevation, bearing.elevation_rad) && good;
  good = read_integer(reader, 3, is_plausible_identity, bearing.identity) && good;
  good = read_integer(reader, 4, is_plausible_kind, bearing.kind) && good;
  good = read_number(reader, 5, is_plausible_bearing_sigma, bearing.sigma_rad) && good;
  good = read_number(reader, 6, is_plausible_radius, bearing.radius_px) && good;
  good = read_number(reader, 7, is_plausible_bearing_sigma, bearing.sigma_elevation_rad) && good;
  return good ? std::optional(bearing) : std::nullopt;
}

/// Adds a note if some bearings have an identity and others have none.
void note_nameless(const std::vector<BearingSet>& sets, const std::string& file, TableNotes& notes) {
  std::size_t all = 0, nameless = 0;
  for (const BearingSet& set : sets) {
    all += set.bearings.size();
    nameless += static_cast<std::size_t>(std::ranges::count(set.bearings, kUnknownIdentity, &Bearing::identity));
  }
  if (nameless == 0 || nameless == all) return;
  notes.sentences.push_back(
      file + ": " + std::to_string(nameless) + " of " + std::to_string(all) +
      " bearings have no landmark_id: camera.identities = true in rig.toml uses the others alone, "
      "false all of them without their names");
}

/// Handles images with several bearings of the same landmark. If most images have them, the stamps are too coarse to
/// distinguish images; the function then returns an error text. Otherwise it adds a note.
std::string repeated_names(const std::vector<BearingSet>& sets, const std::string& file, TableNotes& notes) {
  std::size_t images = 0, most = 0;
  for (const BearingSet& set : sets) {
    std::map<Identity, std::size_t> seen;
    for (const Bearing& bearing : set.bearings)
      if (bearing.identity != kUnknownIdentity) most = std::max(most, ++seen[bearing.identity]);
    images += std::ranges::any_of(seen, [](const auto& each) { return each.second > 1; }) ? 1 : 0;
  }
  if (images == 0) return {};
  constexpr Duration kSecond{1'000'000};
  const bool whole_seconds =
      std::ranges::all_of(sets, [=](const BearingSet& set) { return (set.stamp - Stamp{}) % kSecond == Duration{}; });
  std::string said = std::to_string(images) + " of " + std::to_string(sets.size()) +
                     " images show a landmark more than once, up to " + std::to_string(most) +
                     " times: rows of one t_s are of one image";
  if (whole_seconds && 2 * images > sets.size()) return said + ", and these are in whole seconds";
  notes.sentences.push_back(file + ": " + std::move(said) + "; is t_s too coarse, or landmark_id no name?");
  return {};
}

}  // namespace

FileResult<std::vector<BearingSet>> foreign_bearings(const ForeignText& table, TableNotes& notes) {
  using Rows = std::vector<BearingSet>;
  const auto nothing_lacks = [](const ForeignTable&) { return std::string(); };
  const auto use = [](ForeignTable& reader, Rows& sets) {
    const std::optional<Stamp> stamp = reader.stamp(0);
    const std::optional<Bearing> bearing = read_bearing(reader);
    if (!stamp) return;
    if (reader.order(*stamp) == ForeignTable::Order::later)
      sets.push_back({.stamp = *stamp, .sequence = sets.size(), .bearings = {}});
    if (bearing && !sets.empty()) sets.back().bearings.push_back(*bearing);
  };
  return read_rows<Rows>(table, kBearing, nothing_lacks, use, [&](const ForeignTable&, const Rows& sets) {
    note_nameless(sets, table.file, notes);
    return repeated_names(sets, table.file, notes);
  });
}

FileResult<std::vector<StampedFile>> foreign_files(const ForeignText& table) {
  static constexpr std::array<WantedColumn, 2> kFile{{{"t_s"}, {"file"}}};
  using Rows = std::vector<StampedFile>;
  const auto nothing_lacks = [](const ForeignTable&) { return std::string(); };
  return read_rows<Rows>(
      table, kFile, nothing_lacks,
      [](ForeignTable& reader, Rows& rows) {
        const std::optional<Stamp> stamp = reader.stamp(0);
        if (reader.field(1).empty()) reader.fail("file is empty");
        if (!stamp) return;
        const ForeignTable::Order order = reader.order(*stamp);
        if (order == ForeignTable::Order::same) reader.fail("t_s is that of the row above");
        if (order == ForeignTable::Order::later) rows.push_back({*stamp, std::string(reader.field(1)), reader.line()});
      },
      [](const ForeignTable&, const Rows&) { return std::string(); });
}

}  // namespace azimuth
