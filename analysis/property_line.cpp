#include "analysis/property_line.h"

#include <algorithm>
#include <array>
#include <utility>

#include "analysis/property_patterns.h"
#include "analysis/property_text.h"
#include "base/text.h"

namespace rung {
namespace {

class LineParser {
 public:
  LineParser(const Slice& line, DiagnosticSink& sink) : sink_(sink) {
    statement_.line = line;
  }

  std::optional<Statement> parse();

 private:
  using Reader = void (LineParser::*)(const Slice&);
  struct Keyword {
    std::string_view word;
    Reader read;
  };
  static const std::array<Keyword, 18> kKeywords;

  void fail(const Slice& at, std::string message) {
    fail("RP060", at, std::move(message));
  }
  void fail(std::string_view code, const Slice& at, std::string message) {
    if (!failed_) {
      sink_.report({.code = code,
                    .severity = Severity::Error,
                    .where = at.where,
                    .message = std::move(message)});
    }
    failed_ = true;
  }

  /// The place right after `slice`, for what is missing there.
  static Slice after(const Slice& slice) {
    return slice.part(slice.text.size());
  }

  void take_name(Slice& rest);
  void read_unnamed(const Slice& rest);
  void unknown(const Slice& rest);

  void read_always(const Slice& rest) { one(Property::Form::Always, rest); }
  void read_never(const Slice& rest) { one(Property::Form::Never, rest); }
  void read_reach(const Slice& rest) { one(Property::Form::Reach, rest); }
  void read_recoverable(const Slice& rest) {
    one(Property::Form::Recoverable, rest);
  }
  void read_interlock(const Slice& rest);
  void read_latch(const Slice& rest);
  void read_after(const Slice& rest);
  bool take_no(Slice& part);
  void read_for(const Slice& rest, std::size_t implies);
  void read_settles(const Slice& rest);
  void read_eventually(const Slice& rest);
  void read_pattern(const Slice& rest);
  void read_assume(const Slice& rest);
  void read_input(const Slice& rest);
  void take_wiring();
  void read_output(const Slice& rest);
  void read_scan(const Slice& rest);
  void read_expect(const Slice& rest);
  void read_ignored(const Slice& /*rest*/) {
    statement_.kind = Statement::Kind::Ignored;
  }

  void one(Property::Form form, const Slice& rest) {
    statement_.property.form = form;
    formula(rest);
  }
  void formula(const Slice& text) {
    if (text.empty()) fail(text, "an expression is missing here");
    statement_.formulas.push_back(text);
  }
  void time(const Slice& text, bool scans_allowed);
  std::optional<std::int64_t> whole(const Slice& text);
  bool range(const Slice& text, std::string_view unit);

  DiagnosticSink& sink_;
  Statement statement_;
  Slice word_;
  bool failed_ = false;
};

const std::array<LineParser::Keyword, 18> LineParser::kKeywords = {{
    {"after", &LineParser::read_after},
    {"allow", &LineParser::read_ignored},
    {"always", &LineParser::read_always},
    {"assume", &LineParser::read_assume},
    {"dialect", &LineParser::read_ignored},
    {"eventually", &LineParser::read_eventually},
    {"expect", &LineParser::read_expect},
    {"input", &LineParser::read_input},
    {"interlock", &LineParser::read_interlock},
    {"language", &LineParser::read_ignored},
    {"latch", &LineParser::read_latch},
    {"never", &LineParser::read_never},
    {"output", &LineParser::read_output},
    {"pattern", &LineParser::read_pattern},
    {"reach", &LineParser::read_reach},
    {"recoverable", &LineParser::read_recoverable},
    {"scan", &LineParser::read_scan},
    {"settles", &LineParser::read_settles},
}};

struct Unit {
  std::string_view word;
  std::int64_t milliseconds;  // 0: scans
};
constexpr std::array<Unit, 6> kUnits = {{{"ms", 1},
                                         {"s", 1000},
                                         {"min", 60'000},
                                         {"h", 3'600'000},
                                         {"scans", 0},
                                         {"scan", 0}}};

// A year; elapsed times stay far below the bounds of terms.
constexpr std::int64_t kMaxTime = std::int64_t{366} * 24 * 3'600'000;
constexpr std::int64_t kMaxScans = 1'000'000;

std::optional<Statement> LineParser::parse() {
  Slice rest = statement_.line.part(0);
  take_name(rest);
  std::size_t end = 0;
  while (end < rest.text.size() && is_word_part(rest.text[end])) ++end;
  word_ = rest.part(0, end);
  const auto* const keyword =
      std::find_if(kKeywords.begin(), kKeywords.end(),
                   [&](const Keyword& row) { return row.word == word_.text; });
  if (keyword == kKeywords.end()) {
    read_unnamed(rest);
  } else {
    (this->*keyword->read)(rest.part(end));
  }
  const bool has_name = !statement_.name.empty();
  if (has_name && statement_.kind != Statement::Kind::Property) {
    fail(statement_.name, "only a property can have a name");
  }
  if (failed_) return std::nullopt;
  return std::move(statement_);
}

/// `NAME:` in front.
void LineParser::take_name(Slice& rest) {
  std::size_t end = 0;
  const auto in_name = [](char c) { return is_word_part(c) || c == '-'; };
  while (end < rest.text.size() && in_name(rest.text[end])) ++end;
  std::size_t colon = end;
  while (colon < rest.text.size() && is_space(rest.text[colon])) ++colon;
  if (end == 0 || colon == rest.text.size() || rest.text[colon] != ':') return;
  statement_.name = rest.part(0, end);
  rest = rest.part(colon + 1);
}

/// The statements that start with an expression.
void LineParser::read_unnamed(const Slice& rest) {
  if (rest.empty()) return fail(statement_.line, "a property line is empty");
  const std::size_t implies = find_word(rest.text, "implies");
  if (implies != kNowhere) return read_for(rest, implies);
  const std::size_t only = find_word(rest.text, "only");
  if (only == kNowhere) return unknown(rest);
  const Slice tail = rest.part(only + 4);
  if (!tail.text.starts_with("after") ||
      (tail.text.size() > 5 && is_word_part(tail.text[5]))) {
    return fail(tail, "`only` is followed by `after`");
  }
  statement_.property.form = Property::Form::OnlyAfter;
  formula(rest.part(0, only));
  formula(tail.part(5));
}

void LineParser::unknown(const Slice& rest) {
  std::vector<std::string_view> words;
  words.reserve(kKeywords.size());
  for (const Keyword& row : kKeywords) words.push_back(row.word);
  const Slice& at = word_.empty() ? rest : word_;
  fail(at, "`" + std::string(at.text) + "` starts no property line" +
               did_you_mean(at.text, words));
}

void LineParser::read_interlock(const Slice& rest) {
  statement_.property.form = Property::Form::Interlock;
  const std::size_t gap = find_last_word(rest.text, "gap");
  if (gap != kNowhere) time(rest.part(gap + 3), false);
  for (const Slice& signal : split(rest.part(0, gap), ',')) formula(signal);
  if (statement_.formulas.size() < 2) {
    fail(rest, "an interlock is between two expressions or more: `A, B`");
  }
}

void LineParser::read_latch(const Slice& rest) {
  statement_.property.form = Property::Form::Latch;
  const std::size_t set = find_word(rest.text, "set");
  if (set == kNowhere)
    return fail(after(rest),
                "`set` is missing: " + std::string("`latch Q set S reset R`"));
  const Slice tail = rest.part(set + 3);
  const std::size_t reset = find_word(tail.text, "reset");
  if (reset == kNowhere) {
    return fail(after(rest), "`reset` is missing: `latch Q set S reset R`");
  }
  Slice last = tail.part(reset + 5);
  const std::size_t dominant = find_last_word(last.text, "dominant");
  if (dominant != kNowhere) {
    const Slice which = last.part(dominant + 8);
    if (which.text != "set" && which.text != "reset") {
      return fail(which, "`dominant` is followed by `set` or `reset`");
    }
    statement_.property.dominant_set = which.text == "set";
    last = last.part(0, dominant);
  }
  formula(rest.part(0, set));
  formula(tail.part(0, reset));
  formula(last);
}

void LineParser::read_after(const Slice& rest) {
  statement_.property.form = Property::Form::After;
  std::size_t limit = find_last_word(rest.text, "within");
  std::size_t word = 6;
  if (limit == kNowhere) {
    limit = find_last_word(rest.text, "for");
    word = 3;
    statement_.property.absent = true;
  }
  if (limit == kNowhere) {
    return fail(after(rest), "`within` is missing: `after P, Q within 500 ms`");
  }
  time(rest.part(limit + word), true);
  std::vector<Slice> parts = split(rest.part(0, limit), ',');
  if (parts.size() != 2) {
    return fail(rest,
                "`after` has two expressions: `after P, Q within 3 scans`");
  }
  if (statement_.property.absent && !take_no(parts[1])) return;
  for (const Slice& part : parts) formula(part);
}

/// `no Q`, of which Q is left.
bool LineParser::take_no(Slice& part) {
  const bool is_no = part.text.starts_with("no") && part.text.size() > 2 &&
                     !is_word_part(part.text[2]);
  if (!is_no) {
    fail(part, "`no` is missing: `after P, no Q for 500 ms`");
    return false;
  }
  part = part.part(2);
  return true;
}

/// P for 500 ms implies Q
void LineParser::read_for(const Slice& rest, std::size_t implies) {
  statement_.property.form = Property::Form::For;
  const Slice left = rest.part(0, implies);
  const std::size_t held = find_last_word(left.text, "for");
  if (held == kNowhere) {
    return fail(after(left), "`for` is missing: `P for 500 ms implies Q`");
  }
  time(left.part(held + 3), false);
  formula(left.part(0, held));
  formula(rest.part(implies + 7));
}

/// settles within 3 scans
void LineParser::read_settles(const Slice& rest) {
  Property& property = statement_.property;
  property.form = Property::Form::Settles;
  const bool within = rest.text.starts_with("within") &&
                      (rest.text.size() == 6 || !is_word_part(rest.text[6]));
  if (!within) {
    return fail(rest.empty() ? after(statement_.line) : rest,
                "`settles` is followed by a number of scans: `settles within "
                "3 scans`");
  }
  const Slice limit = rest.part(6);
  time(limit, true);
  if (failed_) return;
  if (property.scans < 0) {
    fail("RP065", limit, "time stands still here: scans are counted, not ms");
  } else if (property.scans == 0) {
    fail("RP065", limit,
         "inputs change at once, outputs in a scan: 1 scan is the least");
  }
}

/// eventually P given fair F, G
void LineParser::read_eventually(const Slice& rest) {
  statement_.property.form = Property::Form::Eventually;
  const std::size_t given = find_last_word(rest.text, "given");
  formula(rest.part(0, given));
  if (given == kNowhere) return;
  const Slice tail = rest.part(given + 5);
  const bool fair = tail.text.starts_with("fair") &&
                    (tail.text.size() == 4 || !is_word_part(tail.text[4]));
  if (!fair) {
    return fail(tail.empty() ? after(rest) : tail,
                "`given` is followed by `fair`: `eventually P given fair F`");
  }
  for (const Slice& part : split(tail.part(4), ',')) formula(part);
}

void LineParser::read_pattern(const Slice& rest) {
  std::size_t end = rest.text.find('(');
  if (end == kNowhere || rest.text.back() != ')') {
    return fail(rest, "a pattern is written `pattern-invariant(A)`");
  }
  const Slice id = rest.part(0, end);
  const auto* const pattern = std::find_if(
      kPropertyPatterns.begin(), kPropertyPatterns.end(),
      [&](const PropertyPattern& row) { return row.id == id.text; });
  if (pattern == kPropertyPatterns.end()) {
    std::vector<std::string_view> ids;
    ids.reserve(kPropertyPatterns.size());
    for (const PropertyPattern& row : kPropertyPatterns) ids.push_back(row.id);
    return fail(id, "`" + std::string(id.text) + "` is no pattern" +
                        did_you_mean(id.text, ids));
  }
  const Slice inside = rest.part(end + 1, rest.text.size() - 1);
  const std::vector<Slice> arguments = split(inside, ';');
  if (arguments.size() != pattern->arity) {
    return fail(inside, "`" + std::string(id.text) + "` has " +
                            std::to_string(pattern->arity) +
                            " parameters, separated by `;`");
  }
  statement_.property.form = pattern->form;
  statement_.templates.emplace_back(pattern->first);
  if (!pattern->second.empty()) {
    statement_.templates.emplace_back(pattern->second);
  }
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const bool is_time = pattern->form == Property::Form::For && i == 1;
    if (is_time) {
      time(arguments[i], false);
      statement_.formulas.push_back({});  // keeps the others' numbers
    } else {
      formula(arguments[i]);
    }
  }
}

void LineParser::read_assume(const Slice& rest) {
  statement_.kind = Statement::Kind::Assume;
  formula(rest);
}

void LineParser::read_input(const Slice& rest) {
  statement_.kind = Statement::Kind::Input;
  const std::size_t in = find_word(rest.text, "in");
  statement_.subject = rest.part(0, in);
  if (statement_.subject.empty()) fail(rest, "a name is missing here");
  if (in == kNowhere) return take_wiring();
  statement_.has_range = range(rest.part(in + 2), {});
}

/// Takes the words behind the name off the subject: `NAME nc trip`.
void LineParser::take_wiring() {
  Slice& name = statement_.subject;
  Wiring& wiring = statement_.wiring;
  for (;;) {
    std::size_t begin = name.text.size();
    while (begin > 0 && !is_space(name.text[begin - 1])) --begin;
    const std::string_view word = name.text.substr(begin);
    bool* const flag = word == "nc"      ? &wiring.normally_closed
                       : word == "trip"  ? &wiring.trip
                       : word == "reset" ? &wiring.reset
                                         : nullptr;
    if (flag == nullptr || begin == 0) break;
    *flag = true;
    name = name.part(0, begin);
  }
  if (wiring.trip && wiring.reset) {
    fail(statement_.line, "an input is a `trip` or a `reset`, not both");
  }
}

void LineParser::read_output(const Slice& rest) {
  statement_.kind = Statement::Kind::Output;
  statement_.subject = rest;
  if (rest.empty()) fail(rest, "a name is missing here");
}

void LineParser::read_scan(const Slice& rest) {
  statement_.kind = Statement::Kind::Scan;
  if (!range(rest, "ms")) return;
  if (statement_.low < 1 || statement_.high > kMaxTime) {
    fail("RP065", rest, "a scan takes 1 ms or more, and less than a year");
  }
}

void LineParser::read_expect(const Slice& rest) {
  statement_.kind = Statement::Kind::Expect;
  std::size_t end = 0;
  while (end < rest.text.size() && !is_space(rest.text[end])) ++end;
  statement_.subject = rest.part(0, end);
  statement_.verdict = rest.part(end);
  constexpr std::array<std::string_view, 5> kVerdicts = {
      "proved", "violated", "bounded", "vacuous", "unknown"};
  const std::string_view verdict = statement_.verdict.text;
  if (std::find(kVerdicts.begin(), kVerdicts.end(), verdict) ==
      kVerdicts.end()) {
    fail(statement_.verdict,
         "`expect NAME VERDICT`: a verdict is `proved`, `violated`, "
         "`bounded`, `vacuous` or `unknown`");
  }
}

std::optional<std::int64_t> LineParser::whole(const Slice& text) {
  const bool negative = text.text.starts_with('-');
  std::int64_t value = 0;
  const std::size_t first = negative ? 1 : 0;
  bool good = text.text.size() > first && text.text.size() < first + 12;
  for (std::size_t i = first; good && i < text.text.size(); ++i) {
    good = is_digit(text.text[i]);
    value = value * 10 + (text.text[i] - '0');
  }
  if (good) return negative ? -value : value;
  fail("RP065", text, "a whole number is expected here");
  return std::nullopt;
}

/// `LO..HI` or one number, then `unit`.
bool LineParser::range(const Slice& text, std::string_view unit) {
  Slice numbers = text;
  if (!unit.empty()) {
    if (!text.text.ends_with(unit)) {
      fail("RP065", text, "the unit `" + std::string(unit) + "` is missing");
      return false;
    }
    numbers = text.part(0, text.text.size() - unit.size());
  }
  const std::size_t dots = numbers.text.find("..");
  const auto low = whole(numbers.part(0, dots));
  const auto high = dots == kNowhere ? low : whole(numbers.part(dots + 2));
  if (!low || !high) return false;
  statement_.low = *low;
  statement_.high = *high;
  if (*low <= *high) return true;
  fail("RP065", numbers,
       "the range is empty: " + std::to_string(*low) + " is above " +
           std::to_string(*high));
  return false;
}

/// `500 ms`, `1.5 s`, `3 scans`; of patterns also a number of ms.
void LineParser::time(const Slice& text, bool scans_allowed) {
  std::size_t end = 0;
  while (end < text.text.size() &&
         (is_digit(text.text[end]) || text.text[end] == '.')) {
    ++end;
  }
  const Slice digits = text.part(0, end);
  const Slice unit = text.part(end);
  const bool in_pattern = !statement_.templates.empty();
  const std::string_view unit_text =
      unit.empty() && in_pattern ? std::string_view("ms") : unit.text;
  const auto* const row =
      std::find_if(kUnits.begin(), kUnits.end(),
                   [&](const Unit& known) { return known.word == unit_text; });
  if (digits.empty() || row == kUnits.end()) {
    return fail("RP065", text.empty() ? after(statement_.line) : text,
                scans_allowed ? "a time such as `500 ms`, `1.5 s` or `3 scans` "
                                "is expected here"
                              : "a time such as `500 ms` or `1.5 s` is "
                                "expected here");
  }
  const bool scans = row->milliseconds == 0;
  if (scans && !scans_allowed) {
    return fail("RP065", text, "a time in ms or s is expected here, not scans");
  }
  const std::size_t dot = std::min(digits.text.find('.'), digits.text.size());
  const Slice fraction = digits.part(dot);
  std::int64_t value = whole(digits.part(0, dot)).value_or(0);
  value *= scans ? 1 : row->milliseconds;
  std::int64_t step = row->milliseconds;
  for (const char c : fraction.text.substr(fraction.empty() ? 0 : 1)) {
    if (c == '.' || step == 0 || step % 10 != 0) {
      return fail("RP065", text, "a time is a whole number of ms or scans");
    }
    step /= 10;
    value += step * (c - '0');
  }
  if (value > (scans ? kMaxScans : kMaxTime)) {
    return fail("RP065", text,
                scans ? "more than 1000000 scans" : "more than a year");
  }
  (scans ? statement_.property.scans : statement_.property.milliseconds) =
      value;
}

}  // namespace

std::optional<Statement> parse_statement(const Slice& line,
                                         DiagnosticSink& sink) {
  return LineParser(line, sink).parse();
}

}  // namespace rung
