#include "frontend/postfix/code_reader.h"

#include <algorithm>
#include <utility>

#include "base/source.h"

namespace rung::postfix {
namespace {

// Walks the code once, in address order. Where the machine has a stack of bits
// and one of words, one stack holds both here, in the order of the text.
class CodeReader {
 public:
  CodeReader(const Binary& binary, std::string text)
      : binary_(binary), text_(std::move(text)), at_(binary.code_begin) {}

  Disassembly run() {
    while (!ended_ && refusal_.refusal.empty()) {
      if (text_.size() > kMaxFileBytes) {
        refuse(0, "its text would be longer than 1 GiB");
      } else if (land()) {
        step();
      }
    }
    if (ended_ &&
        (most_bits_ != binary_.bit_stack || most_words_ != binary_.word_stack ||
         most_open_ != binary_.branches)) {
      at_ = begin_ = BitStackField;
      refuse(23, "the header claims another stack or skip depth");
    }
    refusal_.text = std::move(text_);
    return std::move(refusal_);
  }

 private:
  struct Operand {
    bool word = false;
    std::uint32_t calls_before = 0;
  };
  struct Skip {
    std::size_t target = 0;
    std::size_t depth = 0;  // operands below the left one
    std::uint32_t calls_before = 0;
    bool is_or = false;
  };

  bool refuse(std::uint8_t code, std::string reason) {
    if (!refusal_.refusal.empty()) return false;
    refusal_.code = code;
    refusal_.at = static_cast<std::uint32_t>(begin_);
    refusal_.refusal = std::move(reason);
    return false;
  }

  bool has(std::size_t bytes) {
    if (binary_.code_end - at_ >= bytes) return true;
    return refuse(13, "the code stops inside an instruction");
  }

  std::uint32_t take_number(int size) {
    const std::uint32_t number = read_number(binary_.bytes, at_, size);
    at_ += static_cast<std::size_t>(size);
    return number;
  }

  std::int64_t take_signed(int size) {
    const std::int64_t number = read_signed(binary_.bytes, at_, size);
    at_ += static_cast<std::size_t>(size);
    return number;
  }

  void token(std::string_view word) {
    text_ += word;
    text_ += ' ';
  }

  // Skips that end here become the `&&` or `||` that they compute.
  bool land() {
    begin_ = at_;
    while (!skips_.empty() && skips_.back().target <= at_) {
      const Skip skip = skips_.back();
      if (skip.target != at_) {
        return refuse(20, "a skip goes into an instruction");
      }
      if (operands_.size() != skip.depth + 1 || operands_.back().word) {
        return refuse(20, "a skip joins stacks of different depth");
      }
      if (operands_.back().calls_before == calls_) {
        return refuse(0, "a skip passes over no element");
      }
      operands_.back().calls_before = skip.calls_before;
      skips_.pop_back();
      token(skip.is_or ? "||" : "&&");
    }
    return true;
  }

  void step() {
    if (!has(1)) return;
    auto opcode = static_cast<std::uint8_t>(take_number(1));
    const bool wide = opcode == static_cast<std::uint8_t>(Opcode::Wide);
    if (wide) {
      if (!has(1)) return;
      opcode = static_cast<std::uint8_t>(take_number(1));
    }
    if (const ElementCode* element = find_element(opcode)) {
      read_element(*element, wide);
      return;
    }
    switch (static_cast<Opcode>(opcode)) {
      case Opcode::ReadBit:
        return read_cell(false, wide);
      case Opcode::ReadWord:
        return read_cell(true, wide);
      case Opcode::WriteBit:
        return write_cell(false, wide);
      case Opcode::WriteWord:
        return write_cell(true, wide);
      default:
        break;
    }
    if (wide) {
      refuse(12, "a wide prefix stands before no address");
      return;
    }
    read_plain(opcode);
  }

  void read_plain(std::uint8_t opcode) {
    switch (static_cast<Opcode>(opcode)) {
      case Opcode::End:
        return read_end();
      case Opcode::Push8:
        return read_push(1);
      case Opcode::Push16:
        return read_push(2);
      case Opcode::Push32:
        return read_push(4);
      case Opcode::SkipFalse:
        return read_skip(false);
      case Opcode::SkipTrue:
        return read_skip(true);
      default:
        break;
    }
    const Operator* entry = find_operator(opcode);
    if (entry == nullptr) {
      refuse(12, "there is no instruction " + std::to_string(opcode));
      return;
    }
    read_operator(*entry);
  }

  void read_operator(const Operator& entry) {
    if (entry.opcode == Opcode::Divide && constant_ == 0) {
      refuse(22, "a divisor is no constant other than 0");
      return;
    }
    const bool joins =
        entry.opcode == Opcode::And || entry.opcode == Opcode::Or;
    if (joins && binary_.short_circuit && operands_.size() >= 2 &&
        operands_.back().calls_before != calls_) {
      refuse(0, "the right operand holds an element and is not skipped");
      return;
    }
    const bool of_words = entry.words_in != 0;
    if (combine(of_words ? entry.words_in : entry.bits_in, of_words,
                entry.word_out)) {
      token(entry.token);
    }
  }

  // Takes operands of one type off the stack and puts the result there.
  bool combine(std::size_t count, bool of_words, bool word_out) {
    constant_ = 0;
    const std::size_t floor = skips_.empty() ? 0 : skips_.back().depth;
    if (operands_.size() - floor < count) {
      return refuse(18, "an operand is missing");
    }
    const std::size_t first = operands_.size() - count;
    std::uint32_t before = calls_;
    if (count != 0) before = operands_[first].calls_before;
    for (std::size_t i = first; i < operands_.size(); ++i) {
      if (operands_[i].word != of_words) {
        return refuse(0, of_words ? "a word is expected right before"
                                  : "a bit is expected right before");
      }
    }
    (of_words ? words_ : bits_) -= count;
    operands_.resize(first);
    push(word_out, before);
    return true;
  }

  void push(bool word, std::uint32_t calls_before) {
    operands_.push_back({word, calls_before});
    std::size_t& depth = word ? words_ : bits_;
    ++depth;
    most_bits_ = std::max(most_bits_, bits_);
    most_words_ = std::max(most_words_, words_);
  }

  bool take_address(bool wide, std::size_t count, std::uint8_t code,
                    std::uint32_t& address) {
    if (!has(wide ? 2 : 1)) return false;
    address = take_number(wide ? 2 : 1);
    if (wide && address < 0x100) {
      return refuse(14, "a wide address is below 256");
    }
    if (address < count) return true;
    return refuse(code, code == 15 ? "there is no such cell"
                                   : "there is no such element");
  }

  void read_cell(bool word, bool wide) {
    std::uint32_t address = 0;
    const std::size_t count = word ? binary_.word_count : binary_.bit_count;
    if (!take_address(wide, count, 15, address)) return;
    constant_ = 0;
    push(word, calls_);
    append_name(text_, cell(word, address).name);
    text_ += ' ';
  }

  void write_cell(bool word, bool wide) {
    std::uint32_t address = 0;
    const std::size_t count = word ? binary_.word_count : binary_.bit_count;
    if (!take_address(wide, count, 15, address)) return;
    if (!skips_.empty()) {
      refuse(20, "a skip goes beyond its rung");
    } else if (operands_.empty()) {
      refuse(18, "a rung has no value");
    } else if (operands_.size() != 1) {
      refuse(19, "a rung leaves a value behind");
    } else if (operands_[0].word != word) {
      refuse(18, "a rung's value is not of its target's type");
    } else if (cell(word, address).role == 0) {
      refuse(17, "a rung writes an input");
    } else {
      operands_.clear();
      bits_ = words_ = 0;
      calls_ = 0;
      text_ += '=';
      append_name(text_, cell(word, address).name);
      text_ += '\n';
    }
  }

  const BinaryCell& cell(bool word, std::uint32_t address) const {
    return binary_.cells[(word ? binary_.bit_count : 0U) + address];
  }

  void read_element(const ElementCode& element, bool wide) {
    std::uint32_t address = 0;
    if (!take_address(wide, binary_.slot_count, 16, address)) return;
    const BinarySlot& slot = binary_.slots[address];
    const bool preset = element.preset != ElementCode::Preset::None;
    if (preset && !has(4)) return;
    const std::int64_t value = preset ? take_signed(4) : 0;
    if (slot.kind->kind != element.kind) {
      refuse(16, "an element is of another kind than its slot");
      return;
    }
    if (!combine(element.bits_in, false, false)) return;
    ++calls_;
    text_ += element.name;
    text_ += '(' + std::to_string(slot.index);
    if (preset) text_ += ',' + std::to_string(value);
    if (element.preset == ElementCode::Preset::Milliseconds) text_ += "ms";
    text_ += ") ";
  }

  void read_push(int size) {
    if (!has(static_cast<std::size_t>(size))) return;
    const std::int64_t value = take_signed(size);
    const std::int64_t shorter = size == 4 ? 0x8000 : size == 2 ? 0x80 : 0;
    if (value >= -shorter && value < shorter) {
      refuse(14, "a shorter instruction pushes this word");
      return;
    }
    constant_ = value;
    push(true, calls_);
    token(std::to_string(value));
  }

  void read_skip(bool is_or) {
    if (!binary_.short_circuit) {
      refuse(21, "a skip stands in a program of strict evaluation");
      return;
    }
    if (!has(2)) return;
    const std::size_t distance = take_number(2);
    const std::size_t target = at_ + distance;
    const std::size_t floor = skips_.empty() ? 0 : skips_.back().depth;
    if (target >= binary_.code_end ||
        (!skips_.empty() && target > skips_.back().target)) {
      refuse(20, "a skip goes beyond what it stands in");
      return;
    }
    if (operands_.size() == floor || operands_.back().word) {
      refuse(18, "a skip has no bit to decide by");
      return;
    }
    skips_.push_back({.target = target,
                      .depth = operands_.size() - 1,
                      .calls_before = operands_.back().calls_before,
                      .is_or = is_or});
    most_open_ = std::max(most_open_, skips_.size());
    operands_.pop_back();
    --bits_;
    constant_ = 0;
  }

  void read_end() {
    if (!skips_.empty()) {
      refuse(20, "a skip goes beyond its rung");
    } else if (!operands_.empty()) {
      refuse(19, "the last rung has no target");
    } else if (at_ != binary_.code_end) {
      refuse(13, "the code goes on after its end");
    } else {
      ended_ = true;
    }
  }

  const Binary& binary_;
  std::string text_;
  Disassembly refusal_;
  std::size_t at_;
  std::size_t begin_ = 0;  // of the instruction
  std::vector<Operand> operands_;
  std::vector<Skip> skips_;
  std::size_t bits_ = 0;
  std::size_t words_ = 0;
  std::size_t most_bits_ = 0;
  std::size_t most_words_ = 0;
  std::size_t most_open_ = 0;
  std::uint32_t calls_ = 0;
  std::int64_t constant_ = 0;  // what the instruction before pushed, or 0
  bool ended_ = false;
};

}  // namespace

std::int64_t read_signed(std::string_view bytes, std::size_t at, int size) {
  const std::int64_t number = read_number(bytes, at, size);
  const std::int64_t sign = std::int64_t{1} << (8 * size - 1);
  return number >= sign ? number - 2 * sign : number;
}

Disassembly read_code(const Binary& binary, std::string text) {
  return CodeReader(binary, std::move(text)).run();
}

}  // namespace rung::postfix
