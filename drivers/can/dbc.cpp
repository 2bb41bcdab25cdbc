#include "drivers/can/dbc.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>

namespace azimuth {
namespace {

/// The text of a DBC file, consumed from its beginning. A function that does not find its element consumes nothing.
/// Blanks before an element are skipped, but not line ends, because a truncated statement must not continue in the next
/// line.
///
/// Thread contract: thread-bound; never allocates.
class DbcText {
 public:
  DbcText(std::string_view text, int line) : rest_(text), line_(line) {}

  bool at_end() const { return rest_.empty(); }
  int line() const { return line_; }

  void skip_space();  ///< skips line ends as well
  /// Skips to the next line; a string on the way may span several lines. False: a string has no end.
  bool skip_statement_line();

  std::string_view word();  ///< letters, digits and '_'; empty: none
  bool take(char c);
  std::optional<std::uint64_t> natural();
  std::optional<double> number();  ///< a finite number; none: there is none

 private:
  void skip_blanks();
  void drop(std::size_t count) { rest_.remove_prefix(count); }

  std::string_view rest_;
  int line_;
};

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

bool is_word(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_'; }

/// Parses a number at the beginning of `text`. Returns its number of characters; 0: there is none.
template <class Number>
std::size_t parse(std::string_view text, Number& number) {
  const auto [end, wrong] = std::from_chars(text.data(), text.data() + text.size(), number);
  return wrong == std::errc{} ? static_cast<std::size_t>(end - text.data()) : 0;
}

void DbcText::skip_blanks() {
  while (!rest_.empty() && is_blank(rest_.front())) drop(1);
}

void DbcText::skip_space() {
  for (; !rest_.empty() && (is_blank(rest_.front()) || rest_.front() == '\n'); drop(1)) line_ += rest_.front() == '\n';
}

bool DbcText::skip_statement_line() {
  bool in_string = false;
  while (!rest_.empty()) {
    const char c = rest_.front();
    drop(1);
    if (in_string && c == '\\' && rest_.starts_with('"')) {
      drop(1);
      continue;
    }
    if (c == '"') in_string = !in_string;
    if (c != '\n') continue;
    ++line_;
    if (!in_string) return true;
  }
  return !in_string;
}

std::string_view DbcText::word() {
  skip_blanks();
  const auto end = std::ranges::find_if_not(rest_, is_word);
  const std::string_view word = rest_.substr(0, static_cast<std::size_t>(end - rest_.begin()));
  drop(word.size());
  return word;
}

bool DbcText::take(char c) {
  skip_blanks();
  if (rest_.empty() || rest_.front() != c) return false;
  drop(1);
  return true;
}

std::optional<std::uint64_t> DbcText::natural() {
  skip_blanks();
  std::uint64_t number = 0;
  const std::size_t used = parse(rest_, number);
  if (used == 0) return std::nullopt;
  drop(used);
  return number;
}

std::optional<double> DbcText::number() {
  skip_blanks();
  const std::string_view unsigned_text = rest_.starts_with('+') ? rest_.substr(1) : rest_;
  double number = 0.0;
  const std::size_t used = parse(unsigned_text, number);
  if (used == 0 || !std::isfinite(number)) return std::nullopt;
  drop(used + (rest_.size() - unsigned_text.size()));
  return number;
}

constexpr std::uint64_t kExtendedFlag = 0x80000000U;
constexpr std::uint64_t kNoFrame = 0xC0000000U;  // holds signals that belong to no frame

/// The role of a signal in multiplexing.
struct Role {
  bool selects = false;
  std::optional<std::uint64_t> selected_by;  // the multiplexer's value
};

/// Parses the role of a signal: "M", "m5" or "m5M".
std::optional<Role> role_of(std::string_view word) {
  Role role;
  if (word.ends_with('M')) {
    role.selects = true;
    word.remove_suffix(1);
  }
  if (word.empty()) return role.selects ? std::optional(role) : std::nullopt;
  DbcText number(word.substr(1), 1);
  role.selected_by = number.natural();
  if (word.front() != 'm' || !role.selected_by || !number.at_end()) return std::nullopt;
  return role;
}

std::optional<CanId> id_of(std::uint64_t number) {
  const bool extended = (number & kExtendedFlag) != 0;
  const std::uint64_t id = number & ~kExtendedFlag;
  if (id > largest_can_id(extended)) return std::nullopt;
  return CanId{static_cast<std::uint32_t>(id), extended};
}

class DbcReader {
 public:
  DbcReader(std::string_view text, const std::string& file) : text_(text, 1) { dbc_.file = file; }

  FileResult<Dbc> read() {
    while (!text_.at_end()) {
      text_.skip_space();
      statement(text_.word());
      const int line = text_.line();
      if (!text_.skip_statement_line()) errors_.push_back({dbc_.file, line, "begins a string that has no end"});
    }
    finish_message();
    if (!errors_.empty()) return failure(errors_);
    return std::move(dbc_);
  }

 private:
  void statement(std::string_view keyword) {
    if (keyword == "BO_") {
      finish_message();
      message();
    } else if (keyword == "SG_") {
      signal();
    } else if (keyword == "SIG_VALTYPE_") {
      value_type();
    }
  }

  void error(std::string message) { errors_.push_back({dbc_.file, text_.line(), std::move(message)}); }

  /// BO_ 256 Name: 8 Sender
  void message() {
    current_ = Current::none;
    const auto id = text_.natural();
    const std::string_view name = text_.word();
    const bool colon = text_.take(':');
    const auto size = text_.natural();
    if (!id || name.empty() || !colon || !size || *size > CanFrame::kMostBytes)
      return error("is no frame: expected BO_ id name: bytes sender, with at most 64 bytes");
    current_ = Current::passed_over;
    if (*id == kNoFrame) return;
    const auto can_id = id_of(*id);
    current_ = Current::none;
    if (!can_id) return error(fmt::format("id {} is too large", *id));
    current_ = Current::message;
    dbc_.messages.push_back({std::string(name), *can_id, static_cast<int>(*size), text_.line(), {}});
    roles_.clear();
  }

  /// SG_ Name m0 : 16|8@1+ (0.5,-40) [0|100] "unit" Receivers
  void signal() {
    if (current_ == Current::passed_over) return;
    if (current_ == Current::none) return error("SG_ stands outside a frame");
    const std::string_view name = text_.word();
    const std::string_view role_word = text_.word();  // empty before the colon
    const std::optional<Role> role = role_word.empty() ? Role{} : role_of(role_word);
    CanSignal signal;
    signal.frame = dbc_.messages.back().id;
    if (name.empty() || !role || !text_.take(':') || !layout(signal) || !scaling(signal))
      return error("is no signal: expected SG_ name : start|bits@order sign (scale,offset) ...");
    DbcMessage& message = dbc_.messages.back();
    message.signals.push_back({std::string(name), signal, text_.line(), problem_of(signal)});
    roles_.push_back(*role);
    DbcSignal& added = message.signals.back();
    if (!added.problem && bytes_needed(signal.bits) > message.size)
      added.problem = fmt::format("reaches beyond the {} bytes of its frame", message.size);
  }

  bool layout(CanSignal& signal) {
    const auto start = text_.natural();
    const bool bar = text_.take('|');
    const auto length = text_.natural();
    const bool at = text_.take('@');
    const auto order = text_.natural();
    const bool positive = text_.take('+');
    const bool any_sign = positive || text_.take('-');
    constexpr std::uint64_t kAbsurd = 1'000'000;
    if (!start || !bar || !length || !at || !order || *order > 1 || !any_sign) return false;
    if (*start > kAbsurd || *length > kAbsurd) return false;
    signal.bits = {static_cast<int>(*start), static_cast<int>(*length),
                   *order == 1 ? CanByteOrder::intel : CanByteOrder::motorola};
    signal.number = positive ? CanNumber::unsigned_integer : CanNumber::signed_integer;
    return true;
  }

  bool scaling(CanSignal& signal) {
    const bool open = text_.take('(');
    const auto scale = text_.number();
    const bool comma = text_.take(',');
    const auto offset = text_.number();
    if (!open || !scale || !comma || !offset || !text_.take(')')) return false;
    signal.scale = *scale;
    signal.offset = *offset;
    return true;
  }

  /// SIG_VALTYPE_ 256 Name : 1;   1: float of 32 bits, 2: of 64
  void value_type() {
    const auto id = text_.natural();
    const std::string_view name = text_.word();
    text_.take(':');
    const auto type = text_.natural();
    if (!id || name.empty() || !type || *type > 3)
      return error("is no value type: expected SIG_VALTYPE_ id name : 0 to 3");
    const auto can_id = id_of(*id);
    if (!can_id || *type == 0 || *type == 3) return;
    for (DbcMessage& message : dbc_.messages) {
      if (message.id != *can_id) continue;
      for (DbcSignal& signal : message.signals)
        if (signal.name == name) make_float(signal, *type == 1 ? 32 : 64);
    }
  }

  static void make_float(DbcSignal& signal, int length_bits) {
    if (signal.problem) return;
    signal.signal.number = CanNumber::ieee_float;
    if (signal.signal.bits.length_bits != length_bits)
      signal.problem = fmt::format("is a float of {} bits in {}", length_bits, signal.signal.bits.length_bits);
  }

  /// Called when all signals of a frame are known, because a multiplexed signal may come before its multiplexer.
  void finish_message() {
    if (current_ != Current::message) return;
    current_ = Current::none;
    std::vector<DbcSignal>& signals = dbc_.messages.back().signals;
    const auto selecting = std::ranges::count_if(roles_, &Role::selects);
    const auto selector = std::ranges::find_if(roles_, &Role::selects) - roles_.begin();
    for (std::size_t i = 0; i < roles_.size(); ++i) {
      if (!roles_[i].selected_by || signals[i].problem) continue;
      if (selecting == 0) signals[i].problem = "is multiplexed, and its frame has no multiplexer";
      if (selecting > 1) signals[i].problem = "needs extended multiplexing, which is not supported";
      if (selecting != 1) continue;
      const DbcSignal& by = signals[static_cast<std::size_t>(selector)];
      if (by.problem) signals[i].problem = "its multiplexer " + by.name + ' ' + *by.problem;
      signals[i].signal.multiplexer = CanSignal::Multiplexer{by.signal.bits, *roles_[i].selected_by};
    }
  }

  DbcText text_;
  Dbc dbc_;
  FileErrors errors_;
  enum class Current { none, passed_over, message } current_ = Current::none;  // the frame to which SG_ belongs
  std::vector<Role> roles_;                                                    // roles of the current frame's signals
};

}  // namespace

const DbcSignal* Dbc::find(std::string_view name) const {
  const std::size_t dot = name.find('.');
  if (dot == std::string_view::npos) return nullptr;
  for (const DbcMessage& message : messages) {
    if (message.name != name.substr(0, dot)) continue;
    for (const DbcSignal& signal : message.signals)
      if (signal.name == name.substr(dot + 1)) return &signal;
  }
  return nullptr;
}

FileResult<Dbc> read_dbc(std::string_view text, const std::string& file) { return DbcReader(text, file).read(); }

}  // namespace azimuth
