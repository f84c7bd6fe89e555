#pragma once

#include <string_view>

namespace rung {

/// The page's style rules; those of ladders are in ladder_style(). The page is
/// neutral where all is well and loud where it is not, and every colour has a
/// word beside it.
std::string_view html_style();

}  // namespace rung
