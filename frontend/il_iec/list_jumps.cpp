// ListParser: labels, and jumps as guards of what they skip.

#include <algorithm>

#include "frontend/il_iec/list_parser.h"

namespace rung::il_iec {

void ListParser::find_labels(std::string_view end_word) {
  const std::size_t begin = cursor_.position();
  bool starts = true;
  while (!cursor_.at(TokenKind::End) &&
         (end_word.empty() || cursor_.word() != end_word)) {
    const bool here = starts && cursor_.at(TokenKind::Word) &&
                      cursor_.at(TokenKind::Colon, 1);
    starts = cursor_.at(TokenKind::LineEnd);
    const std::size_t position = cursor_.position();
    const Token& token = cursor_.take();
    if (!here) continue;
    const auto [entry, is_new] = labels_.try_emplace(
        upper(cursor_.text(token)), Label{position, cursor_.range(token), {}});
    if (is_new) continue;
    errors_.error("RP046", cursor_.range(token),
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
  const auto found = labels_.find(upper(cursor_.text(token)));
  if (found == labels_.end()) {
    return fail("RP046", where, "a label stands at the begin of its line");
  }
  Label& here = found->second;
  if (here.jumps.empty()) return;
  open_jumps_ -= here.jumps.size();
  forget();
  if (open_jumps_ == 0) {
    writer_.set_guard({});
  } else {
    // On from here: who was on, and who jumped here.
    Expression on;
    push_leaf(on, AstOp::Name, writer_.guard(), where);
    for (const Jump& jump : here.jumps) {
      if (!jump.before.empty()) {
        push_leaf(on, AstOp::Name, jump.before, where);
      }
      push_leaf(on, AstOp::Name, jump.after, where);
      push_unary(on, AstOp::Not, where);
      if (!jump.before.empty()) push_binary(on, AstOp::And, where);
      push_binary(on, AstOp::Or, where);
    }
    writer_.set_guard(writer_.keep("run", Kind::Bool, on, where));
  }
  here.jumps.clear();
}

void ListParser::jump(const Operator& op, SourceRange where) {
  if (!plain(op, where)) return;
  Label* target = nullptr;
  if (op.code == Code::Jump) {
    const std::string word = cursor_.word();
    if (word.empty()) {
      return fail("RP046", cursor_.range(cursor_.peek()),
                  quoted_excerpt(op.name) +
                      " needs a label and is followed by " + cursor_.shown());
    }
    const Token& token = cursor_.take();
    where = cover(where, cursor_.range(token));
    const auto found = labels_.find(word);
    if (found == labels_.end()) {
      std::vector<std::string_view> known;
      for (const auto& [name, label] : labels_) {
        if (!errors_.is_full()) known.push_back(name);
      }
      std::sort(known.begin(), known.end());
      return fail("RP046", cursor_.range(token),
                  "there is no label " + quoted_excerpt(cursor_.text(token)) +
                      suggestion(word, known));
    }
    if (found->second.position < cursor_.position()) {
      return fail("RP046", cursor_.range(token),
                  "a jump back: only jumps to labels further down are "
                  "supported, as a loop has no bound");
    }
    target = &found->second;
  }
  if (op.condition && !known(where, Kind::Bool, op.name)) return;
  jump_to(target, op, where);
}

void ListParser::jump_to(Label* target, const Operator& op, SourceRange where) {
  constexpr std::size_t kLarge = 16;
  if (op.condition && stack_.size() - start() > kLarge) keep_value(where);
  const std::string_view before = writer_.guard();
  Expression on;
  if (!before.empty()) push_leaf(on, AstOp::Name, before, where);
  if (op.condition) {
    const Expression condition = value();
    on.insert(on.end(), condition.begin(), condition.end());
    if (!op.negate) push_unary(on, AstOp::Not, where);
  } else {
    push_leaf(on, AstOp::Bool, "false", where);
  }
  if (!before.empty()) push_binary(on, AstOp::And, where);
  const std::string_view after = writer_.keep("run", Kind::Bool, on, where);
  writer_.set_guard(after);
  ++open_jumps_;
  if (target != nullptr) target->jumps.push_back({before, after});
  if (!op.condition) forget();
}

}  // namespace rung::il_iec
