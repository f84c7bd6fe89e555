// ListReader: what takes a result, and the zones of master controls.

#include <algorithm>
#include <utility>

#include "frontend/il_mitsubishi/list_reader.h"

namespace rung::melsec {
namespace {

constexpr std::uint32_t kMostLevels = 8;  // N0 to N7

bool is_counted(const Device& device) {
  return device.id.letter == 'T' || device.id.letter == 'C';
}

}  // namespace

/// The result goes on below this output: it must not be read again there, for
/// the output may have changed what it stands on.
bool ListReader::goes_on(std::size_t index) const {
  for (std::size_t i = index + 1; i < operators_.size(); ++i) {
    const Operator* const op = operators_[i];
    if (op == nullptr) return false;
    if (op->code == Code::Nothing) continue;
    if (op->code == Code::Contact) return op->join != Join::Load;
    return op->code != Code::Read && op->code != Code::Pop &&
           op->code != Code::ZoneEnd && op->code != Code::End;
  }
  return false;
}

/// The result becomes a bit, and the expression is that bit's name.
void ListReader::keep_result(SourceRange where) {
  const bool is_bit = stack_.size() - blocks_.back() == 1 &&
                      stack_.back().op == AstOp::Name &&
                      stack_.back().text.find('.') != std::string_view::npos;
  if (is_bit) return;
  const std::string_view bit = writer_.keep("result", kBitCell, value(), where);
  stack_.resize(blocks_.back());
  push_leaf(stack_, AstOp::Name, bit, where);
}

void ListReader::output(std::size_t index, const Operator& op) {
  const Line& line = list_.lines[index];
  const SourceRange where = range(line);
  if (!is_whole(where)) return;
  if (goes_on(index)) keep_result(where);
  Expression power = value();
  if (op.code == Code::OutInverse) push_unary(power, AstOp::Not, where);
  if (!zones_.empty()) {
    push_leaf(power, AstOp::Name, zones_.back().power, where);
    push_binary(power, AstOp::And, where);
  }
  write(line, op, power);
  if (state_ == State::Live) state_ = State::Taken;
}

void ListReader::write(const Line& line, const Operator& op,
                       const Expression& power) {
  if (op.code == Code::Zone) return zone(line, power);
  Device* const device = target(line, 1, false);
  if (device == nullptr) return;
  const bool counted =
      is_counted(*device) && (op.code == Code::Out || op.code == Code::Reset);
  if (!counted && line.count > 2) {
    return fail("RP047", range(line, 2),
                quoted_excerpt(device->name) + " takes no preset");
  }
  if (counted) return write_counted(line, op, *device, power);
  if (is_counted(*device)) {
    return fail("RP049", range(line, 1),
                quoted_excerpt(op.name) +
                    " cannot write a timer or counter: `OUT` and `RST` can");
  }
  write_relay(line, op, *device, power);
}

void ListReader::write_relay(const Line& line, const Operator& op,
                             Device& device, const Expression& power) {
  const SourceRange at = range(line, 1);
  const SourceRange where = range(line);
  Expression value = power;
  if (op.code == Code::Set) {
    push_leaf(value, AstOp::Name, device.name, at);
    push_binary(value, AstOp::Or, where);
  } else if (op.code == Code::Reset) {
    push_unary(value, AstOp::Not, where);
    push_leaf(value, AstOp::Name, device.name, at);
    push_binary(value, AstOp::And, where);
  } else if (op.code == Code::Rise || op.code == Code::Fall) {
    value = writer_.call(op.code == Code::Rise ? "RISE" : "FALL", power,
                         writer_.element("edge", {}, where), {}, where);
  }
  writer_.assign(device.name, false, at, value, where);
}

void ListReader::write_counted(const Line& line, const Operator& op,
                               Device& device, const Expression& power) {
  const bool timer = device.id.letter == 'T';
  const bool retentive = timer && base_of(device.id.number).retentive;
  const std::uint32_t element = devices_.element(device, range(line, 1));
  std::string_view operation;
  std::optional<std::int64_t> parameter;
  if (op.code == Code::Out) {
    parameter = preset(line, device);
    if (!parameter) return;
    operation = timer ? (retentive ? "OUT.TR" : "OUT.T") : "OUT.C";
  } else {
    if (line.count > 2) {
      return fail("RP047", range(line, 2), "`RST` takes no preset");
    }
    operation = timer ? (retentive ? "RST.TR" : "RST.T") : "RST.C";
  }
  writer_.assign(
      device.name, false, range(line, 1),
      writer_.call(operation, power, element, parameter, range(line)),
      range(line));
}

std::optional<std::int64_t> ListReader::preset(const Line& line,
                                               const Device& device) {
  if (line.count < 3) {
    fail("RP045", range(line),
         quoted_excerpt(device.name) + " needs a preset such as `K50`");
    return std::nullopt;
  }
  const auto value = constant_of(text(line, 2));
  if (!value || *value < 0) {
    fail("RP045", range(line, 2),
         "the preset " + quoted_excerpt(text(line, 2)) +
             " is not supported: `K0` to `K32767` are");
    return std::nullopt;
  }
  if (device.id.letter == 'T') {
    return *value * base_of(device.id.number).milliseconds;
  }
  return std::max<std::int64_t>(*value, 1);  // K0 counts as K1
}

/// The device that an output writes; null: an error was said.
Device* ListReader::target(const Line& line, std::size_t word, bool zone) {
  const SourceRange where = range(line, word);
  Device* const device = devices_.find(text(line, word), where);
  if (device == nullptr) {
    give_up();
    return nullptr;
  }
  const bool input = device->id.letter == 'X' || device->special;
  if (input || device->id.letter == 'D') {
    fail("RP044", where,
         quoted_excerpt(device->name) +
             (input ? " is an input or a special relay: no program writes it"
                    : " is a register: no instruction that is supported "
                      "writes it"));
    return nullptr;
  }
  if (device->written.has_value() && (zone || device->zone)) {
    errors_.error("RP047", where,
                  quoted_excerpt(device->name) +
                      " is the relay of an `MC` and is written twice: which "
                      "of the two has the zone is not defined",
                  {{device->written, "it is written here, too"}});
    give_up();
    return nullptr;
  }
  device->written = where;
  device->zone = zone;
  return device;
}

std::optional<std::uint32_t> ListReader::level(const Line& line) {
  const std::string word = upper(text(line, 1));
  if (word.size() == 2 && word[0] == 'N' && word[1] >= '0' &&
      word[1] < static_cast<char>('0' + kMostLevels)) {
    return static_cast<std::uint32_t>(word[1] - '0');
  }
  fail("RP047", range(line, 1),
       quoted_excerpt(text(line, 1)) + " is no level: there are N0 to N7");
  return std::nullopt;
}

void ListReader::zone(const Line& line, const Expression& power) {
  const auto at = level(line);
  if (!at) return;
  if (!zones_.empty() && *at <= zones_.back().level) {
    return fail("RP047", range(line, 1),
                "the levels of zones inside of one another must rise");
  }
  Device* const device = target(line, 2, true);
  if (device == nullptr) return;
  if (device->id.letter != 'M' && device->id.letter != 'Y') {
    return fail("RP049", range(line, 2), "the relay of an `MC` is an M or a Y");
  }
  const std::string_view bit =
      writer_.keep("zone", kBitCell, power, range(line));
  Expression value;
  push_leaf(value, AstOp::Name, bit, range(line, 2));
  writer_.assign(device->name, false, range(line, 2), value, range(line));
  zones_.push_back({*at, bit, range(line)});
  forget();
}

void ListReader::zone_end(const Line& line) {
  const auto at = level(line);
  if (!at) return;
  if (zones_.empty() || zones_.back().level != *at) {
    return fail("RP047", range(line),
                zones_.empty() ? "no `MC` is open here"
                               : "the innermost zone is that of N" +
                                     std::to_string(zones_.back().level));
  }
  if (state_ == State::Live) {
    fail("RP047", result_where_, "no output takes the result of this circuit");
  }
  zones_.pop_back();
  forget();
}

/// At `END` and at the end of the text.
void ListReader::finish() {
  if (state_ == State::Live) {
    errors_.error("RP047", result_where_,
                  "no output takes the result of this circuit");
  } else if (!branches_.empty()) {
    errors_.error("RP047", branch_where_, "this `MPS` has no `MPP`");
  }
  for (const Zone& open : zones_) {
    errors_.error("RP047", open.where, "this `MC` has no `MCR`");
  }
  forget();
  branches_.clear();
  zones_.clear();
}

}  // namespace rung::melsec
