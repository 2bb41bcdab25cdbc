#include "settings/suggestion.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <numbers>
#include <string>
#include <vector>

namespace azimuth {
namespace {

struct Unit {
  std::string_view name;
  char dimension;  ///< a: angle, l: length, t: time, f: frequency; units convert only to units of the same letter
  double in_base;
};

// Where one name ends in another, the longer one comes first, so that "rad2_per_m" is not read as "m".
constexpr auto kUnits = std::to_array<Unit>({
    {"m_per_sqrt_m", 'r', 1.0},
    {"rad2_per_m", 'd', 1.0},
    {"rad_per_m", 'c', 1.0},
    {"deg_per_m", 'c', std::numbers::pi / 180.0},
    {"per_m", 'i', 1.0},
    {"rad_s", 'w', 1.0},
    {"deg_s", 'w', std::numbers::pi / 180.0},
    {"mm_s", 'v', 1e-3},
    {"cm_s", 'v', 1e-2},
    {"m_s", 'v', 1.0},
    {"km_h", 'v', 1.0 / 3.6},
    {"chi2", 'x', 1.0},
    {"degrees", 'a', std::numbers::pi / 180.0},
    {"degree", 'a', std::numbers::pi / 180.0},
    {"deg", 'a', std::numbers::pi / 180.0},
    {"rad", 'a', 1.0},
    {"radians", 'a', 1.0},
    {"mrad", 'a', 1e-3},
    {"mm", 'l', 1e-3},
    {"cm", 'l', 1e-2},
    {"km", 'l', 1e3},
    {"m", 'l', 1.0},
    {"ms", 't', 1e-3},
    {"us", 't', 1e-6},
    {"s", 't', 1.0},
    {"min", 't', 60.0},
    {"khz", 'f', 1e3},
    {"hz", 'f', 1.0},
    {"px", 'p', 1.0},
});

const Unit* find_unit(std::string_view name) {
  const auto found = std::find_if(kUnits.begin(), kUnits.end(), [&](const Unit& unit) { return unit.name == name; });
  return found == kUnits.end() ? nullptr : &*found;
}

std::string_view without_unit(std::string_view key) {
  const std::string_view unit = unit_of(key);
  return unit.empty() ? key : key.substr(0, key.size() - unit.size() - 1);
}

/// The word in lower case, without the dashes of an option.
std::string letters_of(std::string_view word) {
  word.remove_prefix(std::min(word.find_first_not_of('-'), word.size()));
  std::string letters(word);
  for (char& letter : letters) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return letters;
}

/// Largest edit distance to a suggestion for a word of `letters` letters. It is 0 for one or two letters, since any
/// other word is as near as the right one.
std::size_t forgivable(std::size_t letters) { return letters / 3; }

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before_last.swap(last);
    last.swap(row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, replaced});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
  }
  return row[b.size()];
}

std::optional<std::string_view> nearest(std::string_view word, std::span<const std::string_view> known) {
  constexpr std::size_t kLongestWord = 100;  // a word longer than this is no typing error
  if (word.size() > kLongestWord) return std::nullopt;
  const std::string meant = letters_of(word);
  std::optional<std::string_view> best;
  std::size_t best_distance = kLongestWord;
  for (const std::string_view candidate : known) {
    const std::string letters = letters_of(candidate);
    const std::size_t distance = edit_distance(meant, letters);
    if (distance >= best_distance || distance > forgivable(std::min(meant.size(), letters.size()))) continue;
    best_distance = distance;
    best = candidate;
  }
  return best;
}

std::string_view unit_of(std::string_view key) {
  for (const Unit& unit : kUnits) {
    if (key.size() <= unit.name.size() + 1 || !key.ends_with(unit.name)) continue;
    const std::size_t start = key.size() - unit.name.size();
    if (key[start - 1] == '_') return key.substr(start);
  }
  return {};
}

std::optional<std::string_view> same_but_unit(std::string_view key, std::span<const std::string_view> known) {
  std::optional<std::string_view> of_another_dimension;
  for (const std::string_view candidate : known) {
    const bool is_same =
        candidate != key && !unit_of(candidate).empty() && without_unit(candidate) == without_unit(key);
    if (is_same && converted(1.0, unit_of(key), unit_of(candidate))) return candidate;
    if (is_same && !of_another_dimension) of_another_dimension = candidate;
  }
  return of_another_dimension;
}

std::optional<double> converted(double value, std::string_view from_unit, std::string_view to_unit) {
  const Unit* const from = find_unit(from_unit);
  const Unit* const to = find_unit(to_unit);
  if (!from || !to || from->dimension != to->dimension) return std::nullopt;
  return value * from->in_base / to->in_base;
}

}  // namespace azimuth
