#include "reports/paint.h"

namespace rung {
namespace {

std::string_view escape_of(Ink ink) {
  switch (ink) {
    case Ink::Error:
      return "\x1b[1;31m";
    case Ink::Warning:
      return "\x1b[1;33m";
    case Ink::Note:
      return "\x1b[1;36m";
    case Ink::Good:
      return "\x1b[1;32m";
    case Ink::Frame:
      return "\x1b[1;34m";
    case Ink::Changed:
      return "\x1b[1;35m";
    case Ink::Strong:
      return "\x1b[1m";
  }
  return {};
}

}  // namespace

std::string Painter::operator()(Ink ink, std::string_view text) const {
  if (!colour_ || text.empty()) return std::string(text);
  return std::string(escape_of(ink)) + std::string(text) + "\x1b[0m";
}

Ink ink_of(Severity severity) {
  switch (severity) {
    case Severity::Note:
      return Ink::Note;
    case Severity::Warning:
      return Ink::Warning;
    case Severity::Error:
      return Ink::Error;
  }
  return Ink::Note;
}

}  // namespace rung
