#include "reports/paths.h"

#include <fmt/format.h>

namespace rung {
namespace {

bool is_unreserved(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
         (c >= '0' && c <= '9') || c == '-' || c == '.' || c == '_' ||
         c == '~' || c == '/';
}

}  // namespace

std::string relative_path(std::string_view path, std::string_view directory) {
  if (!directory.empty() && path.size() > directory.size() + 1 &&
      path.starts_with(directory) && path[directory.size()] == '/') {
    path.remove_prefix(directory.size() + 1);
  }
  while (path.size() > 2 && path.starts_with("./")) path.remove_prefix(2);
  return std::string(path);
}

std::string path_uri(std::string_view path) {
  std::string out = path.starts_with('/') ? "file://" : "";
  for (const char c : path) {
    if (is_unreserved(c)) {
      out += c;
    } else {
      out += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
  }
  return out;
}

}  // namespace rung
