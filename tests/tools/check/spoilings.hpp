#pragma once
// Mistakes made on purpose.

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
  const char* key;  ///< that is named, or words in its place
  std::function<Run(Run)> spoilt;
  double by_rad = std::numeric_limits<double>::infinity();  ///< of the heading alone
};
inline std::ostream& operator<<(std::ostream& out, const Spoiling& spoiling) { return out << spoiling.name; }

/// Of every sort, and large.
const std::vector<Spoiling>& spoilings();
/// That were missed once: small ones, those that bearings behind the robot explain, those of the recording.
const std::vector<Spoiling>& further_spoilings();

std::string said(const Plausibility& found);
/// That mistake with its key, and no other one.
bool names_it(const Plausibility& found, const Spoiling& spoiling);
/// Another mistake than that is called wrong.
bool names_another(const Plausibility& found, const Spoiling& spoiling);

}  // namespace azimuth::test
