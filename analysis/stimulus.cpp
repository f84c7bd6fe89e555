#include "analysis/stimulus.h"

#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/text.h"

namespace rung {
namespace {

constexpr std::int64_t kMaxDt = 1'000'000'000;
constexpr std::int64_t kMaxRepeat = 1'000'000'000'000;

struct Field {
  std::string_view text;  // without blanks and quotes around it
  SourceRange where;
};

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

Field field_at(FileId file, std::string_view text, std::size_t begin,
               std::size_t end) {
  while (begin < end && is_blank(text[begin])) ++begin;
  while (end > begin && is_blank(text[end - 1])) --end;
  const bool quoted =
      end - begin >= 2 && text[begin] == '"' && text[end - 1] == '"';
  if (quoted) {
    ++begin;
    --end;
  }
  return {text.substr(begin, end - begin),
          {file, static_cast<std::uint32_t>(begin),
           static_cast<std::uint32_t>(end)}};
}

/// For messages: what cannot be shown is shortened, as it may be any bytes.
std::string shown(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  std::string result = "`";
  for (const char c : text.substr(0, kLongest)) {
    const auto byte = static_cast<unsigned char>(c);
    result += byte < 0x20 || byte >= 0x7f ? '?' : c;
  }
  return result + (text.size() > kLongest ? "...`" : "`");
}

class StimulusReader {
 public:
  StimulusReader(const Program& program, std::string_view text, FileId file,
                 std::int64_t default_dt_ms, DiagnosticSink& sink)
      : program_(program), text_(text), file_(file), sink_(sink) {
    previous_.dt_ms = default_dt_ms;
  }

  Stimulus read() {
    std::size_t begin = text_.starts_with("\xEF\xBB\xBF") ? 3 : 0;
    bool has_header = false;
    while (begin < text_.size()) {
      std::size_t end = text_.find('\n', begin);
      if (end == std::string_view::npos) end = text_.size();
      const std::vector<Field> fields = split(begin, end);
      begin = end + 1;
      const bool skipped = fields.front().text.starts_with('#') ||
                           (fields.size() == 1 && fields.front().text.empty());
      if (skipped) continue;
      if (has_header) {
        row(fields);
      } else {
        header(fields);
        has_header = true;
      }
    }
    if (!has_header) {
      fail("RP090", {file_, 0, 0},
           "the stimulus is empty: its first line names the columns");
    }
    return std::move(stimulus_);
  }

 private:
  enum class Role : std::uint8_t { Input, Dt, Repeat, Wrong };
  struct Column {
    Role role = Role::Wrong;
    std::size_t input = 0;
    std::string_view name;
  };

  void fail(std::string_view code, const SourceRange& where,
            std::string message) {
    sink_.report({.code = code,
                  .severity = Severity::Error,
                  .where = where,
                  .message = std::move(message)});
  }

  std::vector<Field> split(std::size_t begin, std::size_t end) const {
    std::vector<Field> fields;
    for (std::size_t i = begin; i <= end; ++i) {
      if (i < end && text_[i] != ',') continue;
      fields.push_back(field_at(file_, text_, begin, i));
      begin = i + 1;
    }
    return fields;
  }

  void header(const std::vector<Field>& fields) {
    std::unordered_map<std::string_view, CellId> inputs;
    for (const CellId id : ids_of(program_.cells)) {
      const Cell& cell = program_.cells[id];
      if (cell.role == CellRole::Input) inputs.emplace(cell.name, id);
    }
    std::unordered_map<std::string_view, SourceRange> seen;
    for (const Field& field : fields) {
      Column column;
      column.name = field.text;
      const auto input = inputs.find(field.text);
      const auto [first, is_new] = seen.emplace(field.text, field.where);
      if (!is_new) {
        fail("RP091", field.where, "a second column " + shown(field.text));
      } else if (input != inputs.end()) {
        column.role = Role::Input;
        column.input = stimulus_.inputs.size();
        stimulus_.inputs.push_back(input->second);
        previous_.inputs.push_back(program_.cells[input->second].initial);
      } else if (field.text == "dt") {
        column.role = Role::Dt;
      } else if (field.text == "repeat") {
        column.role = Role::Repeat;
      } else {
        fail("RP091", field.where, unknown_column(field.text));
      }
      columns_.push_back(column);
    }
  }

  std::string unknown_column(std::string_view name) const {
    std::vector<std::string_view> candidates = {"dt", "repeat"};
    for (const Cell& cell : program_.cells) {
      if (cell.role == CellRole::Input) {
        candidates.push_back(cell.name);
      } else if (cell.name == name) {
        return shown(name) + " is no input: the program writes it";
      }
    }
    return "the program has no input " + shown(name) +
           did_you_mean(name, candidates);
  }

  void row(const std::vector<Field>& fields) {
    if (fields.size() != columns_.size()) {
      fail("RP090", cover(fields.front().where, fields.back().where),
           "this row has " + std::to_string(fields.size()) + " cells, and " +
               std::to_string(columns_.size()) + " columns are named");
      return;
    }
    previous_.repeat = 1;
    for (std::size_t i = 0; i < fields.size(); ++i) {
      if (!fields[i].text.empty()) set(columns_[i], fields[i]);
    }
    stimulus_.steps.push_back(previous_);
  }

  void set(const Column& column, const Field& field) {
    switch (column.role) {
      case Role::Dt:
        if (const auto dt = number(column, field, 1, kMaxDt)) {
          previous_.dt_ms = *dt;
        }
        break;
      case Role::Repeat:
        if (const auto repeat = number(column, field, 1, kMaxRepeat)) {
          previous_.repeat = static_cast<std::uint64_t>(*repeat);
        }
        break;
      case Role::Input: {
        const Cell& cell = program_.cells[stimulus_.inputs[column.input]];
        if (const auto value = number(column, field, cell.low, cell.high)) {
          previous_.inputs[column.input] = *value;
        }
        break;
      }
      case Role::Wrong:
        break;  // reported with the header
    }
  }

  std::optional<std::int64_t> number(const Column& column, const Field& field,
                                     std::int64_t low, std::int64_t high) {
    std::int64_t value = 0;
    const char* const end = field.text.data() + field.text.size();
    const auto result = std::from_chars(field.text.data(), end, value);
    const bool is_bit = low == 0 && high == 1;
    if (is_bit && field.text == "true") return 1;
    if (is_bit && field.text == "false") return 0;
    if (result.ec == std::errc::invalid_argument || result.ptr != end) {
      fail("RP092", field.where,
           shown(field.text) + " is no whole number, which `" +
               std::string(column.name) + "` needs");
      return std::nullopt;
    }
    if (result.ec != std::errc() || value < low || value > high) {
      fail("RP092", field.where,
           shown(field.text) + " is outside of " + std::to_string(low) + ".." +
               std::to_string(high) + ", the range of `" +
               std::string(column.name) + "`");
      return std::nullopt;
    }
    return value;
  }

  const Program& program_;
  std::string_view text_;
  FileId file_;
  DiagnosticSink& sink_;
  std::vector<Column> columns_;
  StimulusStep previous_;
  Stimulus stimulus_;
};

}  // namespace

Stimulus read_stimulus(const Program& program, const SourceSet& sources,
                       FileId file, std::int64_t default_dt_ms,
                       DiagnosticSink& sink) {
  return StimulusReader(program, sources[file].text(), file, default_dt_ms,
                        sink)
      .read();
}

}  // namespace rung
