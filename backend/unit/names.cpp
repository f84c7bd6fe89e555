#include "backend/unit/names.h"

#include <algorithm>

namespace rung::backend {
namespace {

// Keywords, operators of instruction lists, standard functions and blocks:
// compilers refuse them as names, or read them as something else.
constexpr std::string_view kIecWords =
    "ABS ACOS ACTION ADD AND ANDN ANY ARRAY ASIN AT ATAN BOOL BY BYTE CAL "
    "CALC CALCN CALNC CASE CD CLK CONCAT CONFIGURATION CONSTANT COS CTD "
    "CTU CTUD CU DATE DATE_AND_TIME DELETE DINT DIV DO DS DT DWORD "
    "ELSE ELSIF EN END_ACTION END_CASE END_CONFIGURATION END_FOR "
    "END_FUNCTION END_FUNCTION_BLOCK END_IF END_PROGRAM END_REPEAT "
    "END_RESOURCE END_STEP END_STRUCT END_TRANSITION END_TYPE END_VAR "
    "END_WHILE ENO EQ EXIT EXP EXPT FALSE FIND FOR FROM FUNCTION "
    "FUNCTION_BLOCK F_EDGE F_TRIG GE GT IF IN INITIAL_STEP INSERT INT "
    "INTERVAL JMP JMPC JMPCN JMPNC LD LDN LE LEFT LEN LIMIT LINT LN LOG "
    "LREAL LT LWORD MAX MID MIN MOD MOVE MUL MUX NE NON_RETAIN NOT OF ON "
    "OR ORN PRIORITY PROGRAM PT PV R R1 READ_ONLY READ_WRITE "
    "REAL REPEAT REPLACE RESOURCE RET RETAIN RETC RETCN RETNC RETURN RIGHT "
    "ROL ROR RS RTC R_EDGE R_TRIG S S1 SD SEL SEMA SHL SHR SIN SINGLE SINT "
    "SL SQRT SR ST STEP STN STRING STRUCT SUB TAN TASK THEN TIME "
    "TIME_OF_DAY TO TOD TOF TON TP TRANSITION TRUE TRUNC TYPE UDINT UINT "
    "ULINT UNTIL USINT VAR VAR_ACCESS VAR_EXTERNAL VAR_GLOBAL VAR_INPUT "
    "VAR_IN_OUT VAR_OUTPUT VAR_TEMP WHILE WITH WORD WSTRING XOR XORN";

char upper(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

bool is_letter(char c) { return upper(c) >= 'A' && upper(c) <= 'Z'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

NameTable::NameTable(const NameRules& rules) : rules_(&rules) {
  std::string_view words = rules.reserved;
  while (!words.empty()) {
    const std::size_t end = std::min(words.find(' '), words.size());
    taken_.insert(key_of(words.substr(0, end)));
    words.remove_prefix(std::min(end + 1, words.size()));
  }
}

std::string NameTable::spelled(std::string_view name) const {
  std::string text;
  for (const char c : name) {
    const bool plain =
        is_letter(c) || is_digit(c) || (c == '_' && rules_->plain_underscores);
    if (plain) {
      text += c;
    } else if (!text.empty() && text.back() != '_') {
      text += '_';
    }
  }
  const bool any = rules_->plain_underscores;
  while (!any && !text.empty() && text.back() == '_') text.pop_back();
  const bool begins = !text.empty() && (is_letter(text[0]) || text[0] == '_');
  if (!begins) text.insert(0, "v");
  if (rules_->longest != 0 && text.size() > rules_->longest) {
    text.resize(rules_->longest);
    while (text.back() == '_') text.pop_back();
  }
  return text;
}

std::string NameTable::key_of(std::string_view name) const {
  std::string key(name);
  if (rules_->ignores_case) {
    std::transform(key.begin(), key.end(), key.begin(), upper);
  }
  return key;
}

bool NameTable::take(const std::string& name) {
  if (rules_->is_reserved != nullptr && rules_->is_reserved(name)) return false;
  return taken_.insert(key_of(name)).second;
}

std::string NameTable::add(std::string_view wanted) {
  std::string name = spelled(wanted);
  return take(name) ? name : make(name);
}

std::string NameTable::make(std::string_view prefix) {
  std::string base = spelled(prefix);
  // Room for a number.
  if (rules_->longest != 0 && base.size() + 7 > rules_->longest) {
    base.resize(rules_->longest > 7 ? rules_->longest - 7 : 1);
    while (base.back() == '_') base.pop_back();
  }
  std::uint32_t& number = next_[key_of(base)];
  while (true) {
    std::string name = base + "_" + std::to_string(++number);
    if (take(name)) return name;
  }
}

const NameRules& iec_names() {
  static constexpr NameRules kRules = {.reserved = kIecWords};
  return kRules;
}

}  // namespace rung::backend
