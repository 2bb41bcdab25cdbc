#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/file_result.hpp"
#include "drivers/can/can_signal.hpp"

namespace azimuth {

/// A signal of a DBC file.
struct DbcSignal {
  std::string name;
  CanSignal signal;
  int line = 0;
  std::optional<std::string> problem;  ///< why it cannot be used
};

/// A frame of a DBC file.
struct DbcMessage {
  std::string name;
  CanId id;
  int size = 0;  ///< bytes
  int line = 0;
  std::vector<DbcSignal> signals;
};

/// The part of a DBC file that says where which signal is.
struct Dbc {
  std::string file;
  std::vector<DbcMessage> messages;

  /// By "Message.Signal"; null when there is none.
  const DbcSignal* find(std::string_view name) const;
};

/// Reads BO_, SG_ (with simple multiplexing) and SIG_VALTYPE_; every other statement is passed over. What cannot be
/// read is an error with its line. A signal that is written rightly and cannot be used (it reaches beyond its frame, it
/// needs extended multiplexing) says so itself, for it may be one that nobody wants.
///
/// Reentrant. `file` is what errors name.
FileResult<Dbc> read_dbc(std::string_view text, const std::string& file);

}  // namespace azimuth
