#include "tools/check/plausibility.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

#include "slam/camera/make_camera.hpp"
#include "slam/geometry/index.hpp"
#include "tools/check/hypothesis_fit.hpp"
#include "tools/check/odometry_leaps.hpp"
#include "tools/check/offset_cost.hpp"
#include "tools/check/sentences.hpp"
#include "tools/drive_fit/calibration.hpp"
#include "tools/drive_fit/known_points.hpp"
#include "tools/drive_fit/tilt_calibration.hpp"

namespace azimuth {
namespace {

const double kSure = std::log(1e4);
constexpr double kSigmas = 4.0;
constexpr int kMostNamed = 3;
constexpr double kHalf = 0.5;          // a number is known if its sigma is below this fraction of `gross`
constexpr double kCostsShare = 0.025;  // position error per distance driven above which a mistake matters

bool is_off(const Off& off) { return std::abs(off.by) > kSigmas * off.sigma; }

/// The result of fitting the drive with one mistake corrected.
struct Tried {
  Explanation explanation;
  double evidence = 0.0;  // log likelihood gain minus the charge of Schwarz's criterion
  Off off;
  OffsetCost cost;

  Mistake mistake() const { return explanation.mistake; }
  bool is_gross() const { return std::abs(off.by) > row_of(mistake()).gross; }
  bool costs() const { return is_gross() || cost.share() > kCostsShare; }
  bool is_sure() const { return evidence > kSure && (is_of_two_worlds(mistake()) || (is_off(off) && costs())); }
};

class Judge {
 public:
  Judge(const Drive& drive, const Run& run, const Rig& rig, const HindsightSettings& settings, const Progress& progress)
      : drive_(drive), run_(run), rig_(rig), settings_(settings), progress_(progress) {
    for (std::size_t i = 0; i < kMistakes; ++i) result_.verdicts.emplace_back().mistake = static_cast<Mistake>(i);
    result_.rig = rig_;
  }

  Plausibility judge() {
    if (!recording_is_sound()) return std::move(result_);
    explanations_.emplace(drive_, rig_, settings_);
    for (int named = 0; named < kMostNamed; ++named) {
      std::vector<Tried> tried = try_all(named);
      const auto best = likeliest(tried);
      note(tried);
      if (best == tried.end()) break;
      name(*best, tried);
    }
    judge_tilt();
    judge_creep();
    judge_distance();
    const DriveSolution& now = explanations_->now();
    result_.rig = rig_saying(now.guess, rig_);
    set_centre(now.guess.centre_px);
    if (tilt_) {
      result_.rig.camera.roll_rad = tilt_->roll_rad;
      result_.rig.camera.pitch_rad = tilt_->pitch_rad;
    }
    result_.rig.odometry.scale_distance *= lengths_;
    if (creep_) result_.rig.odometry = with_floors_of(result_.rig.odometry, *creep_);
    result_.fitting = now.fitting;
    return std::move(result_);
  }

 private:
  MistakeVerdict& verdict(Mistake mistake) { return result_.verdicts[as_size(mistake)]; }
  void say(Mistake mistake, MistakeVerdict::Says says, std::string sentence) {
    verdict(mistake).says = says;
    verdict(mistake).sentence = std::move(sentence);
  }

  /// False if odometry leaps: no other mistake can be tested then.
  bool recording_is_sound() {
    const OdometryLeaps leaps = odometry_leaps(drive_.odometry);
    if (!leaps.is_any()) {
      say(Mistake::leaps, MistakeVerdict::Says::fits, "fits: no step that no wheel makes");
      say(Mistake::senders, MistakeVerdict::Says::fits, "fits: one track");
      return true;
    }
    const Mistake mistake = leaps.are_two_senders() ? Mistake::senders : Mistake::leaps;
    for (MistakeVerdict& each : result_.verdicts) each.sentence = sentence_hidden_by(mistake);
    const double first_s = to_seconds(leaps.first - drive_.odometry.front().stamp);
    say(mistake, MistakeVerdict::Says::wrong,
        mistake == Mistake::senders ? sentence_senders(leaps, first_s) : sentence_leaps(leaps, first_s));
    return false;
  }

  std::vector<Tried> try_all(int named) {
    std::vector<Tried> tried;
    const DriveSolution now = explanations_->now();
    const double drive_s = to_seconds(drive_.sets.back().stamp - drive_.sets.front().stamp);
    for (std::size_t i = 0; i < kMistakes; ++i) {
      const auto mistake = static_cast<Mistake>(i);
      if (progress_) progress_(as_size(named) * kMistakes + i, as_size(named + 1) * kMistakes);
      if (closed_[i]) continue;
      std::optional<Explanation> explanation = explanations_->explanation(mistake);
      if (!explanation) continue;
      const DriveSolution& found = explanation->solution;
      const double charge =
          0.5 * explanation->adjusted * std::log(static_cast<double>(std::max<std::size_t>(2, now.graph.bearings())));
      const double told = azimuth::evidence(found, now) - charge;
      const auto off = row_of(mistake).off;
      tried.push_back({*explanation, told, off != nullptr ? off(found, now, drive_s) : Off{},
                       off != nullptr ? offset_cost(drive_, now.guess, found.guess) : OffsetCost{}});
    }
    return tried;
  }

  /// The mistake with the most evidence among those that are sure. If its number is not grossly off, the function first
  /// replaces the number's covariance by spread_of(), which measures how well parts of the drive agree.
  std::vector<Tried>::iterator likeliest(std::vector<Tried>& tried) {
    const auto as_it_counts = [](const Tried& each) { return each.is_sure() ? each.evidence : 0.0; };
    while (true) {
      const auto best = std::ranges::max_element(tried, {}, as_it_counts);
      if (best == tried.end() || !best->is_sure()) return tried.end();
      if (is_of_two_worlds(best->mistake()) || best->is_gross()) return best;
      best->explanation.solution.covariance =
          spread_of(drive_, best->explanation.solution, best->explanation.free, settings_);
      const double drive_s = to_seconds(drive_.sets.back().stamp - drive_.sets.front().stamp);
      best->off = row_of(best->mistake()).off(best->explanation.solution, explanations_->now(), drive_s);
      if (best->is_sure()) return best;
    }
  }

  /// Records the verdicts `fits` and `cannot_tell` from the present fits.
  void note(const std::vector<Tried>& tried) {
    for (const Tried& each : tried) note(each);
    for (const Mistake mistake : {Mistake::jump, Mistake::centre})
      if (verdict(mistake).sentence.empty())
        say(mistake, mistake == Mistake::jump ? MistakeVerdict::Says::fits : MistakeVerdict::Says::cannot_tell,
            mistake == Mistake::jump ? "fits: one lag is as good as two" : sentence_cannot_tell(mistake, 0.0));
  }

  void note(const Tried& each) {
    const Mistake mistake = each.mistake();
    const RigGuess& found = each.explanation.solution.guess;
    const double sigma = each.off.sigma;
    const bool known = is_of_two_worlds(mistake) ? std::abs(each.evidence) > kSure
                                                 : sigma > 0.0 && sigma <= kHalf * row_of(mistake).gross;
    if (!known) return say(mistake, MistakeVerdict::Says::cannot_tell, sentence_cannot_tell(mistake, sigma));
    if (is_of_two_worlds(mistake) || !is_off(each.off))
      return say(mistake, MistakeVerdict::Says::fits, sentence_fits(mistake, rig_, found, sigma));
    if (!each.costs())
      return say(mistake, MistakeVerdict::Says::fits, sentence_nearly(mistake, rig_, found, sigma, each.cost));
    say(mistake, MistakeVerdict::Says::cannot_tell, sentence_doubtful(mistake, rig_, found, sigma));
  }

  void name(const Tried& best, const std::vector<Tried>& tried) {
    const auto of = [&](Mistake mistake) { return std::ranges::find(tried, mistake, &Tried::mistake); };
    const auto hand = of(Mistake::hand), wheels = of(Mistake::wheels);
    const bool could_be_either = is_of_two_worlds(best.mistake()) && hand != tried.end() && wheels != tried.end() &&
                                 std::abs(hand->evidence - wheels->evidence) < kSure;
    if (!could_be_either) return accept(best, said_of(best) + as_likely(best, tried));
    const std::optional<bool> map_is_mirrored = is_mirrored(hand->explanation.solution);
    const Tried& chosen = map_is_mirrored.value_or(false) ? *wheels : *hand;
    const Mistake other = &chosen == &*hand ? Mistake::wheels : Mistake::hand;
    const RigGuess& found = chosen.explanation.solution.guess;
    accept(chosen,
           sentence_wrong(chosen.mistake(), rig_, found,
                          map_is_mirrored ? std::nullopt : std::optional(of(other)->explanation.solution.guess)));
    if (map_is_mirrored) return say(other, MistakeVerdict::Says::fits, sentence_fits(other, rig_, found, 0.0));
    say(other, MistakeVerdict::Says::cannot_tell, sentence_either(other));
    closed_[as_size(other)] = true;
  }

  std::string said_of(const Tried& tried) const {
    const std::string wrong = sentence_wrong(tried.mistake(), rig_, tried.explanation.solution.guess, {});
    if (is_of_two_worlds(tried.mistake())) return wrong;
    return fmt::format("{} (as it is, that costs {})", wrong, sentence_costs(tried.cost));
  }

  /// Text about the best rival mistake that explains the drive nearly as well as `best`; empty if there is none.
  std::string as_likely(const Tried& best, const std::vector<Tried>& tried) const {
    const Tried* rival = nullptr;
    for (const Tried& each : tried)
      if (each.mistake() != best.mistake() && each.is_sure() && best.evidence - each.evidence < kSure &&
          (rival == nullptr || each.evidence > rival->evidence))
        rival = &each;
    if (rival == nullptr) return {};
    return fmt::format("; or, hardly less likely, {}: {}", to_string(rival->mistake()),
                       sentence_wrong(rival->mistake(), rig_, rival->explanation.solution.guess, {}));
  }

  void accept(const Tried& tried, std::string sentence) {
    say(tried.mistake(), MistakeVerdict::Says::wrong, std::move(sentence));
    verdict(tried.mistake()).evidence = tried.evidence;
    closed_[as_size(tried.mistake())] = true;
    explanations_->accept(tried.explanation.solution);
  }

  /// Runs after the image centre is corrected, since a wrong centre and a tilt have nearly the same effect in an image.
  void judge_tilt() {
    const DriveSolution& now = explanations_->now();
    if (now.guess.mirrored)
      return say(Mistake::tilt, MistakeVerdict::Says::cannot_tell, sentence_hidden_by(Mistake::hand));
    const std::optional<TiltCalibration> found = calibrate_tilt(drive_, now, settings_);
    if (!found || !found->told)
      return say(Mistake::tilt, MistakeVerdict::Says::cannot_tell,
                 sentence_cannot_tell(Mistake::tilt, found ? found->sigma_rad : 0.0));
    if (!found->contradicts) return say(Mistake::tilt, MistakeVerdict::Says::fits, sentence_leans_as_said(*found));
    say(Mistake::tilt, MistakeVerdict::Says::wrong, sentence_leans(*found, tilt_of(rig_.camera)));
    tilt_ = found->tilt;
  }

  void judge_creep() {
    const Creep creep = creep_of(drive_, explanations_->now());
    if (creep.slow_s == 0.0)
      return say(Mistake::creep, MistakeVerdict::Says::cannot_tell, sentence_cannot_tell(Mistake::creep, 0.0));
    if (!creep.is_told()) return say(Mistake::creep, MistakeVerdict::Says::fits, sentence_stands(creep.slow_s));
    creep_ = creep;
    say(Mistake::creep, MistakeVerdict::Says::wrong, sentence_creeps(creep, with_floors_of(rig_.odometry, creep)));
    verdict(Mistake::creep).evidence = creep.evidence;
  }

  /// Comparison with the surveyed landmarks or with the true path, whichever gives the smaller uncertainty: one poorly
  /// estimated landmark makes the whole map uncertain. Nothing if neither comparison is possible.
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
    const std::optional<Likeness> like = likeness_to_truth(explanations_->now());
    const double known = kHalf * row_of(Mistake::distance).gross;
    if (!like || like->lengths.sigma > known)
      return say(Mistake::distance, MistakeVerdict::Says::cannot_tell,
                 sentence_cannot_tell(Mistake::distance, like ? like->lengths.sigma : 0.0));
    const Off off{like->lengths.scale - 1.0, like->lengths.sigma};
    if (!is_off(off) || std::abs(off.by) <= row_of(Mistake::distance).gross)
      return say(Mistake::distance, MistakeVerdict::Says::fits, sentence_distance_fits(like->lengths));
    const double key = explanations_->now().guess.rig.odometry.scale_distance * like->lengths.scale;
    say(Mistake::distance, MistakeVerdict::Says::wrong, sentence_distance_wrong(like->lengths, key));
    verdict(Mistake::distance).evidence = 0.5 * off.by * off.by / (off.sigma * off.sigma);
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
  const HindsightSettings& settings_;
  const Progress& progress_;
  std::optional<Explanations> explanations_;
  double lengths_ = 1.0;
  std::optional<Creep> creep_;
  std::optional<CameraTilt> tilt_;
  std::array<bool, kMistakes> closed_{};  // mistakes that are not tried any more: named, or undecidable
  Plausibility result_;
};

}  // namespace

bool Plausibility::anything_wrong() const {
  return std::ranges::any_of(verdicts,
                             [](const MistakeVerdict& each) { return each.says == MistakeVerdict::Says::wrong; });
}

Plausibility judge(const Drive& drive, const Run& run, const Rig& rig, const HindsightSettings& settings,
                   const Progress& progress) {
  return Judge(drive, run, rig, settings, progress).judge();
}

}  // namespace azimuth
