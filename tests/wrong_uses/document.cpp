#include "tests/wrong_uses/document.hpp"

#include <charconv>
#include <fstream>
#include <sstream>

namespace azimuth::test {
namespace {

constexpr std::string_view kAnything = "\xE2\x80\xA6";  // the ellipsis character

std::string trimmed(std::string text) {
  text.erase(0, text.find_first_not_of(' '));
  text.erase(text.find_last_not_of(' ') + 1);
  return text;
}

/// The cell without its backquotes.
std::string code(std::string cell) {
  if (cell.size() >= 2 && cell.front() == '`' && cell.back() == '`') return cell.substr(1, cell.size() - 2);
  return cell;
}

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line.substr(1));
  for (std::string cell; std::getline(stream, cell, '|');) cells.push_back(trimmed(cell));
  return cells;
}

int number(const std::string& text) {
  int value = -1;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

/// True if the line contains the pieces of the answer between the ellipses, in order.
bool line_answers(std::string_view line, std::string_view answer) {
  for (;;) {
    const std::size_t end = answer.find(kAnything);
    const std::string_view piece = answer.substr(0, end);
    const std::size_t at = line.find(piece);
    if (at == std::string_view::npos) return false;
    if (end == std::string_view::npos) return true;
    line.remove_prefix(at + piece.size());
    answer.remove_prefix(end + kAnything.size());
  }
}

}  // namespace

std::vector<WrongUse> wrong_uses(const std::filesystem::path& document) {
  std::vector<WrongUse> rows;
  std::ifstream stream(document);
  for (std::string line; std::getline(stream, line);) {
    if (!line.starts_with("| ") || number(line.substr(2)) < 0) continue;
    const std::vector<std::string> row = cells(line);
    if (row.size() != 5) {
      rows.push_back({.number = row.front(), .done = line, .command = {}, .exit_code = -1, .answer = {}});
      continue;
    }
    rows.push_back({row[0], row[1], code(row[2]), number(row[3]), code(row[4])});
  }
  return rows;
}

bool answers(const std::string& printed, const std::string& answer) {
  std::istringstream stream(printed);
  for (std::string line; std::getline(stream, line);)
    if (line_answers(line, answer)) return true;
  return false;
}

}  // namespace azimuth::test
