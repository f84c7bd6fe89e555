// ListParser: labels, and jumps as guards of what they skip.

#include <algorithm>

#include "base/text.h"
#include "frontend/il_iec/list_parser.h"

namespace rung::il_iec {

void ListParser::find_labels() {
  const std::size_t begin = cursor_.position();
  bool starts = true;
  while (!cursor_.at(TokenKind::End)) {
    const bool here = starts && cursor_.at(TokenKind::Word) &&
                      cursor_.at(TokenKind::Colon, 1);
    starts = cursor_.at(TokenKind::LineEnd);
    const std::size_t position = cursor_.position();
    const Token& token = cursor_.take();
    if (!here) continue;
    const auto [entry, is_new] =
        labels_.try_emplace(iec::upper(cursor_.text(token)),
                            Label{position, cursor_.range(token), {}});
    if (is_new) continue;
    scope_.fail("RP046", cursor_.range(token),
                "the label " + quoted_excerpt(cursor_.text(token)) +
                    " stands here a second time",
                {{entry->second.where, "it stands here first"}});
  }
  cursor_.go_to(begin);
}

void ListParser::label() {
  const Token& token = cursor_.take();
  cursor_.take();
  const SourceRange where = cursor_.range(token);
  if (!frames_.empty()) {
    return fail("RP046", where, "a label inside of parentheses");
  }
  const auto found = labels_.find(iec::upper(cursor_.text(token)));
  if (found == labels_.end()) {
    return fail("RP046", where, "a label stands at the begin of its line");
  }
  Label& here = found->second;
  if (here.jumps.empty()) return;
  open_jumps_ -= here.jumps.size();
  forget();
  // On from here: who was on, and who jumped here.
  Expression on;
  push_leaf(on, AstOp::Name, scope_.writer().guard(), where);
  for (const Jump& jump : here.jumps) {
    if (!jump.before.empty()) push_leaf(on, AstOp::Name, jump.before, where);
    push_leaf(on, AstOp::Name, jump.after, where);
    push_unary(on, AstOp::Not, where);
    if (!jump.before.empty()) push_binary(on, AstOp::And, where);
    push_binary(on, AstOp::Or, where);
  }
  here.jumps.clear();
  scope_.expansion().restore(base_);
  if (open_jumps_ != 0) {
    scope_.expansion().enter(scope_.writer().keep("run", kBitCell, on, where));
  }
}

ListParser::Label* ListParser::jump_target(SourceRange& where) {
  const std::string word = cursor_.word();
  if (word.empty()) {
    fail("RP046", cursor_.here(),
         "a jump needs a label and is followed by " + cursor_.shown());
    return nullptr;
  }
  const Token& token = cursor_.take();
  where = cover(where, cursor_.range(token));
  const auto found = labels_.find(word);
  if (found == labels_.end()) {
    std::vector<std::string_view> known;
    for (const auto& [name, label] : labels_) known.push_back(name);
    std::sort(known.begin(), known.end());
    const bool full = scope_.errors().is_full();
    fail("RP046", cursor_.range(token),
         "there is no label " + quoted_excerpt(cursor_.text(token)) +
             (full ? std::string() : did_you_mean(word, known)));
    return nullptr;
  }
  if (found->second.position < cursor_.position()) {
    fail("RP046", cursor_.range(token),
         "a jump back: only jumps to labels further down are supported, as a "
         "loop has no bound");
    return nullptr;
  }
  return &found->second;
}

void ListParser::jump(const Operator& op, SourceRange where) {
  if (!plain(op.name, where)) return;
  Label* target = nullptr;
  if (op.code == Code::Jump) {
    target = jump_target(where);
    if (target == nullptr) return;
  }
  if (op.condition && !known(where, iec::kBool, op.name)) return;
  jump_to(target, op, where);
}

void ListParser::jump_to(Label* target, const Operator& op, SourceRange where) {
  constexpr std::size_t kLarge = 16;
  if (op.condition && value_.nodes.size() > kLarge) keep_value(where);
  const std::string_view before = scope_.writer().guard();
  Expression on;
  if (op.condition) {
    push_all(on, value_.nodes);
    if (!op.negate) push_unary(on, AstOp::Not, where);
  } else {
    push_leaf(on, AstOp::Bool, "false", where);
  }
  const std::string_view after = scope_.keep_condition(on, where);
  scope_.expansion().enter(after);
  ++open_jumps_;
  if (target != nullptr) target->jumps.push_back({before, after});
  if (!op.condition) forget();
}

}  // namespace rung::il_iec
