#pragma once
// Mistakes that the tests of `azimuth check` put into good runs.

#include <functional>
#include <limits>
#include <ostream>
#include <string>
#include <vector>

#include "drivers/storage/run.hpp"
#include "tools/check/plausibility.hpp"

namespace azimuth::test {

struct Spoiling {
  const char* name;
  Mistake mistake;
  const char* key;  ///< Text that the sentence of the verdict must contain: the key of the rig, or other words.
  std::function<Run(Run)> spoilt;
  double by_rad = std::numeric_limits<double>::infinity();  ///< Heading error; infinity for other mistakes.
};
inline std::ostream& operator<<(std::ostream& out, const Spoiling& spoiling) { return out << spoiling.name; }

/// Large mistakes, one of every sort.
const std::vector<Spoiling>& spoilings();
/// Mistakes that are hard to find: small ones, a camera that looks backwards, and faults of the recording.
const std::vector<Spoiling>& further_spoilings();

std::string said(const Plausibility& found);
/// The verdicts call this mistake wrong, with its key, and no other one.
bool names_it(const Plausibility& found, const Spoiling& spoiling);
/// The verdicts call another mistake wrong.
bool names_another(const Plausibility& found, const Spoiling& spoiling);

}  // namespace azimuth::test
