#include <string>

#include "frontend/plclib/machine.h"

namespace rung::plclib {

/// Statements that concern the board or a serial line, and no value of the
/// program. True: it was one, and it is behind the cursor.
bool Machine::no_effect() {
  if (!cursor_.at_word()) return false;
  const SourceRange where = cursor_.here();
  const std::string_view name = cursor_.text();
  if (cursor_.at(".", 1)) {
    if (name != "Serial") return false;
    print(name);
    return true;
  }
  if (!cursor_.at("(", 1)) return false;
  const bool board =
      name == "setupPLC" || name == "pinMode" || name == "customIO";
  if (board && !in_setup_) {
    fail("RP055", where,
         quoted_excerpt(name) + " outside setup() is not supported");
    cursor_.skip_statement();
    return true;
  }
  if (name == "setupPLC") {
    set_up_plc(where);
  } else if (name == "pinMode") {
    pin_mode(where);
  } else if (name == "customIO") {
    custom_io(where);
  } else if (name == "serialMonitor") {
    print(name);
  } else {
    return false;
  }
  return true;
}

void Machine::set_up_plc(SourceRange /*where*/) {
  for (int i = 0; i < 2; ++i) cursor_.take();
  if (!expect(")") || !expect(";")) return cursor_.skip_statement();
  if (sketch_.no_pin_defs) return;  // it then does nothing
  for (const char bank : {'X', 'Y'}) {
    for (char digit = '0'; digit <= '7'; ++digit) {
      const std::string name = {bank, digit};
      const auto number = pin_number(name);
      if (!number) continue;
      Pin* const pin = pin_at(*number, writer_.keep_text(name), cursor_.here());
      if (pin == nullptr) continue;
      pin->mode = bank == 'X' ? Pin::Mode::Input : Pin::Mode::Output;
      pin->initial = 0;
    }
  }
}

void Machine::pin_mode(SourceRange where) {
  for (int i = 0; i < 2; ++i) cursor_.take();
  const auto given = arguments();
  if (!given || !expect(";")) return cursor_.skip_statement();
  const bool known =
      given->size() == 2 &&
      ((*given)[1].name == "INPUT" || (*given)[1].name == "INPUT_PULLUP" ||
       (*given)[1].name == "OUTPUT");
  if (!known) {
    return fail("RP058", where,
                "`pinMode` has a pin and `INPUT`, `INPUT_PULLUP` or `OUTPUT`");
  }
  if (Pin* const pin = pin_of((*given)[0])) {
    pin->mode =
        (*given)[1].name == "OUTPUT" ? Pin::Mode::Output : Pin::Mode::Input;
  }
}

/// Where it stands in another tab, pins have the directions that their use
/// needs.
void Machine::custom_io(SourceRange where) {
  for (int i = 0; i < 2; ++i) cursor_.take();
  if (!expect(")") || !expect(";")) return cursor_.skip_statement();
  modes_unknown_ = true;
  errors_.report({.code = "RP050",
                  .severity = Severity::Note,
                  .where = where,
                  .message = "`customIO` is not in this file: it is taken to "
                             "set the directions of pins and nothing else",
                  .labels = {}});
}

/// What is printed may look at anything, but not change it.
void Machine::print(std::string_view name) {
  const SourceRange where = cursor_.here();
  cursor_.take();
  bool known = true;
  if (cursor_.accept(".")) {
    known = false;
    for (const char* const method :
         {"begin", "end", "flush", "print", "println", "write"}) {
      known = known || cursor_.at_keyword(method);
    }
    cursor_.take();
  }
  const bool call = cursor_.at("(");
  const std::size_t begin = cursor_.position();
  if (call) cursor_.skip_brackets();
  const std::size_t end = cursor_.position();
  bool looks = true;
  cursor_.go_to(begin + 1);
  while (cursor_.position() < end) {
    const bool called = cursor_.at_word() && cursor_.at("(", 1);
    const std::string_view text = cursor_.text();
    looks = looks && (!called || text == "count" || text == "presetValue" ||
                      text == "millis" || text == "F" ||
                      text == "digitalRead" || text == "analogRead");
    const bool changes =
        cursor_.at("=") || cursor_.at("++") || cursor_.at("--");
    looks = looks && !changes;
    cursor_.take();
  }
  if (!call || !known || !looks) {
    fail("RP055", where,
         "this use of " + quoted_excerpt(name) + " is not supported");
  } else if (!expect(";")) {
    cursor_.skip_statement();
  }
}

}  // namespace rung::plclib
