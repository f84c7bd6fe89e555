#include "reports/baseline.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "reports/fingerprint.h"
#include "reports/json_parts.h"
#include "reports/unicode.h"

namespace rung {
namespace {

constexpr std::string_view kSchema = "rungproof.baseline/1";
constexpr std::array<std::string_view, 5> kKeys = {"file", "code", "rule",
                                                   "fingerprint", "message"};

bool by_key(const BaselineEntry& a, const BaselineEntry& b) {
  return a.key() < b.key();
}

std::string& field(BaselineEntry& entry, std::size_t key) {
  std::string* const fields[] = {&entry.file, &entry.code, &entry.rule,
                                 &entry.fingerprint, &entry.message};
  return *fields[key];
}

/// An entry, or why it is none.
std::string read_entry(const Json& json, BaselineEntry& entry) {
  if (!json.is_object()) return "is no object";
  for (std::size_t i = 0; i < kKeys.size(); ++i) {
    const auto found = json.find(kKeys[i]);
    if (found == json.end() || !found->is_string()) {
      return fmt::format("has no text `{}`", kKeys[i]);
    }
    field(entry, i) = found->get<std::string>();
  }
  if (json.size() != kKeys.size()) return "has a key that is unknown";
  if (entry.fingerprint.empty()) return "has an empty `fingerprint`";
  return {};
}

std::string read_entries(const Json& json, std::vector<BaselineEntry>& all) {
  if (!json.is_object()) return "it is no object";
  const auto schema = json.find("schema");
  if (schema == json.end() || *schema != kSchema) {
    return fmt::format("its `schema` is not `{}`", kSchema);
  }
  const auto findings = json.find("findings");
  if (findings == json.end() || !findings->is_array()) {
    return "it has no list `findings`";
  }
  if (json.size() != 2) return "it has a key that is unknown";
  for (const Json& one : *findings) {
    const std::string error = read_entry(one, all.emplace_back());
    if (!error.empty()) {
      return fmt::format("finding {} {}", all.size(), error);
    }
  }
  return {};
}

}  // namespace

const BaselineEntry* Baseline::find(const BaselineEntry& like) const {
  const auto at =
      std::lower_bound(entries.begin(), entries.end(), like, by_key);
  return at != entries.end() && at->key() == like.key() ? &*at : nullptr;
}

Baseline make_baseline(std::vector<BaselineEntry> entries) {
  std::stable_sort(entries.begin(), entries.end(), by_key);
  const auto same = [](const BaselineEntry& a, const BaselineEntry& b) {
    return a.key() == b.key();
  };
  entries.erase(std::unique(entries.begin(), entries.end(), same),
                entries.end());
  return {std::move(entries)};
}

std::string write_baseline(const Baseline& baseline) {
  std::string out = fmt::format("{{\n\"schema\": \"{}\",\n", kSchema);
  out += "\"findings\": [";
  std::string_view separator = "\n";
  for (BaselineEntry entry : baseline.entries) {
    Json json = Json::object();
    for (std::size_t i = 0; i < kKeys.size(); ++i) {
      json[std::string(kKeys[i])] = field(entry, i);
    }
    std::string line = dump_line(json);
    line.pop_back();
    out += separator;
    out += line;
    separator = ",\n";
  }
  return out + "\n]\n}\n";
}

std::variant<Baseline, std::string> read_baseline(std::string_view text) {
  std::vector<BaselineEntry> entries;
  try {
    const Json json = Json::parse(text);
    const std::string error = read_entries(json, entries);
    if (!error.empty()) return error;
  } catch (const Json::exception& error) {
    return std::string(error.what());
  }
  const std::size_t written = entries.size();
  Baseline baseline = make_baseline(std::move(entries));
  if (baseline.entries.size() != written) return "a finding is there twice";
  return baseline;
}

std::vector<Diagnostic> all_findings(const FileReport& file) {
  std::vector<Diagnostic> all = file.findings;
  all.insert(all.end(), file.waived.begin(), file.waived.end());
  sort_diagnostics(all);
  return all;
}

std::vector<BaselineEntry> entries_of(const SourceSet& sources,
                                      const FileReport& file,
                                      const std::string& path) {
  Fingerprints fingerprints;
  std::vector<BaselineEntry> entries;
  for (const Diagnostic& finding : all_findings(file)) {
    BaselineEntry& entry = entries.emplace_back();
    entry.file = valid_utf8(path);
    entry.code = finding.code;
    entry.rule = rule_name(finding);
    entry.message = valid_utf8(finding.message);
    if (is_input_error(finding)) continue;
    std::string_view line;
    if (finding.where.has_value()) {
      const SourceFile& source = sources[finding.where.file];
      line = source.line(source.position(finding.where.begin).line);
    }
    entry.fingerprint = fingerprints.next(finding.code, path, line);
  }
  return entries;
}

void compare_with(const Baseline& baseline, const SourceSet& sources,
                  const std::string& path, FileReport& file,
                  std::vector<BaselineEntry>& met) {
  const std::vector<BaselineEntry> entries = entries_of(sources, file, path);
  std::vector<Diagnostic> all = all_findings(file);
  file.findings.clear();
  file.waived.clear();
  for (std::size_t i = 0; i < all.size(); ++i) {
    const BaselineEntry* const known = baseline.find(entries[i]);
    if (known != nullptr) {
      met.push_back(*known);
      if (!all[i].waiver) {
        all[i].waiver = {Waiver::Kind::Baseline, "it is in the baseline"};
      }
    }
    (all[i].waiver ? file.waived : file.findings).push_back(std::move(all[i]));
  }
  file.compared = true;
}

}  // namespace rung
