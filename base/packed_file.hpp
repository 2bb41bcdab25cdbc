#pragma once
// Files that are not what they were taken for: packed, or pointers to what they should hold, or of other programs.
//
// Thread contract: reentrant.

#include <string_view>

#include "base/bytes.hpp"

namespace azimuth {

/// What to do with a file that begins so before anything can read it, for a person: "is compressed by gzip: gunzip it
/// first". Empty: it is neither packed nor a pointer.
std::string_view packed_as(Bytes begin);

/// The same of recordings that azimuth import makes runs of: "is a bag of ROS: azimuth import makes a run of it".
std::string_view imported_as(Bytes begin);

}  // namespace azimuth
