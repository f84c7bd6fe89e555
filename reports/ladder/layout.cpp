#include "reports/ladder/layout.h"

#include <algorithm>
#include <optional>

#include "reports/ladder/expression_text.h"
#include "reports/unicode.h"

namespace rung {
namespace {

using Kind = LadderShape::Kind;

// The nets at the two ends of a network; they become the rails.
constexpr int kIn = LadderRung::kLeftRail;
constexpr int kOut = LadderRung::kRightRail;

/// A part of a rung with one wire in at its left and one out at its right, both
/// in row 0.
struct Network {
  std::vector<LadderShape> shapes;
  int width = 0;
  int height = 1;
  int nets = 2;
};

int text_width(const std::string& text) {
  return static_cast<int>(printable_width(text));
}

Network single(Kind kind, std::string text,
               std::uint32_t node = LadderShape::kNoNode) {
  // Room for the symbol and wires on each side.
  const int symbol = kind == Kind::Box ? text_width(text) + 2 : 3;
  const int width = std::max(symbol + 4, text_width(text) + 2);
  return {{{kind, 0, 0, width, 0, std::move(text), node, kIn, kOut}}, width, 1};
}

LadderShape wire(int x, int y, int width, int net) {
  return {Kind::Wire,           x,   y,   width, 0, "",
          LadderShape::kNoNode, net, net, false};
}

LadderShape riser(int x, int height, int net) {
  return {Kind::Riser,          x,   0,   0,    height, "",
          LadderShape::kNoNode, net, net, false};
}

/// Puts `part` into `to`, between its nets `in` and `out`.
void append(Network& to, const Network& part, int x, int y, int in, int out) {
  const int first_inner = to.nets;
  const auto renamed = [&](int net) {
    if (net == kIn) return in;
    return net == kOut ? out : first_inner + net - 2;
  };
  for (LadderShape shape : part.shapes) {
    shape.x += x;
    shape.y += y;
    shape.from = renamed(shape.from);
    shape.to = renamed(shape.to);
    to.shapes.push_back(std::move(shape));
  }
  to.nets += part.nets - 2;
}

Network series(const Network& left, const Network& right) {
  Network out;
  const int middle = out.nets++;
  append(out, left, 0, 0, kIn, middle);
  append(out, right, left.width, 0, middle, kOut);
  out.width = left.width + right.width;
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
    append(out, *branch, 1, y, kIn, kOut);
    out.shapes.push_back(wire(0, y, 1, kIn));
    out.shapes.push_back(
        wire(1 + branch->width, y, widest + 1 - branch->width, kOut));
    out.height += branch->height;
    last = y;
  }
  out.shapes.push_back(riser(0, last, kIn));
  out.shapes.push_back(riser(out.width, last, kOut));
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
    return with_coil(
        single(Kind::Box, texts_.back(), rung_.root() - rung_.begin));
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
    const std::uint32_t n = index - rung_.begin;
    if (node.op == NodeOp::And) return series(at(node.a), at(node.b));
    if (node.op == NodeOp::Or) return parallel(branches(index));
    if (node.op == NodeOp::Read) return single(Kind::Contact, text(index), n);
    if (node.op == NodeOp::Not && is_read(node.a)) {
      return single(Kind::Negated, text(node.a), n);
    }
    const auto input = chained_input(node);
    if (!input || !leading_[n]) return single(Kind::Box, text(index), n);
    const std::string label =
        node.op == NodeOp::Not ? "NOT"
                               : call_text(program_, program_.calls[node.call]);
    Network box = single(Kind::Box, label, n);
    box.shapes.front().behind_input = true;
    return series(at(*input), box);
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
    return {std::move(whole.shapes), whole.width, whole.height, whole.nets};
  }

  const Program& program_;
  const Rung& rung_;
  std::vector<std::string> texts_;
  std::vector<bool> leading_;
  std::vector<bool> shown_;
  std::vector<bool> absorbed_;
  std::vector<Network> networks_;
};

/// Moves the coil to a rail further to the right.
void widen(LadderRung& rung, int width) {
  if (width <= rung.width) return;
  LadderShape coil = std::move(rung.shapes.back());
  const int gap = width - rung.width;
  rung.shapes.back() = wire(coil.x, coil.y, gap, coil.from);
  coil.x += gap;
  rung.shapes.push_back(std::move(coil));
  rung.width = width;
}

}  // namespace

LadderRung lay_out_rung(const Program& program, const Rung& rung) {
  return RungLayout(program, rung).lay_out();
}

std::vector<LadderRung> lay_out_ladder(const Program& program) {
  std::vector<LadderRung> rungs;
  int width = 0;
  for (const Rung& rung : program.rungs) {
    rungs.push_back(lay_out_rung(program, rung));
    if (rungs.back().width <= kMaxAlignedWidth) {
      width = std::max(width, rungs.back().width);
    }
  }
  for (LadderRung& rung : rungs) widen(rung, width);
  return rungs;
}

}  // namespace rung
