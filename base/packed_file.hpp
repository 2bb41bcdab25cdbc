#pragma once
// Recognition of files that are not what the reader expects: packed files, pointers to other files, files of other
// programs.
//
// Thread contract: reentrant.

#include <string_view>

#include "base/bytes.hpp"

namespace azimuth {

/// The advice for a file that starts with `begin` and cannot be read directly, for example "is compressed by gzip:
/// gunzip it first". Empty if the file is neither packed nor a pointer.
std::string_view packed_as(Bytes begin);

/// The advice for recordings that `azimuth import` converts, for example "is a bag of ROS: azimuth import makes a run
/// of it".
std::string_view imported_as(Bytes begin);

}  // namespace azimuth
