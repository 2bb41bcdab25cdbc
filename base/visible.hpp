#pragma once
// What others have written, and people are to read on a terminal or in a journal: names of files, topics, channels and
// robots, words of the command line. A terminal obeys what is in it, and a line end forges a line.
//
// Thread contract: reentrant.

#include <string>
#include <string_view>

namespace azimuth {

/// One line: control characters, bytes that are no UTF-8, and characters that turn the direction of writing or cannot
/// be seen as \n, \x1b, \u202e; all else as it is.
std::string visible(std::string_view text);

/// The same of lines that are ours, with something of others in them: line ends stay.
std::string visible_lines(std::string_view text);

}  // namespace azimuth
