#include "reports/ladder/layout.h"

#include <algorithm>
#include <optional>

#include "reports/ladder/expression_text.h"
#include "reports/unicode.h"

namespace rung {
namespace {

using Kind = LadderShape::Kind;

/// A part of a rung with one wire in at its left and one out at its right, both
/// in row 0.
struct Network {
  std::vector<LadderShape> shapes;
  int width = 0;
  int height = 1;
};

int text_width(const std::string& text) {
  return static_cast<int>(printable_width(text));
}

Network single(Kind kind, std::string text) {
  // Room for the symbol and wires on each side.
  const int symbol = kind == Kind::Box ? text_width(text) + 2 : 3;
  const int width = std::max(symbol + 4, text_width(text) + 2);
  return {{{kind, 0, 0, width, 0, std::move(text)}}, width, 1};
}

void append(Network& to, const Network& part, int x, int y) {
  for (LadderShape shape : part.shapes) {
    shape.x += x;
    shape.y += y;
    to.shapes.push_back(std::move(shape));
  }
}

Network series(const Network& left, const Network& right) {
  Network out = left;
  append(out, right, left.width, 0);
  out.width += right.width;
  out.height = std::max(left.height, right.height);
  return out;
}

/// Branches below each other, between a riser on each side.
Network parallel(const std::vector<const Network*>& branches) {
  int widest = 0;
  for (const Network* branch : branches) {
    widest = std::max(widest, branch->width);
  }
  Network out;
  out.width = widest + 2;
  out.height = 0;
  int last = 0;
  for (const Network* branch : branches) {
    const int y = out.height;
    append(out, *branch, 1, y);
    out.shapes.push_back({Kind::Wire, 0, y, 1, 0, ""});
    out.shapes.push_back(
        {Kind::Wire, 1 + branch->width, y, widest + 1 - branch->width, 0, ""});
    out.height += branch->height;
    last = y;
  }
  out.shapes.push_back({Kind::Riser, 0, 0, 0, last, ""});
  out.shapes.push_back({Kind::Riser, out.width, 0, 0, last, ""});
  return out;
}

class RungLayout {
 public:
  RungLayout(const Program& program, const Rung& rung)
      : program_(program),
        rung_(rung),
        texts_(expression_texts(program, rung)),
        leading_(rung.end - rung.begin, false),
        shown_(rung.end - rung.begin, false),
        absorbed_(rung.end - rung.begin, false),
        networks_(rung.end - rung.begin) {}

  LadderRung lay_out() {
    if (is_drawable()) {
      plan();
      for (std::uint32_t i = rung_.begin; i < rung_.end; ++i) {
        const std::uint32_t n = i - rung_.begin;
        if (shown_[n] && !absorbed_[n]) networks_[n] = draw(i);
      }
      const Network& whole = at(rung_.root());
      if (whole.width <= kMaxColumns && whole.height <= kMaxLadderRows) {
        return with_coil(whole);
      }
    }
    return with_coil(single(Kind::Box, texts_.back()));
  }

 private:
  Network& at(std::uint32_t node) { return networks_[node - rung_.begin]; }
  const std::string& text(std::uint32_t node) const {
    return texts_[node - rung_.begin];
  }

  bool is_drawable() const {
    return rung_.end - rung_.begin <= kMaxNodes &&
           program_.cells[rung_.target].type == Type::Bit;
  }

  /// Marks the nodes that get a network of their own, and those whose network
  /// starts at the left rail. Operands stand before the node: a loop backwards
  /// meets every node before its operands.
  void plan() {
    show(rung_.root(), true);
    for (std::uint32_t i = rung_.end; i-- > rung_.begin;) {
      if (!shown_[i - rung_.begin]) continue;
      const Node& node = program_.nodes[i];
      const bool leads = leading_[i - rung_.begin];
      if (node.op == NodeOp::And) {
        show(node.a, leads);
        show(node.b, false);
      } else if (node.op == NodeOp::Or) {
        show(node.a, leads);
        show(node.b, leads);
        absorb(node.a);
        absorb(node.b);
      } else if (const auto input = chained_input(node); input && leads) {
        show(*input, true);
      }
    }
  }

  void show(std::uint32_t node, bool leads) {
    shown_[node - rung_.begin] = true;
    leading_[node - rung_.begin] = leads;
  }

  /// Branches of branches are branches of the outer `||`.
  void absorb(std::uint32_t node) {
    absorbed_[node - rung_.begin] = program_.nodes[node].op == NodeOp::Or;
  }

  /// The one network that a node is drawn behind: of `!(...)` and of elements
  /// with one bit operand.
  std::optional<std::uint32_t> chained_input(const Node& node) const {
    if (node.op == NodeOp::Not && !is_read(node.a)) return node.a;
    if (node.op != NodeOp::Call) return std::nullopt;
    const ElementCall& call = program_.calls[node.call];
    if (call.arguments.size() != 1) return std::nullopt;
    return call.arguments.front();
  }

  bool is_read(std::uint32_t node) const {
    return program_.nodes[node].op == NodeOp::Read;
  }

  Network draw(std::uint32_t index) {
    const Node& node = program_.nodes[index];
    if (node.op == NodeOp::And) return series(at(node.a), at(node.b));
    if (node.op == NodeOp::Or) return parallel(branches(index));
    if (node.op == NodeOp::Read) return single(Kind::Contact, text(index));
    if (node.op == NodeOp::Not && is_read(node.a)) {
      return single(Kind::Negated, text(node.a));
    }
    const auto input = chained_input(node);
    if (!input || !leading_[index - rung_.begin]) {
      return single(Kind::Box, text(index));
    }
    const std::string label =
        node.op == NodeOp::Not ? "NOT"
                               : call_text(program_, program_.calls[node.call]);
    return series(at(*input), single(Kind::Box, label));
  }

  /// The operands of a run of `||`, so that three branches are not two in two.
  std::vector<const Network*> branches(std::uint32_t index) {
    std::vector<const Network*> out;
    std::vector<std::uint32_t> work = {index};
    while (!work.empty()) {
      const Node& node = program_.nodes[work.back()];
      const std::uint32_t here = work.back();
      work.pop_back();
      if (node.op == NodeOp::Or) {
        work.push_back(node.b);
        work.push_back(node.a);
      } else {
        out.push_back(&at(here));
      }
    }
    return out;
  }

  LadderRung with_coil(const Network& network) {
    const Network coil =
        single(Kind::Coil, printable(program_.cells[rung_.target].name));
    Network whole = series(network, coil);
    return {std::move(whole.shapes), whole.width, whole.height};
  }

  const Program& program_;
  const Rung& rung_;
  std::vector<std::string> texts_;
  std::vector<bool> leading_;
  std::vector<bool> shown_;
  std::vector<bool> absorbed_;
  std::vector<Network> networks_;
};

}  // namespace

LadderRung lay_out_rung(const Program& program, const Rung& rung) {
  return RungLayout(program, rung).lay_out();
}

}  // namespace rung
