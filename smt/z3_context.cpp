#include "smt/z3_context.h"

#include <cstdlib>

#include "base/heap.h"

namespace rung {
namespace {

/// For Z3's tables and a small script: without it Z3 ends the process.
bool has_memory() {
  constexpr std::size_t kTables = std::size_t{48} << 20;
  void* const probe = std::malloc(kTables);
  const bool enough = probe != nullptr;
  std::free(probe);
  return enough;
}

}  // namespace

// Z3 4.8.12 clears two tables of 8 MB for each term manager that it makes, and
// a context makes two: four thousand page faults, 41 ms of the 44 ms that its
// start took where this was measured. On huge pages it takes 3 to 7 ms.
Z3Context::Z3Context() {
  prepare_heap();
  if (!has_memory()) return;
  Z3_config config = Z3_mk_config();
  context_ = Z3_mk_context_rc(config);
  Z3_del_config(config);
  Z3_set_error_handler(context_, nullptr);
}

Z3Context::~Z3Context() {
  if (context_ != nullptr) Z3_del_context(context_);
}

std::string Z3Context::error() const {
  if (context_ == nullptr) return "not enough memory for Z3";
  const Z3_error_code code = Z3_get_error_code(context_);
  if (code == Z3_OK) return {};
  return Z3_get_error_msg(context_, code);
}

}  // namespace rung
