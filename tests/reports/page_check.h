#pragma once

#include <string>

namespace rung::test {

/// What is wrong with a page or picture, a line each: not well-formed (libxml2
/// reads it as XML), an element or attribute that a report does not use, which
/// all that could run or load something are; a script that is neither data nor
/// the page's own; an id twice, a link to nowhere.
std::string problems_of(const std::string& page);

}  // namespace rung::test
