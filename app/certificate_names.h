#pragma once

#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "analysis/result.h"
#include "smt/slices.h"

namespace rung {

/// Finds the variables that texts of certificates name: a name where no letter,
/// digit or underscore stands beside it. It may find one that is not meant, and
/// never misses one.
class CertificateNames {
 public:
  explicit CertificateNames(const TransitionSystem& ts);

  /// In ascending order.
  std::vector<VarId> in(const Certificate& certificate) const;

 private:
  const TransitionSystem& ts_;
  std::unordered_map<std::string_view, std::vector<VarId>> by_word_;
};

/// Old names and new ones.
using NewNames = std::vector<std::pair<std::string, std::string>>;
void rename(Certificate& certificate, const NewNames& names);

}  // namespace rung
