#pragma once
#include <array>
#include <cstddef>
#include <ostream>

#include "slam/smoother/robust_kernel.hpp"

namespace azimuth {

inline std::ostream& operator<<(std::ostream& out, RobustKernel kernel) {
  return out << std::array<const char*, 4>{"none", "huber", "cauchy", "dcs"}.at(static_cast<std::size_t>(kernel));
}

}  // namespace azimuth
