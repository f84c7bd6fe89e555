#include "frontend/rockwell/tags.h"

#include <algorithm>
#include <array>

#include "base/text.h"
#include "frontend/token_list.h"

namespace rung::rockwell {
namespace {

using Kind = Place::Kind;
using Role = AstDeclaration::Kind;

std::string_view name_of(Kind kind) {
  switch (kind) {
    case Kind::Bit:
      return "a BOOL";
    case Kind::Word:
      return "an integer";
    case Kind::Timer:
      return "a TIMER";
    case Kind::Counter:
      return "a COUNTER";
    case Kind::None:
      break;
  }
  return "something else";
}

std::uint32_t bits_of_type(std::string_view type) {
  if (type == "SINT") return 8;
  if (type == "INT") return 16;
  return type == "DINT" ? 32 : 0;
}

bool is_digits(std::string_view text) {
  return !text.empty() && text.size() < 6 &&
         text.find_first_not_of("0123456789") == text.npos &&
         (text.size() == 1 || text.front() != '0');
}

/// Members of the two structures that instructions work on.
Kind block_member(std::string_view type, std::string_view name) {
  const bool counter = type == "COUNTER";
  constexpr std::array<std::string_view, 3> kTimer = {"DN", "EN", "TT"};
  constexpr std::array<std::string_view, 3> kCounter = {"DN", "CU", "CD"};
  const bool bit =
      counter
          ? std::find(kCounter.begin(), kCounter.end(), name) != kCounter.end()
          : std::find(kTimer.begin(), kTimer.end(), name) != kTimer.end();
  if (bit) return Kind::Bit;
  return counter && name == "ACC" ? Kind::Word : Kind::None;
}

CellShape shape_of(std::uint32_t bits) {
  const std::int64_t top = std::int64_t{1} << (bits - 1);
  return {true, -top, top - 1};
}

}  // namespace

Place Tags::fail(const Operand& operand, std::string_view code,
                 const std::string& why) const {
  errors_.error(code, operand.where, quoted_excerpt(operand.text) + " " + why);
  return {};
}

// --- what a name means -------------------------------------------------------

Place Tags::resolve(const Operand& operand, Kind wanted) const {
  if (operand.text.empty()) {
    errors_.error("RP054", operand.where, "an operand is missing here");
    return {};
  }
  Place place =
      declared_ ? declared_place(operand) : undeclared_place(operand, wanted);
  if (place.kind == Kind::None || place.kind == wanted) return place;
  return fail(operand, "RP054",
              "is " + std::string(name_of(place.kind)) + ": " +
                  std::string(name_of(wanted)) + " is expected");
}

Place Tags::declared_place(const Operand& operand) const {
  const std::string_view text = operand.text;
  std::size_t at = std::min(text.find_first_of(".["), text.size());
  const auto tag = project_.tags.find(text.substr(0, at));
  if (tag == project_.tags.end()) {
    std::vector<std::string_view> known;
    if (!errors_.is_full()) {
      for (const auto& [name, it] : project_.tags) known.push_back(name);
    }
    return fail(operand, "RP052",
                "is no tag" + did_you_mean(text.substr(0, at), known));
  }
  if (!tag->second.alias.empty()) {
    return fail(operand, "RP087", "is an alias: that is not supported");
  }
  Place place;
  place.name = text;
  place.tag = &tag->second;
  place.path = text.substr(at);
  std::string_view type = tag->second.type;
  while (at < text.size()) {
    if (!step(operand, at, type, place)) return {};
  }
  return of_type(operand, type, place);
}

// `.member`, `.3`, `[2]`
bool Tags::step(const Operand& operand, std::size_t& at, std::string_view& type,
                Place& place) const {
  const std::string_view text = operand.text;
  if (text[at] == '[') {
    const std::size_t end = std::min(text.find(']', at), text.size() - 1);
    const std::string_view index = text.substr(at + 1, end - at - 1);
    const auto size = number_of(place.tag->dimensions);
    // Only a tag itself has elements: arrays in structures are not leaves.
    const bool first = text.substr(at).size() == place.path.size();
    if (!first || !is_digits(index) || !size ||
        number_of(index).value_or(0) >= *size) {
      fail(operand, "RP087",
           "is not supported: an element of an array is a constant index in "
           "the range of a tag");
      return false;
    }
    at = end + 1;
    return true;
  }
  if (text[at] != '.' || at + 1 == text.size()) {
    fail(operand, "RP051", "is no name of a tag");
    return false;
  }
  const std::size_t begin = at;
  at = std::min(text.find_first_of(".[", begin + 1), text.size());
  const std::string_view name = text.substr(begin + 1, at - begin - 1);
  return member_step(operand, name, begin, type, place);
}

bool Tags::member_step(const Operand& operand, std::string_view name,
                       std::size_t begin, std::string_view& type,
                       Place& place) const {
  const std::string_view before = operand.text.substr(0, begin);
  if (const std::uint32_t bits = bits_of_type(type); bits != 0) {
    const auto bit = is_digits(name) ? number_of(name) : std::nullopt;
    if (!bit || *bit >= bits || !place.word.empty()) {
      fail(operand, "RP052", "is no bit of " + std::string(type));
      return false;
    }
    place.word = before;
    place.bit = static_cast<std::uint32_t>(*bit);
    type = "BOOL";
    return true;
  }
  if (type == "TIMER" || type == "COUNTER") {
    const Kind kind = block_member(type, name);
    if (kind == Kind::None) {
      fail(operand, name == "ACC" || name == "PRE" ? "RP087" : "RP052",
           name == "ACC" || name == "PRE"
               ? "is not supported: a preset is a constant, and the time is "
                 "looked at in properties only (`.elapsed`)"
               : "is no member of " + std::string(type));
      return false;
    }
    place.block = before;
    type = kind == Kind::Bit ? "BOOL" : "DINT";
    return true;
  }
  const auto found = project_.types.find(type);
  const auto member = found == project_.types.end() ? DataType::const_iterator{}
                                                    : found->second.find(name);
  if (found == project_.types.end() || member == found->second.end()) {
    fail(operand, "RP052",
         "is no member of " + quoted_excerpt(type) +
             (found == project_.types.end() ? ": this type is not in the file"
                                            : ""));
    return false;
  }
  type = member->second.type;
  if (type != "BIT") return true;
  type = "BOOL";
  place.word = out_.keep_text(std::string(before) + "." +
                              std::string(member->second.target));
  place.bit = member->second.bit;
  return true;
}

Place Tags::of_type(const Operand& operand, std::string_view type,
                    Place place) const {
  place.bits = bits_of_type(type);
  if (type == "BOOL") {
    place.kind = Kind::Bit;
  } else if (place.bits != 0) {
    place.kind = Kind::Word;
  } else if (type == "TIMER") {
    place.kind = Kind::Timer;
  } else if (type == "COUNTER") {
    place.kind = Kind::Counter;
  } else {
    return fail(operand, "RP087",
                "has the type " + quoted_excerpt(type) +
                    ", which is not supported here");
  }
  if (!place.tag->dimensions.empty() && place.path.empty()) {
    return fail(operand, "RP087", "is a whole array: that is not supported");
  }
  return place;
}

// Without declarations: what is done with it says what it is.
Place Tags::undeclared_place(const Operand& operand, Kind wanted) const {
  const std::string_view text = operand.text;
  const bool letter = (text[0] >= 'a' && text[0] <= 'z') ||
                      (text[0] >= 'A' && text[0] <= 'Z') || text[0] == '_';
  const std::size_t dot = text.rfind('.');
  const bool good = letter && text.find_first_of("[](){}:?*\"") == text.npos;
  if (!good || dot + 1 == text.size()) {
    return fail(operand, "RP052", "is no name that is supported here");
  }
  Place place;
  place.kind = wanted;
  place.name = text;
  if (wanted == Kind::Word) place.bits = 32;
  if (dot == text.npos) return place;
  const std::string_view before = text.substr(0, dot);
  const std::string_view name = text.substr(dot + 1);
  if (is_digits(name)) {
    place.kind = Kind::Bit;
    place.word = before;
    place.bit = static_cast<std::uint32_t>(*number_of(name));
    return place.bit < 32 ? place : fail(operand, "RP052", "is no bit of DINT");
  }
  const auto block = uses_.find(before);
  if (block == uses_.end() || !blocks_.contains(before)) return place;
  place.block = before;
  place.kind = block_member(
      block->second.place.kind == Kind::Timer ? "TIMER" : "COUNTER", name);
  if (place.kind != Kind::None) return place;
  return fail(operand, "RP087",
              "is not supported: a member of a timer or a "
              "counter is DN, EN, TT, or DN, CU, CD, "
              "ACC");
}

// --- what instructions do ----------------------------------------------------

Tags::Use* Tags::note(const Operand& operand, Kind wanted, bool write) {
  const Place place = resolve(operand, wanted);
  if (place.kind == Kind::None) return nullptr;
  const auto [at, fresh] = uses_.emplace(place.name, Use{});
  Use& use = at->second;
  if (fresh) {
    use.place = place;
    use.where = operand.where;
    order_.push_back(place.name);
  } else if (use.place.kind != place.kind) {
    errors_.error("RP054", operand.where,
                  quoted_excerpt(operand.text) + " is " +
                      std::string(name_of(use.place.kind)) + " elsewhere",
                  {{use.where, "here"}});
    return nullptr;
  }
  if (write) {
    use.write = operand.where;
    if (!place.block.empty()) {
      fail(operand, "RP087",
           "is written: that is not supported, but by its own instructions");
    } else if (place.tag != nullptr && place.tag->constant) {
      fail(operand, "RP052", "is a constant: no rung writes it");
    }
  }
  return &use;
}

void Tags::note_word(const Operand& operand) {
  if (const auto number = number_of(operand.text)) {
    const std::int64_t top = std::int64_t{1} << 31;
    if (*number >= -top && *number < top) return;
    fail(operand, "RP053", "has more than 32 bits");
    return;
  }
  const bool number =
      !operand.text.empty() && operand.text[0] >= '0' && operand.text[0] <= '9';
  if (number || operand.text.starts_with("-") || operand.text == "?") {
    fail(operand, "RP053", "is no integer");
    return;
  }
  note(operand, Kind::Word, false);
}

// The members that the instructions themselves work with.
void Tags::need(const Place& block, std::string_view member, Kind kind,
                SourceRange where) {
  const std::string_view name =
      out_.keep_text(std::string(block.name) + "." + std::string(member));
  const auto [at, fresh] = uses_.emplace(name, Use{});
  if (!fresh) return;
  Use& use = at->second;
  use.place = {.kind = kind,
               .name = name,
               .bits = kind == Kind::Word ? 32U : 0U,
               .tag = block.tag,
               .block = block.name};
  use.where = where;
  order_.push_back(name);
}

void Tags::note_block(const Instruction& it, Kind kind) {
  const Use* const use = note(it.operands[0], kind, false);
  if (use == nullptr) return;
  const Place block = use->place;
  const SourceRange where = it.operands[0].where;
  blocks_.insert(block.name);
  const std::string_view type = kind == Kind::Timer ? "TIMER" : "COUNTER";
  for (const std::string_view name : {"DN", "EN", "TT", "CU", "CD", "ACC"}) {
    const Kind member = block_member(type, name);
    const std::string text = std::string(block.name) + "." + std::string(name);
    if (member != Kind::None && mentioned_.contains(text)) {
      need(block, name, member, where);
    }
  }
  if (kind != Kind::Counter || block.tag == nullptr) return;
  const std::string path = std::string(block.path) + ".ACC";
  if (value_of(*block.tag, path).value_or(0) == 0) return;
  fail(it.operands[0], "RP087",
       "begins with a count other than 0: that is not supported");
}

// Members that property lines speak of.
void Tags::note_properties() {
  const auto is_part = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
           (c >= '0' && c <= '9') || c == '_' || c == '.';
  };
  for (const AstAnnotation& line : ast_.annotations) {
    for (std::size_t at = 0; at < line.text.size();) {
      std::size_t end = at;
      while (end < line.text.size() && is_part(line.text[end])) ++end;
      if (end > at) mentioned_.emplace(line.text.substr(at, end - at));
      at = end + 1;
    }
  }
}

void Tags::survey(const Instruction& it) {
  const std::vector<Operand>& operands = it.operands;
  const auto write = [&](std::size_t i, bool set, bool clear) {
    Use* const use = note(operands[i], Kind::Bit, true);
    if (use == nullptr) return;
    use->set = use->set || set;
    use->cleared = use->cleared || clear;
  };
  switch (it.kind->op) {
    case Op::Examine:
      note(operands[0], Kind::Bit, false);
      return;
    case Op::Energize:
      return write(0, false, true);
    case Op::Latch:
    case Op::Unlatch:
      return write(0, false, false);
    case Op::OneShot:
      return write(0, true, false);
    case Op::OneShotRising:
      write(0, true, false);
      return write(1, false, true);
    case Op::OneShotFalling:
      write(0, false, true);
      return write(1, false, true);
    case Op::Timer:
      return note_block(it, Kind::Timer);
    case Op::Counter:
      return note_block(it, Kind::Counter);
    case Op::Compare:
    case Op::Limit:
      for (const Operand& operand : operands) note_word(operand);
      return;
    case Op::Move:
    case Op::Arithmetic:
      for (std::size_t i = 0; i + 1 < operands.size(); ++i) {
        note_word(operands[i]);
      }
      note(operands.back(), Kind::Word, true);
      return;
    case Op::Clear:
      note(operands[0], Kind::Word, true);
      return;
    default:
      return;
  }
}

// --- cells -------------------------------------------------------------------

AstDeclaration::Kind Tags::role_of(const Use& use) const {
  const Place& place = use.place;
  const bool whole = place.name.find_first_of(".[") == place.name.npos;
  if (!place.block.empty()) return Role::Memory;
  if (use.write.has_value()) {
    return whole && place.kind == Kind::Bit ? Role::Output : Role::Memory;
  }
  if (project_.names_inputs) {
    return project_.inputs.contains(place.name) ? Role::Input : Role::Memory;
  }
  const bool constant = place.tag != nullptr && place.tag->constant;
  return constant ? Role::Memory : Role::Input;
}

std::int64_t Tags::initial_of(const Use& use) const {
  const Place& place = use.place;
  const std::string_view member = place.block.empty()
                                      ? std::string_view{}
                                      : place.name.substr(place.block.size());
  if (use.set || member == ".CU" || member == ".CD") return 1;
  // The prescan clears timers.
  if (use.cleared || place.tag == nullptr || !place.block.empty()) return 0;
  if (!place.word.empty()) {
    const auto word =
        value_of(*place.tag, place.word.substr(place.tag->name.size()));
    if (word) return (*word >> place.bit) & 1;
  }
  return value_of(*place.tag, place.path).value_or(0);
}

void Tags::declare_use(Use& use) {
  const Place& place = use.place;
  if (place.kind != Kind::Bit && place.kind != Kind::Word) return;
  if (split_.contains(place.name)) return;
  const Role role = role_of(use);
  const CellShape shape =
      place.kind == Kind::Word ? shape_of(place.bits) : kBitCell;
  const std::uint32_t at = out_.declare(place.name, shape, role, use.where);
  if (role == Role::Input) return;
  const std::int64_t initial =
      std::clamp(initial_of(use), shape.low, shape.high);
  ast_.declarations[at].initial = initial;
  ast_.declarations[at].initialised = initial != 0;
}

// A word that is used next to its bits has a cell for each of them.
void Tags::split_words() {
  for (const std::string_view name : order_) {
    const Place& place = uses_.at(name).place;
    if (!place.word.empty()) split_[place.word][place.bit] = name;
  }
  for (auto& [word, bits] : split_) {
    const auto whole = uses_.find(word);
    if (whole == uses_.end()) continue;
    const Use use = whole->second;
    for (std::uint32_t bit = 0; bit < use.place.bits; ++bit) {
      if (!bits.contains(bit)) {
        const std::string_view name =
            out_.keep_text(std::string(word) + "." + std::to_string(bit));
        Use& fresh = uses_[name];
        fresh.place = use.place;
        fresh.place.kind = Kind::Bit;
        fresh.place.name = name;
        fresh.place.word = word;
        fresh.place.bit = bit;
        fresh.where = use.where;
        order_.push_back(name);
        bits[bit] = name;
      }
      Use& part = uses_.at(bits[bit]);
      if (use.write.has_value()) part.write = use.write;
    }
  }
}

void Tags::declare() {
  split_words();
  for (const auto& [name, where] : project_.inputs) {
    const auto use = uses_.find(name);
    if (use == uses_.end() || !use->second.write.has_value()) continue;
    errors_.error("RP052", use->second.write,
                  quoted_excerpt(name) + " is said to be an input",
                  {{where, "here"}});
  }
  for (const std::string_view name : order_) declare_use(uses_.at(name));
}

Place Tags::place(const Operand& operand, Kind wanted) {
  return resolve(operand, wanted);
}

Kind Tags::block_kind(std::string_view name) const {
  return blocks_.contains(name) ? uses_.at(name).place.kind : Kind::None;
}

std::vector<std::string_view> Tags::bits_of(const Place& word) const {
  std::vector<std::string_view> cells;
  const auto split = split_.find(word.name);
  if (split == split_.end()) return cells;
  for (const auto& [bit, name] : split->second) cells.push_back(name);
  return cells;
}

Expression Tags::word(const Operand& operand) {
  Expression nodes;
  if (const auto number = number_of(operand.text)) {
    push_leaf(nodes, AstOp::Number, out_.keep_text(std::to_string(*number)),
              operand.where);
    return nodes;
  }
  const Place word = place(operand, Kind::Word);
  const std::vector<std::string_view> bits = bits_of(word);
  if (bits.empty()) {
    push_leaf(nodes, AstOp::Name, word.name, operand.where);
    return nodes;
  }
  for (std::size_t i = 0; i < bits.size(); ++i) {
    std::int64_t weight = std::int64_t{1} << i;
    if (i + 1 == bits.size()) weight = -weight;  // two's complement
    push_leaf(nodes, AstOp::Name, bits[i], operand.where);
    push_conversion(nodes, "to_word", operand.where);
    push_leaf(nodes, AstOp::Number, out_.keep_text(std::to_string(weight)),
              operand.where);
    push_binary(nodes, AstOp::Multiply, operand.where);
    if (i > 0) push_binary(nodes, AstOp::Add, operand.where);
  }
  return nodes;
}

std::string_view Tags::member(std::string_view block,
                              std::string_view name) const {
  const auto use = uses_.find(std::string(block) + "." + std::string(name));
  return use == uses_.end() ? std::string_view{} : use->first;
}

std::int64_t Tags::preset(const Instruction& it) {
  const Operand& operand = it.operands[1];
  const Place block = place(
      it.operands[0], it.kind->op == Op::Timer ? Kind::Timer : Kind::Counter);
  std::optional<std::int64_t> value = number_of(operand.text);
  if (!value && operand.text == "?" && block.tag != nullptr) {
    value = value_of(*block.tag, std::string(block.path) + ".PRE");
  }
  const bool timer = it.kind->op == Op::Timer;
  if (value && *value <= 0x7fff'ffff && *value >= (timer ? 0 : -0x7fff'ffff)) {
    return *value;
  }
  errors_.error("RP053", operand.where,
                value ? "this preset is out of range"
                      : "the preset is neither here nor in the tag");
  return 0;
}

}  // namespace rung::rockwell
