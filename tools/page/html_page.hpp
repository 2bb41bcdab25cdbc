#pragma once
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace azimuth {

/// An embedded file of this folder for browsers.
struct PageFile {
  std::string_view name;  ///< such as "map_view.js", "page.html"
  std::string_view text;
};

/// All style sheets, all modules (each after its imports), and the page that loads them. Reentrant.
std::span<const PageFile> page_files();

/// A self-contained HTML page with the script modules, the style sheet and the data. `data` is a JSON object that may
/// contain any text; `module` displays it and documents its members. The Content-Security-Policy of the page forbids
/// loading anything and running other scripts. Reentrant.
std::string html_page(std::string_view title, std::string_view data, std::string_view module = "report.js");

/// A self-contained page in the same style that needs no script. `body` is the HTML of the main element, in which all
/// foreign text is escaped. The Content-Security-Policy forbids loading anything and running any script. Reentrant.
std::string page_without_script(std::string_view title, std::string_view body);

/// Escapes text for use between HTML tags, and in attributes with double quotes.
std::string html_text(std::string_view text);

/// Escapes JSON for use inside a script element: "<", ">" and "&" become numeric escapes.
std::string json_in_html(std::string_view json);

/// Concatenates a module and the modules it imports into one script, without `import ... from './file.js';` and
/// `export`. Both must be at the beginning of a line, and an import must be on one line.
std::string joined_modules(std::string_view module = "report.js");

/// SHA-256 (FIPS 180-4), by which a Content-Security-Policy identifies a script. Reentrant.
std::array<std::byte, 32> sha256(std::string_view text);

/// Base64 encoding of RFC 4648 with padding. Reentrant.
std::string base64(std::span<const std::byte> bytes);

}  // namespace azimuth
