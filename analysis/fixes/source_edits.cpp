#include "analysis/fixes/source_edits.h"

#include <algorithm>
#include <string>

namespace rung {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t'; }
bool is_space(char c) { return is_blank(c) || c == '\n' || c == '\r'; }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

}  // namespace

SourceEdits::SourceEdits(const SourceSet& sources, const Program& program)
    : sources_(sources),
      program_(program),
      all_(sources[program.file].text()),
      parent_(program.nodes.size(), kNone) {
  for (std::uint32_t i = 0; i < program.nodes.size(); ++i) {
    const Node& node = program.nodes[i];
    if (node.op == NodeOp::And || node.op == NodeOp::Or) {
      parent_[node.a] = parent_[node.b] = i;
    }
  }
  writers_.resize(program.cells.size());
  for (const RungId id : ids_of(program.rungs)) {
    writers_[program.rungs[id].target.index()].push_back(id.index());
    if (program.rungs[id].target_where.has_value()) {
      rungs_.push_back(id.index());
    }
  }
  std::stable_sort(rungs_.begin(), rungs_.end(),
                   [&](std::uint32_t a, std::uint32_t b) {
                     return program.rungs[RungId(a)].target_where.begin <
                            program.rungs[RungId(b)].target_where.begin;
                   });
}

std::uint32_t SourceEdits::node_at(SourceRange where) const {
  const auto behind = std::upper_bound(
      rungs_.begin(), rungs_.end(), where.begin,
      [&](std::uint32_t begin, std::uint32_t rung) {
        return begin < program_.rungs[RungId(rung)].target_where.begin;
      });
  if (behind == rungs_.begin()) return kNone;
  const Rung& rung = program_.rungs[RungId(*std::prev(behind))];
  for (std::uint32_t i = rung.end; i-- > rung.begin;) {
    if (program_.nodes[i].where == where) return i;
  }
  return kNone;
}

RungId SourceEdits::rung_at(SourceRange where) const {
  const auto found = std::lower_bound(
      rungs_.begin(), rungs_.end(), where.begin,
      [&](std::uint32_t rung, std::uint32_t begin) {
        return program_.rungs[RungId(rung)].target_where.begin < begin;
      });
  if (found == rungs_.end()) return {};
  const Rung& rung = program_.rungs[RungId(*found)];
  const bool same = rung.target_where == where || rung.where == where;
  return same ? RungId(*found) : RungId();
}

RungId SourceEdits::rung_around(std::uint32_t node) const {
  std::uint32_t low = 0;
  auto high = static_cast<std::uint32_t>(program_.rungs.size());
  while (low < high) {
    const std::uint32_t middle = low + (high - low) / 2;
    const Rung& rung = program_.rungs[RungId(middle)];
    if (node < rung.begin) {
      high = middle;
    } else if (node >= rung.end) {
      low = middle + 1;
    } else {
      return RungId(middle);
    }
  }
  return {};
}

SourceRange SourceEdits::with_parentheses(SourceRange where) const {
  while (true) {
    std::uint32_t begin = where.begin;
    std::uint32_t end = where.end;
    while (begin > 0 && is_space(all_[begin - 1])) --begin;
    while (end < all_.size() && is_space(all_[end])) ++end;
    if (begin == 0 || end == all_.size() || all_[begin - 1] != '(' ||
        all_[end] != ')') {
      return where;
    }
    where.begin = begin - 1;
    where.end = end + 1;
  }
}

bool SourceEdits::is_operator(SourceRange where) const {
  std::string word(trimmed(text(where)));
  for (char& c : word) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return word == "&&" || word == "||" || word == "&" || word == "AND" ||
         word == "OR";
}

std::optional<Edit> SourceEdits::remove_operand(std::uint32_t node) const {
  if (node == kNone || parent_[node] == kNone) return std::nullopt;
  const Node& parent = program_.nodes[parent_[node]];
  const std::uint32_t other = parent.a == node ? parent.b : parent.a;
  const SourceRange gone = program_.nodes[node].where;
  const SourceRange kept = program_.nodes[other].where;
  const bool written = gone.has_value() && kept.has_value() &&
                       gone.file == program_.file && kept.file == gone.file &&
                       (gone.end <= kept.begin || kept.end <= gone.begin);
  if (!written) return std::nullopt;
  const SourceRange out = with_parentheses(gone);
  const SourceRange in = with_parentheses(kept);
  const bool first = out.end <= in.begin;
  if (!first && in.end > out.begin) return std::nullopt;
  const SourceRange between = first ? SourceRange{gone.file, out.end, in.begin}
                                    : SourceRange{gone.file, in.end, out.begin};
  if (!is_operator(between)) return std::nullopt;
  return Edit{first ? SourceRange{gone.file, out.begin, in.begin}
                    : SourceRange{gone.file, in.end, out.end},
              ""};
}

std::uint32_t SourceEdits::statement_end(RungId id) const {
  std::uint32_t end = program_.rungs[id].where.end;
  for (std::uint32_t at = end; at < all_.size(); ++at) {
    if (is_blank(all_[at])) continue;
    if (all_[at] == ';') end = at + 1;
    break;
  }
  return end;
}

std::optional<Edit> SourceEdits::remove_rung(RungId id) const {
  if (!id.has_value()) return std::nullopt;
  const SourceRange where = program_.rungs[id].where;
  if (!where.has_value() || where.file != program_.file) return std::nullopt;
  std::uint32_t begin = where.begin;
  std::uint32_t end = statement_end(id);
  // An argument of a call (`Q => lamp`) is written as well, and no statement.
  const bool statement = value_of(id) && all_[end - 1] == ';';
  if (program_.language == "st" && !statement) return std::nullopt;
  std::uint32_t rest = end;
  while (rest < all_.size() && is_blank(all_[rest])) ++rest;
  std::uint32_t start = begin;
  while (start > 0 && is_blank(all_[start - 1])) --start;
  const bool first =
      start == 0 || all_[start - 1] == '\n' || all_[start - 1] == '\r';
  const bool last =
      rest == all_.size() || all_[rest] == '\n' || all_[rest] == '\r';
  if (first && last) {  // the whole line
    begin = start;
    end = rest;
    if (end < all_.size() && all_[end] == '\r') ++end;
    if (end < all_.size() && all_[end] == '\n') ++end;
  } else if (first) {
    end = rest;
  } else {
    begin = start;
  }
  return Edit{{where.file, begin, end}, ""};
}

std::optional<SourceRange> SourceEdits::value_of(RungId id) const {
  if (!id.has_value()) return std::nullopt;
  const Rung& rung = program_.rungs[id];
  const SourceRange root = program_.nodes[rung.root()].where;
  if (!rung.where.has_value() || !root.has_value() ||
      rung.where.file != program_.file || root.begin <= rung.target_where.end) {
    return std::nullopt;
  }
  const SourceRange value = with_parentheses(root);
  const std::string_view sign =
      trimmed(text({root.file, rung.target_where.end, value.begin}));
  if (sign != "=" && sign != ":=") return std::nullopt;
  return value;
}

}  // namespace rung
