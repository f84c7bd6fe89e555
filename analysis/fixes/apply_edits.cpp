#include "analysis/fixes/apply_edits.h"

#include <algorithm>
#include <tuple>

namespace rung {

bool make_disjoint(std::vector<Edit>& edits) {
  const auto key = [](const Edit& edit) {
    return std::tie(edit.where.begin, edit.where.end, edit.text);
  };
  std::sort(edits.begin(), edits.end(),
            [&](const Edit& a, const Edit& b) { return key(a) < key(b); });
  edits.erase(std::unique(edits.begin(), edits.end(),
                          [&](const Edit& a, const Edit& b) {
                            return key(a) == key(b);
                          }),
              edits.end());
  for (std::size_t i = 1; i < edits.size(); ++i) {
    const SourceRange before = edits[i - 1].where;
    const SourceRange here = edits[i].where;
    if (here.begin < before.end || here.begin == before.begin) return false;
  }
  return true;
}

std::string apply_edits(std::string_view text, const std::vector<Edit>& edits) {
  std::string out;
  std::size_t from = 0;
  for (const Edit& edit : edits) {
    out += text.substr(from, edit.where.begin - from);
    out += edit.text;
    from = edit.where.end;
  }
  return out += text.substr(from);
}

}  // namespace rung
