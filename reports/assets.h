#pragma once

#include <string>
#include <string_view>

namespace rung {

/// A text that pages and pictures carry, from a source file of its own
/// (reports/assets.cmake).
struct Asset {
  std::string_view text;
  std::string_view sha256;  // of the text, in hexadecimal
};
extern const Asset kPageScript;   // html/*.js
extern const Asset kPageStyle;    // html/page.css
extern const Asset kLadderStyle;  // ladder/ladder.css

/// `'sha256-...'`, as a Content-Security-Policy allows an inline script or
/// style by it.
std::string csp_source(const Asset& asset);

}  // namespace rung
