#pragma once
// Maps and paths, assembled from the pieces in which they are sent.

#include <azimuth/map_chunk_t.hpp>
#include <azimuth/path_t.hpp>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace azimuth {

/// Takes pieces as they arrive. Thread contract: thread-bound.
template <class Piece, class Element, std::vector<Element> Piece::*Elements>
class Pieces {
 public:
  /// Takes a valid piece (from decode_map_chunk() or decode_path()). True: it was the last missing one, and whole() is
  /// new.
  bool take(const Piece& piece) {
    if (piece.seq != sequence_ || piece.chunks != count_) begin(piece);
    parts_[piece.chunk] = piece.*Elements;
    if (parts_.size() != static_cast<std::size_t>(piece.chunks)) return false;
    whole_.clear();
    for (const auto& [number, part] : parts_) whole_.insert(whole_.end(), part.begin(), part.end());
    utime_ = piece.utime;
    parts_.clear();
    count_ = 0;  // a further piece starts a new collection
    return true;
  }

  const std::vector<Element>& whole() const { return whole_; }  ///< elements of the newest complete map or path
  std::int64_t utime() const { return utime_; }                 ///< time of the newest complete map or path
  /// Number of maps or paths that were given up because the next one began before all pieces had arrived.
  std::uint64_t incomplete() const { return incomplete_; }

 private:
  void begin(const Piece& piece) {
    if (!parts_.empty()) ++incomplete_;
    parts_.clear();
    sequence_ = piece.seq;
    count_ = piece.chunks;
  }

  std::map<std::int32_t, std::vector<Element>> parts_;  // pieces of the incomplete map or path, by number
  std::int64_t sequence_ = 0;
  std::int32_t count_ = 0;  // number of pieces of the incomplete map or path; 0: there is none
  std::vector<Element> whole_;
  std::int64_t utime_ = 0;
  std::uint64_t incomplete_ = 0;
};

using MapPieces = Pieces<map_chunk_t, landmark_t, &map_chunk_t::landmarks>;
using PathPieces = Pieces<path_t, path_pose_t, &path_t::poses>;

}  // namespace azimuth
