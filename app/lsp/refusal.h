#pragma once

#include <string>

namespace rung::lsp {

/// Thrown by handlers: the request is answered with this error.
struct Refusal {
  int code = 0;
  std::string what;
};

}  // namespace rung::lsp
