#include "analysis/rules/suppress.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <string>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "analysis/rules/rule_run.h"
#include "analysis/rules/support.h"
#include "base/text.h"

namespace rung {
namespace {

constexpr std::string_view kAllow = "allow";

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r";
  const std::size_t begin = text.find_first_not_of(kBlank);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlank) - begin + 1);
}

/// One name of one `allow` line.
struct Permit {
  const Rule* rule = nullptr;
  std::string_view name;  // as written
  std::string_view reason;
  SourceRange where;
  bool below = false;  // it has a line of its own
  bool used = false;
};

/// A line, or an offset, of a file.
std::uint64_t key(const SourceRange& where, std::uint32_t place) {
  return std::uint64_t{where.file.index()} << 32 | place;
}

std::string nothing_called(std::string_view name) {
  std::vector<std::string_view> known;
  for (const Rule* rule : all_rules()) known.push_back(rule->name);
  return "no rule is called " + quoted(name) + did_you_mean(name, known);
}

Diagnostic unused(const Permit& permit, Severity severity) {
  const std::string message =
      permit.rule == nullptr
          ? nothing_called(permit.name)
          : "nothing to allow: no " + quoted(permit.rule->name) +
                " on this line" + (permit.below ? " or in the rung below" : "");
  return {.code = unused_allow.code,
          .severity = severity,
          .where = permit.where,
          .message = message,
          .rule = unused_allow.name};
}

}  // namespace

bool is_allow(std::string_view annotation) {
  if (!annotation.starts_with(kAllow)) return false;
  return annotation.size() == kAllow.size() ||
         annotation[kAllow.size()] == ' ' || annotation[kAllow.size()] == '\t';
}

Allow parse_allow(const AstAnnotation& annotation) {
  Allow allow{{}, {}, annotation.where};
  std::string_view names = annotation.text.substr(kAllow.size());
  const std::size_t colon = names.find(':');
  if (colon != std::string_view::npos) {
    allow.reason = trimmed(names.substr(colon + 1));
    names = names.substr(0, colon);
  }
  while (!names.empty()) {
    const std::size_t comma = names.find(',');
    const std::string_view name = trimmed(names.substr(0, comma));
    if (!name.empty()) allow.rules.push_back(name);
    if (comma == std::string_view::npos) break;
    names.remove_prefix(comma + 1);
  }
  return allow;
}

namespace {

/// Where rungs stand, in the order of the text.
class RungPlaces {
 public:
  explicit RungPlaces(const Program& program) {
    for (const Rung& rung : program.rungs) {
      if (rung.where.has_value()) places_.push_back(rung.where);
    }
    std::sort(places_.begin(), places_.end(),
              [](const SourceRange& a, const SourceRange& b) {
                return order(a) < order(b);
              });
    for (const SourceRange& place : places_) {
      const bool same =
          !ends_.empty() && places_[ends_.size() - 1].file == place.file;
      ends_.push_back(same ? std::max(ends_.back(), place.end) : place.end);
    }
  }

  /// The one that begins last at or before `where`, if it has not ended there.
  const SourceRange* around(const SourceRange& where) const {
    const std::size_t behind = behind_of(where);
    if (behind == 0) return nullptr;
    const SourceRange& last = places_[behind - 1];
    return last.file == where.file && last.end > where.begin ? &last : nullptr;
  }

  /// The first one that begins behind `where`.
  const SourceRange* after(const SourceRange& where) const {
    const std::size_t behind = behind_of(where);
    if (behind == places_.size()) return nullptr;
    return places_[behind].file == where.file ? &places_[behind] : nullptr;
  }

  /// Does one begin before `where`, and end at `line_begin` or further down?
  bool reach(const SourceRange& where, std::uint32_t line_begin) const {
    const std::size_t behind = behind_of(where);
    return behind != 0 && places_[behind - 1].file == where.file &&
           ends_[behind - 1] > line_begin;
  }

 private:
  static std::pair<FileId, std::uint32_t> order(const SourceRange& place) {
    return {place.file, place.begin};
  }

  std::size_t behind_of(const SourceRange& where) const {
    const auto at = std::partition_point(
        places_.begin(), places_.end(),
        [&](const SourceRange& place) { return order(place) <= order(where); });
    return static_cast<std::size_t>(at - places_.begin());
  }

  std::vector<SourceRange> places_;
  std::vector<std::uint32_t> ends_;  // the largest up to each, of its file
};

/// Is it behind something, and not on a line of its own? Comments of drawings
/// and of XML have marks before them that are no rung.
bool is_behind_rung(const SourceFile& file, const SourceRange& where,
                    const RungPlaces& rungs) {
  const std::string_view line = file.line(file.position(where.begin).line);
  const auto line_begin =
      static_cast<std::uint32_t>(line.data() - file.text().data());
  const std::string_view before = line.substr(0, where.begin - line_begin);
  const bool has_text = std::any_of(before.begin(), before.end(), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0;
  });
  return has_text && rungs.reach(where, line_begin);
}

/// What all `allow` lines permit.
class Permits {
 public:
  explicit Permits(const RuleContext& context)
      : context_(context), rungs_(context.program) {
    for (const AstAnnotation& annotation : context.program.annotations) {
      if (!is_allow(annotation.text)) continue;
      const Allow allow = parse_allow(annotation);
      // Without a reason it is a finding of its own.
      if (!allow.reason.empty()) add(allow);
    }
  }

  const std::vector<Permit>& all() const { return all_; }

  /// The first permit for such a finding; null when there is none.
  const Permit* take(const Diagnostic& finding) {
    const std::uint32_t line = line_of(finding.where);
    const Permit* permit = take(by_line_, key(finding.where, line), finding);
    if (permit == nullptr) {
      permit = take(by_line_above_, key(finding.where, line - 1), finding);
    }
    const SourceRange* const rung = rungs_.around(finding.where);
    if (permit == nullptr && rung != nullptr) {
      permit = take(by_rung_, key(*rung, rung->begin), finding);
    }
    return permit;
  }

 private:
  using Places = std::unordered_map<std::uint64_t, std::vector<std::size_t>>;

  std::uint32_t line_of(const SourceRange& where) const {
    return context_.sources[where.file].position(where.begin).line;
  }

  /// A rule that is off may have had something to say: that is not known.
  void add(const Allow& allow) {
    const SourceFile& file = context_.sources[allow.where.file];
    const std::uint64_t line = key(allow.where, line_of(allow.where));
    const bool below = !is_behind_rung(file, allow.where, rungs_);
    const SourceRange* const rung = below ? rungs_.after(allow.where) : nullptr;
    for (const std::string_view name : allow.rules) {
      const Rule* const rule = find_rule(name);
      const bool off = rule != nullptr && !context_.rules.is_on(*rule);
      by_line_[line].push_back(all_.size());
      if (below) by_line_above_[line].push_back(all_.size());
      if (rung != nullptr) {
        by_rung_[key(*rung, rung->begin)].push_back(all_.size());
      }
      all_.push_back({rule, name, allow.reason, allow.where, below, off});
    }
  }

  const Permit* take(const Places& places, std::uint64_t place,
                     const Diagnostic& finding) {
    const auto found = places.find(place);
    if (found == places.end()) return nullptr;
    for (const std::size_t i : found->second) {
      Permit& permit = all_[i];
      if (permit.rule == nullptr || permit.rule->code != finding.code) continue;
      permit.used = true;
      return &permit;
    }
    return nullptr;
  }

  const RuleContext& context_;
  const RungPlaces rungs_;
  std::vector<Permit> all_;
  Places by_line_;
  Places by_line_above_;  // of those that have a line of their own
  Places by_rung_;        // that follows them; by where it begins
};

}  // namespace

std::vector<Diagnostic> suppress(const RuleContext& context,
                                 std::vector<Diagnostic> findings) {
  Permits permits(context);
  if (permits.all().empty()) return findings;
  for (Diagnostic& finding : findings) {
    const Permit* const permit = permits.take(finding);
    if (permit == nullptr) continue;
    finding.waiver = {Waiver::Kind::InSource, std::string(permit->reason)};
  }
  const std::optional<Severity> severity =
      context.rules.severity_of(unused_allow);
  if (!severity) return findings;
  for (const Permit& permit : permits.all()) {
    if (!permit.used) findings.push_back(unused(permit, *severity));
  }
  return findings;
}

}  // namespace rung
