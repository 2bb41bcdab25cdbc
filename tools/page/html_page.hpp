#pragma once
#include <string>
#include <string_view>

namespace azimuth {

/// One page that needs nothing but itself: the modules of the report and their style, and what they show. `data` is a
/// JSON object, of whatever text; `module`, which shows it, says its members. The page's policy lets nothing be loaded,
/// and no script run but its own. Reentrant.
std::string html_page(std::string_view title, std::string_view data, std::string_view module = "report.js");

/// Text as it stands between tags.
std::string html_text(std::string_view text);

/// JSON that may stand within a script's tags: "<", ">" and "&" by their numbers.
std::string json_in_html(std::string_view json);

/// A module and those that it needs, one after the other in one: without `import ... from './file.js';` and
/// `export`, each of which stands at the beginning of a line, an import on one line.
std::string joined_modules(std::string_view module = "report.js");

}  // namespace azimuth
