#include "app/locks.h"

#include "app/inputs.h"

namespace rung {

std::variant<Lock, std::string> load_lock(const std::string& path) {
  SourceSet sources;
  const Input input = read_input(path, sources);
  if (input.error) return path + ": " + input.error->message;
  auto lock = read_lock(sources[input.file].text());
  if (const auto* error = std::get_if<std::string>(&lock)) {
    return path + ": " + *error;
  }
  return lock;
}

}  // namespace rung
