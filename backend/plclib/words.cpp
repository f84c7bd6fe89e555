#include <algorithm>
#include <limits>
#include <utility>

#include "backend/plclib/wiring.h"
#include "backend/unit/bounds.h"

namespace rung::backend {
namespace {

constexpr Bounds kLong = {std::numeric_limits<std::int32_t>::min(),
                          std::numeric_limits<std::int32_t>::max()};
constexpr Bounds kSample = {0, 1'023};

bool is_arithmetic(NodeOp op) {
  return op == NodeOp::Add || op == NodeOp::Subtract ||
         op == NodeOp::Multiply || op == NodeOp::Divide || op == NodeOp::Negate;
}

class Settler {
 public:
  Settler(Unit& unit, const Wiring& wiring) : unit_(unit) {
    for (const Variable& variable : unit.variables) {
      bounds_.push_back({variable.initial, variable.initial});
    }
    for (const Sample& sample : wiring.samples) {
      if (sample.image.has_value()) bounds_[sample.image.index()] = kSample;
    }
    for (const CellId id : ids_of(unit.variables)) {
      if (unit.variables[id].role == CellRole::Input) {
        bounds_[id.index()] = kSample;
      }
    }
    for (const Statement& statement : unit.statements) {
      if (statement.target.has_value()) widen(statement);
    }
  }

  std::string run() {
    std::vector<Statement> statements;
    for (Statement& statement : unit_.statements) {
      around_ = &statement;
      statement.guard = settled(statement.guard, {}, statements);
      statement.value = settled(statement.value, statement.guard, statements);
      statements.push_back(std::move(statement));
    }
    unit_.statements = std::move(statements);
    return std::move(error_);
  }

 private:
  struct Operand {
    std::size_t begin = 0;  // in the terms
    Bounds bounds;
  };

  /// A word that is given more than constants may be anything.
  void widen(const Statement& statement) {
    Bounds& bounds = bounds_[statement.target.index()];
    const Term& last = statement.value.back();
    if (last.op != NodeOp::Constant) {
      bounds = kLong;
      return;
    }
    bounds = {std::min(bounds.low, last.value),
              std::max(bounds.high, last.value)};
  }

  /// The same expression, without operators of constants.
  Terms settled(const Terms& terms, const Terms& guard,
                std::vector<Statement>& before) {
    Terms out;
    std::vector<Operand> operands;
    for (std::size_t at = 0; at < terms.size(); ++at) {
      const Term& term = terms[at];
      if (term.op == NodeOp::Constant || term.op == NodeOp::Read) {
        const Bounds bounds = term.op == NodeOp::Read
                                  ? bounds_[term.cell.index()]
                                  : Bounds{term.value, term.value};
        if (term.type == Type::Word && term.op == NodeOp::Constant &&
            term.value <= kLong.low) {
          error_ = "the constant " + std::to_string(term.value) +
                   " is no number of C++ on the controller";
        }
        operands.push_back({out.size(), bounds});
        out.push_back(term);
        continue;
      }
      const std::uint32_t count =
          term.op == NodeOp::Not || term.op == NodeOp::Negate ? 1 : 2;
      const Operand right = operands.back();
      operands.resize(operands.size() - (count - 1));
      Operand& left = operands.back();
      const Bounds low = left.bounds;
      push_operator(out, term.op, term.type, count);
      if (!is_arithmetic(term.op)) continue;
      if (term.op == NodeOp::Divide &&
          (right.bounds.low != right.bounds.high || right.bounds.low <= 0)) {
        error_ = "a division by what is no constant greater than 0";
      }
      left.bounds = bounds_of(term.op, low, right.bounds);
      shorten(out, left, at + 1 == terms.size(), guard, before);
    }
    return out;
  }

  void shorten(Terms& out, Operand& operand, bool root, const Terms& guard,
               std::vector<Statement>& before) {
    const auto begin = out.begin() + static_cast<std::ptrdiff_t>(operand.begin);
    if (operand.bounds.low == operand.bounds.high &&
        operand.bounds.within(kLong.low, kLong.high)) {
      out.erase(begin, out.end());
      out.push_back({.type = Type::Word, .value = operand.bounds.low});
      return;
    }
    if (root || operand.bounds.within(kLong.low, kLong.high)) return;
    Terms value(begin, out.end());
    out.erase(begin, out.end());
    const std::string& name = around_->target.has_value()
                                  ? unit_.variables[around_->target].name
                                  : unit_.blocks[around_->block].name;
    const CellId cell = unit_.variables.add(
        {.name = unit_.names.make(name), .type = Type::Word});
    bounds_.push_back(kLong);
    before.push_back({.guard = guard,
                      .target = cell,
                      .value = std::move(value),
                      .rung = around_->rung});
    out.push_back(read_term(cell, Type::Word)[0]);
    operand.bounds = kLong;
  }

  Unit& unit_;
  std::vector<Bounds> bounds_;  // by variable
  const Statement* around_ = nullptr;
  std::string error_;
};

}  // namespace

std::string settle_words(Unit& unit, const Wiring& wiring) {
  return Settler(unit, wiring).run();
}

}  // namespace rung::backend
