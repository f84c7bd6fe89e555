#include "boards/tape.h"

#include <algorithm>
#include <limits>

#include "backend/postfix/listing.h"
#include "backend/postfix/lower.h"
#include "base/postfix_format.h"

namespace rung::boards {
namespace {

void append_word(std::string& bytes, std::uint64_t value) {
  postfix::append_number(bytes, value, 4);
}

void append_size(std::string& bytes, std::size_t size) {
  append_word(bytes, std::min<std::size_t>(
                         size, std::numeric_limits<std::uint32_t>::max()));
}

/// The inputs of a job in the machine's order: where each stands in a step.
class InputWriter {
 public:
  InputWriter(const Program& program, const Job& job, const Stimulus& stimulus)
      : bit_count_(0) {
    for (std::size_t number = 0; number < job.cells.size(); ++number) {
      const Cell& cell = program.cells[job.cells[number]];
      if (cell.role != CellRole::Input) continue;
      if (number < job.bit_count) ++bit_count_;
      const auto found = std::find(stimulus.inputs.begin(),
                                   stimulus.inputs.end(), job.cells[number]);
      places_.push_back(
          {static_cast<std::size_t>(found - stimulus.inputs.begin()),
           cell.initial});
    }
  }

  void append(const StimulusStep& step, std::string& bytes) const {
    for (std::size_t at = 0; at < bit_count_; at += 8) {
      unsigned byte = 0;
      for (std::size_t i = at; i < std::min(at + 8, bit_count_); ++i) {
        if (value(step, i) != 0) byte |= 1U << (i - at);
      }
      bytes += static_cast<char>(static_cast<unsigned char>(byte));
    }
    for (std::size_t i = bit_count_; i < places_.size(); ++i) {
      append_word(bytes, static_cast<std::uint64_t>(value(step, i)));
    }
  }

 private:
  struct Place {
    std::size_t in_step = 0;
    std::int64_t otherwise = 0;
  };
  std::int64_t value(const StimulusStep& step, std::size_t input) const {
    const Place& place = places_[input];
    return place.in_step < step.inputs.size() ? step.inputs[place.in_step]
                                              : place.otherwise;
  }

  std::size_t bit_count_;
  std::vector<Place> places_;
};

/// The digits of a report, one after the other.
class ReportReader {
 public:
  explicit ReportReader(std::string_view printed) : text_(printed) {
    at_ = std::min(text_.find('{'), text_.size());
  }

  /// The next character that the firmware sent; '\0' at the end.
  char next() {
    while (at_ < text_.size()) {
      const char c = text_[at_++];
      if (c == '\n' || c == '\r' || c == '.') continue;
      if (c != '\x1b') return c;
      // A colour of simavr's: ESC [ ... m.
      at_ = std::min(text_.find('m', at_), text_.size() - 1) + 1;
    }
    return '\0';
  }

  std::uint32_t number(int digits) {
    std::uint32_t value = 0;
    for (int i = 0; i < digits; ++i) {
      const char c = next();
      const bool decimal = c >= '0' && c <= '9';
      if (!decimal && (c < 'a' || c > 'f')) well_formed_ = false;
      const int digit = decimal ? c - '0' : c - 'a' + 10;
      value = value * 16 + (static_cast<std::uint32_t>(digit) & 15U);
    }
    return value;
  }

  bool well_formed() const { return well_formed_; }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
  bool well_formed_ = true;
};

std::vector<std::int64_t> read_cells(const Job& job, ReportReader& reader) {
  std::vector<std::int64_t> values(job.cells.size());
  for (std::size_t at = 0; at < job.bit_count; at += 4) {
    const std::uint32_t digit = reader.number(1);
    for (std::size_t i = at; i < std::min(at + 4, job.bit_count); ++i) {
      values[job.cells[i].index()] = (digit >> (i - at)) & 1U;
    }
  }
  for (std::size_t i = job.bit_count; i < job.cells.size(); ++i) {
    values[job.cells[i].index()] = static_cast<std::int32_t>(reader.number(8));
  }
  return values;
}

/// False at what is no report of `job`. `kind` is the character before it, and
/// then the one behind.
bool read_execution(const Job& job, ReportReader& reader, char& kind,
                    Execution& execution) {
  if (kind != 'p') return false;
  execution.refusal = reader.number(2);
  execution.refused_at = reader.number(8);
  kind = reader.next();
  while (reader.well_formed() && kind == 's' &&
         execution.values.size() < job.step_count) {
    execution.values.push_back(read_cells(job, reader));
    kind = reader.next();
  }
  if (kind == 'f' && execution.values.size() < job.step_count) {
    execution.fault = reader.number(2);
    execution.fault_scan = std::uint64_t{reader.number(8)} + 1;
    execution.values.push_back(read_cells(job, reader));
    kind = reader.next();
    return reader.well_formed() && execution.fault != 0;
  }
  const std::size_t expected = execution.refusal == 0 ? job.step_count : 0;
  return reader.well_formed() && execution.values.size() == expected;
}

}  // namespace

std::optional<Job> make_job(const Program& program, const Stimulus& stimulus,
                            DiagnosticSink& sink) {
  const std::optional<postfix::Listing> listing =
      postfix::make_listing(program, sink);
  if (!listing) return std::nullopt;
  DiagnosticList again;  // of the same remarks
  const auto binary = lower_to_postfix_binary(program, again);
  if (!binary) {
    for (const Diagnostic& diagnostic : again.items()) sink.report(diagnostic);
    return std::nullopt;
  }
  Job job;
  job.program = *binary;
  job.cells = listing->cells;
  job.bit_count = listing->bit_count;
  const InputWriter inputs(program, job, stimulus);
  for (const StimulusStep& step : stimulus.steps) {
    append_word(job.steps, step.repeat);
    append_word(job.steps, static_cast<std::uint64_t>(step.dt_ms));
    inputs.append(step, job.steps);
    ++job.step_count;
  }
  return job;
}

std::string write_tape(std::span<const Job> jobs) {
  std::string tape;
  for (const Job& job : jobs) {
    append_size(tape, job.program.size());
    append_size(tape, job.steps.size());
    append_word(tape, job.step_count);
    tape += job.program;
    tape += job.steps;
  }
  append_word(tape, 0);
  return tape;
}

Playback read_report(std::string_view printed, std::span<const Job> jobs) {
  Playback playback;
  ReportReader reader(printed);
  if (reader.next() != '{') {
    playback.error = "it prints no report";
    return playback;
  }
  char kind = reader.next();
  for (const Job& job : jobs) {
    Execution& execution = playback.executions.emplace_back();
    if (read_execution(job, reader, kind, execution)) continue;
    playback.error = "its report ends or is damaged in program " +
                     std::to_string(playback.executions.size()) +
                     ", behind step " + std::to_string(execution.values.size());
    return playback;
  }
  if (kind != '}') playback.error = "its report goes on behind the end";
  return playback;
}

}  // namespace rung::boards
