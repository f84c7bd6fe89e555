#pragma once

#include <string>
#include <string_view>

namespace rung {

/// As `diff -u` and `git apply` have it, with three lines of context; empty
/// when the texts are equal. Texts that differ in more than some thousand lines
/// may come out as one large change instead of several small ones.
std::string unified_diff(const std::string& path, std::string_view before,
                         std::string_view after);

}  // namespace rung
