#pragma once
// Maps and paths, put together from the pieces in which they are sent.

#include <azimuth/map_chunk_t.hpp>
#include <azimuth/path_t.hpp>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace azimuth {

/// Takes pieces as they come. Thread contract: thread-bound.
template <class Piece, class Element, std::vector<Element> Piece::*Elements>
class Pieces {
 public:
  /// A sound piece (decode_map_chunk(), decode_path()). True: it was the last one that was missing, and whole() is new.
  bool take(const Piece& piece) {
    if (piece.seq != sequence_ || piece.chunks != count_) begin(piece);
    parts_[piece.chunk] = piece.*Elements;
    if (parts_.size() != static_cast<std::size_t>(piece.chunks)) return false;
    whole_.clear();
    for (const auto& [number, part] : parts_) whole_.insert(whole_.end(), part.begin(), part.end());
    utime_ = piece.utime;
    parts_.clear();
    count_ = 0;  // what comes again is a new one
    return true;
  }

  const std::vector<Element>& whole() const { return whole_; }  ///< the newest of which nothing is missing
  std::int64_t utime() const { return utime_; }                 ///< of it
  std::uint64_t incomplete() const { return incomplete_; }      ///< given up, because the next one came

 private:
  void begin(const Piece& piece) {
    if (!parts_.empty()) ++incomplete_;
    parts_.clear();
    sequence_ = piece.seq;
    count_ = piece.chunks;
  }

  std::map<std::int32_t, std::vector<Element>> parts_;  // of the present one, by their numbers
  std::int64_t sequence_ = 0;
  std::int32_t count_ = 0;  // that it has; 0: there is none
  std::vector<Element> whole_;
  std::int64_t utime_ = 0;
  std::uint64_t incomplete_ = 0;
};

using MapPieces = Pieces<map_chunk_t, landmark_t, &map_chunk_t::landmarks>;
using PathPieces = Pieces<path_t, path_pose_t, &path_t::poses>;

}  // namespace azimuth
