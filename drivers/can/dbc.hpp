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
  std::optional<std::string> problem;  ///< why the signal cannot be used; none: it can be used
};

/// A frame of a DBC file.
struct DbcMessage {
  std::string name;
  CanId id;
  int size = 0;  ///< bytes
  int line = 0;
  std::vector<DbcSignal> signals;
};

/// The part of a DBC file that gives the positions of signals.
struct Dbc {
  std::string file;
  std::vector<DbcMessage> messages;

  /// Finds a signal by "Message.Signal"; null when there is none.
  const DbcSignal* find(std::string_view name) const;
};

/// Reads BO_, SG_ (with simple multiplexing) and SIG_VALTYPE_; other statements are skipped. A syntax error is reported
/// with its line. A correctly written signal that cannot be used (it reaches beyond its frame, or needs extended
/// multiplexing) gets a `problem` instead, because it may be a signal that is not needed.
///
/// Thread contract: reentrant. Errors name `file`.
FileResult<Dbc> read_dbc(std::string_view text, const std::string& file);

}  // namespace azimuth
