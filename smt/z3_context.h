#pragma once

#include <z3.h>

#include <string>

namespace rung {

/// A Z3 context that counts references and reports errors by code. Created
/// late: it costs more than a whole small check.
class Z3Context {
 public:
  Z3Context();
  ~Z3Context();
  Z3Context(const Z3Context&) = delete;
  Z3Context& operator=(const Z3Context&) = delete;

  /// Null when there was too little memory; error() says so then.
  Z3_context get() const { return context_; }
  /// The last call's error; empty when it succeeded.
  std::string error() const;

 private:
  Z3_context context_ = nullptr;
};

}  // namespace rung
