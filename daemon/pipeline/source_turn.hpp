#pragma once
#include <chrono>

#include "daemon/pipeline/doorbell.hpp"
#include "daemon/pipeline/end_mark.hpp"
#include "daemon/pipeline/source.hpp"
#include "daemon/pipeline/wires.hpp"

namespace azimuth {

/// The turn of a source's thread. Thread contract: thread-bound; source() only while the thread is at rest.
class SourceTurn {
 public:
  /// `memories` is null when no keeper saves the odometer's state for the next start.
  struct Wires {
    SourceWires samples;
    Newest<OdometerMemory>* memories;
    EndMark& over;
  };

  SourceTurn(Source& source, Wires wires, Doorbell& bell) : source_(source), wires_(wires), bell_(bell) {}

  void operator()();

  Source& source() { return source_; }

 private:
  void hand_over_memory();

  Source& source_;
  Wires wires_;
  Doorbell& bell_;
  OdometerMemory memory_;
  std::chrono::steady_clock::time_point next_memory_{};
};

}  // namespace azimuth
