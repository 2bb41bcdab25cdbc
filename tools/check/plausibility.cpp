#include "tools/check/plausibility.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "slam/geometry/angle.hpp"
#include "slam/geometry/index.hpp"
#include "tools/check/hypothesis_fit.hpp"
#include "tools/check/sentences.hpp"
#include "tools/drive_fit/calibration.hpp"
#include "tools/drive_fit/known_points.hpp"

namespace azimuth {
namespace {

const double kSure = std::log(1e4);
constexpr double kSigmas = 4.0;
constexpr int kMostNamed = 3;
constexpr double kHalf = 0.5;  // of what matters: a number that is known no better cannot be told to be right

/// What a mistake comes to: how far a number is from what the rig says, in what_matters()' unit.
struct Off {
  double by = 0.0, sigma = 0.0;
  bool matters(Mistake mistake) const { return std::abs(by) > what_matters(mistake) && std::abs(by) > kSigmas * sigma; }
};

using Spread = Eigen::Matrix<double, kCalibrations, kCalibrations>;

Off off_in(Mistake mistake, const DriveSolution& found, const DriveSolution& now, double drive_s) {
  const Calibration by = numbers_of(found.guess) - numbers_of(now.guess);
  const auto number = [&](int which, double unit) {
    return Off{unit * by[which], std::abs(unit) * std::sqrt(std::max(0.0, found.covariance(which, which)))};
  };
  switch (mistake) {
    case Mistake::heading: {
      Off off = number(calibration::yaw, 1.0);
      off.by = wrap(off.by);
      return off;
    }
    case Mistake::turn:
      return number(calibration::scale_turn, 1.0 / now.guess.rig.odometry.scale_turn);
    case Mistake::drift:
      return number(calibration::drift, 1.0);
    case Mistake::lag:
      return number(calibration::lag, 1.0);
    case Mistake::clock:
      return number(calibration::lag_growth, drive_s);
    case Mistake::centre: {
      const Eigen::Vector2d c = by.segment<2>(calibration::centre_x);
      const Eigen::Matrix2d P = found.covariance.block<2, 2>(calibration::centre_x, calibration::centre_x);
      return {c.norm(), std::sqrt(std::max(0.0, P.trace()))};
    }
    case Mistake::hand:
    case Mistake::wheels:
    case Mistake::distance:
      break;
  }
  return {};
}

bool is_of_two_worlds(Mistake mistake) { return mistake == Mistake::hand || mistake == Mistake::wheels; }

/// One mistake, as it explains the drive.
struct Tried {
  Explanation explanation;
  Off off;
  double evidence = 0.0;  // Schwarz's charge taken off

  bool is_sure() const {
    const Mistake mistake = explanation.mistake;
    return evidence > kSure && (is_of_two_worlds(mistake) || off.matters(mistake));
  }
};

class Judge {
 public:
  Judge(const Drive& drive, const Run& run, const Rig& rig, const HindsightSettings& settings)
      : drive_(drive),
        run_(run),
        rig_(rig),
        explanations_(drive, rig, settings),
        drive_s_(to_seconds(drive.sets.back().stamp - drive.sets.front().stamp)) {}

  Plausibility judge() {
    for (std::size_t i = 0; i < kMistakes; ++i) {
      MistakeVerdict& said = result_.verdicts.emplace_back();
      said.mistake = static_cast<Mistake>(i);
    }
    for (int named = 0; named < kMostNamed; ++named) {
      const std::vector<Tried> tried = try_all();
      note(tried);
      const auto best =
          std::ranges::max_element(tried, {}, [](const Tried& each) { return each.is_sure() ? each.evidence : 0.0; });
      if (best == tried.end() || !best->is_sure()) break;
      name(*best, tried);
    }
    judge_distance();
    const DriveSolution& now = explanations_.now();
    result_.rig = rig_saying(now.guess, rig_);
    set_centre(now.guess.centre_px);
    result_.rig.odometry.scale_distance *= lengths_;
    result_.fitting = now.fitting;
    return std::move(result_);
  }

 private:
  MistakeVerdict& verdict(Mistake mistake) { return result_.verdicts[as_size(mistake)]; }

  std::vector<Tried> try_all() {
    std::vector<Tried> tried;
    const DriveSolution now = explanations_.now();
    for (std::size_t i = 0; i < kMistakes; ++i) {
      const auto mistake = static_cast<Mistake>(i);
      if (closed_[i]) continue;
      std::optional<Explanation> explanation = explanations_.explanation(mistake);
      if (!explanation) continue;
      const double charge =
          0.5 * explanation->adjusted * std::log(static_cast<double>(std::max<std::size_t>(2, now.graph.bearings())));
      const double told = azimuth::evidence(explanation->solution, now) - charge;
      tried.push_back({*explanation, off_in(mistake, explanation->solution, now, drive_s_), told});
    }
    return tried;
  }

  /// What fits, or cannot be told, as it looks now.
  void note(const std::vector<Tried>& tried) {
    for (const Tried& each : tried) {
      const Mistake mistake = each.explanation.mistake;
      MistakeVerdict& said = verdict(mistake);
      const bool known = is_of_two_worlds(mistake)
                             ? std::abs(each.evidence) > kSure
                             : each.off.sigma > 0.0 && each.off.sigma <= kHalf * what_matters(mistake);
      said.says = known ? MistakeVerdict::Says::fits : MistakeVerdict::Says::cannot_tell;
      said.sentence = known ? sentence_fits(mistake, rig_, each.explanation.solution.guess, each.off.sigma)
                            : sentence_cannot_tell(mistake, each.off.sigma);
    }
    if (MistakeVerdict& centre = verdict(Mistake::centre); centre.sentence.empty())
      centre.sentence = sentence_cannot_tell(Mistake::centre, 0.0);
  }

  void name(const Tried& best, const std::vector<Tried>& tried) {
    const auto of = [&](Mistake mistake) {
      return std::ranges::find(tried, mistake, [](const Tried& each) { return each.explanation.mistake; });
    };
    const auto hand = of(Mistake::hand), wheels = of(Mistake::wheels);
    const bool could_be_either = is_of_two_worlds(best.explanation.mistake) && hand != tried.end() &&
                                 wheels != tried.end() && std::abs(hand->evidence - wheels->evidence) < kSure;
    if (!could_be_either)
      return accept(best, sentence_wrong(best.explanation.mistake, rig_, best.explanation.solution.guess, {}));
    const std::optional<bool> map_is_mirrored = is_mirrored(hand->explanation.solution);
    const Tried& chosen = map_is_mirrored.value_or(false) ? *wheels : *hand;
    const Mistake other = &chosen == &*hand ? Mistake::wheels : Mistake::hand;
    const Tried& rival = &chosen == &*hand ? *wheels : *hand;
    accept(chosen, sentence_wrong(chosen.explanation.mistake, rig_, chosen.explanation.solution.guess,
                                  map_is_mirrored ? std::nullopt : std::optional(rival.explanation.solution.guess)));
    verdict(other).says = map_is_mirrored ? MistakeVerdict::Says::fits : MistakeVerdict::Says::cannot_tell;
    verdict(other).sentence = map_is_mirrored ? sentence_fits(other, rig_, chosen.explanation.solution.guess, 0.0)
                                              : sentence_cannot_tell(other, 0.0);
    if (!map_is_mirrored) verdict(other).sentence = sentence_either(other);
    closed_[as_size(other)] = !map_is_mirrored;
  }

  void accept(const Tried& tried, std::string sentence) {
    MistakeVerdict& said = verdict(tried.explanation.mistake);
    said.says = MistakeVerdict::Says::wrong;
    said.evidence = tried.evidence;
    said.sentence = std::move(sentence);
    closed_[as_size(tried.explanation.mistake)] = true;
    explanations_.accept(tried.explanation.solution);
  }

  /// By what was surveyed or by the true path, whichever tells better; nothing: neither does. One landmark whose place
  /// is hardly known makes a whole map tell little.
  std::optional<Likeness> likeness_to_truth(const DriveSolution& solution) const {
    const auto by_map =
        drive_.names_are_landmarks ? likeness(points_of_map(solution, run_.landmarks)) : std::optional<Likeness>();
    const auto by_path = likeness(points_on_path(solution, run_.truth));
    if (!by_map || !by_path) return by_map ? by_map : by_path;
    if (by_map->hand_told != by_path->hand_told) return by_map->hand_told ? by_map : by_path;
    return by_map->lengths.sigma <= by_path->lengths.sigma ? by_map : by_path;
  }
  std::optional<bool> is_mirrored(const DriveSolution& solution) const {
    const std::optional<Likeness> like = likeness_to_truth(solution);
    if (!like || !like->hand_told) return std::nullopt;
    return like->mirrored;
  }

  void judge_distance() {
    MistakeVerdict& said = verdict(Mistake::distance);
    const std::optional<Likeness> like = likeness_to_truth(explanations_.now());
    if (!like || like->lengths.sigma > kHalf * what_matters(Mistake::distance)) {
      said.sentence = sentence_cannot_tell(Mistake::distance, like ? like->lengths.sigma : 0.0);
      return;
    }
    const Off off{like->lengths.scale - 1.0, like->lengths.sigma};
    const double key = explanations_.now().guess.rig.odometry.scale_distance * like->lengths.scale;
    if (!off.matters(Mistake::distance)) {
      said.says = MistakeVerdict::Says::fits;
      said.sentence = sentence_distance_fits(like->lengths);
      return;
    }
    said.says = MistakeVerdict::Says::wrong;
    said.evidence = 0.5 * off.by * off.by / (off.sigma * off.sigma);
    said.sentence = sentence_distance_wrong(like->lengths, key);
    lengths_ = like->lengths.scale;
  }

  void set_centre(const Eigen::Vector2d& by_px) {
    std::optional<PixelPoint>& centre = result_.rig.camera.image.centre_px;
    if (!centre) return;
    const Eigen::Vector2d off = in_image(by_px, rig_);
    *centre = {(*centre)[0] + off.x(), (*centre)[1] + off.y()};
  }

  const Drive& drive_;
  const Run& run_;
  Rig rig_;
  Explanations explanations_;
  double drive_s_ = 0.0;
  double lengths_ = 1.0;
  std::array<bool, kMistakes> closed_{};  // named, or left open for good
  Plausibility result_;
};

}  // namespace

bool Plausibility::anything_wrong() const {
  return std::ranges::any_of(verdicts,
                             [](const MistakeVerdict& each) { return each.says == MistakeVerdict::Says::wrong; });
}

Plausibility judge(const Drive& drive, const Run& run, const Rig& rig, const HindsightSettings& settings) {
  return Judge(drive, run, rig, settings).judge();
}

double what_matters(Mistake mistake) {
  switch (mistake) {
    case Mistake::hand:
    case Mistake::wheels:
      return 0.0;
    case Mistake::heading:
      return degrees_to_rad(5.0);
    case Mistake::turn:
    case Mistake::distance:
      return 0.05;
    case Mistake::drift:
      return 0.03;
    case Mistake::lag:
    case Mistake::clock:
      return 0.1;
    case Mistake::centre:
      return 5.0;
  }
  return 0.0;
}

std::string_view to_string(Mistake mistake) {
  switch (mistake) {
    case Mistake::hand:
      return "direction";
    case Mistake::wheels:
      return "wheels";
    case Mistake::heading:
      return "heading";
    case Mistake::turn:
      return "turn";
    case Mistake::drift:
      return "drift";
    case Mistake::lag:
      return "lag";
    case Mistake::clock:
      return "clock";
    case Mistake::centre:
      return "centre";
    case Mistake::distance:
      return "distance";
  }
  return "?";
}

}  // namespace azimuth
