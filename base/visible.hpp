#pragma once
// Makes text of foreign origin safe for a terminal or a journal: names of files, topics, channels and robots, and words
// of the command line. Control characters could command a terminal, and a line end could forge a line.
//
// Thread contract: reentrant.

#include <string>
#include <string_view>

namespace azimuth {

/// Escapes control characters, bytes that are not UTF-8, and characters that are invisible or change the direction of
/// writing, as \n, \x1b, \u202e. All other characters stay. The result is one line.
std::string visible(std::string_view text);

/// Like visible(), but keeps the line ends, for a text whose line ends come from this program.
std::string visible_lines(std::string_view text);

}  // namespace azimuth
