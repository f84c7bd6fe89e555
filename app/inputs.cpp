#include "app/inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <system_error>
#include <utility>

#include "base/process.h"
#include "frontend/postfix/disassemble.h"
#include "frontend/postfix/reader.h"

namespace rung {
namespace {

namespace fs = std::filesystem;

// `.xml` and `.txt` may hold anything: such files are named one by one.
constexpr std::string_view kEndings[] = {".rung", ".st",  ".il", ".ld",
                                         ".ino",  ".awl", ".l5x"};

struct Bytes {
  std::string text;
  std::string_view code;  // of the error; empty when there is none
  std::string error;
};

struct Closer {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

/// Reads to the end: a pipe has no size to ask for.
Bytes read_stream(std::FILE* stream) {
  constexpr std::size_t kBlock = std::size_t{1} << 16;
  Bytes bytes;
  std::size_t used = 0;
  while (true) {
    bytes.text.resize(std::max(used + kBlock, bytes.text.size()));
    const std::size_t got = std::fread(bytes.text.data() + used, 1,
                                       bytes.text.size() - used, stream);
    used += got;
    if (used > kMaxFileBytes) {
      return {"", "RP071", "the file is larger than 1 GiB"};
    }
    if (used < bytes.text.size()) break;
    bytes.text.resize(2 * used);
  }
  if (std::ferror(stream) != 0) {
    return {"", "RP070", fmt::format("cannot read: {}", std::strerror(errno))};
  }
  bytes.text.resize(used);
  return bytes;
}

Bytes read_bytes(const std::string& path) {
  if (path == "-") return read_stream(stdin);
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) {
    return {"", "RP070", "cannot read: it is a directory"};
  }
  const std::unique_ptr<std::FILE, Closer> file(std::fopen(path.c_str(), "rb"));
  if (!file) {
    return {"", "RP070", fmt::format("cannot read: {}", std::strerror(errno))};
  }
  return read_stream(file.get());
}

Input failed(const std::string& path, SourceSet& sources, std::string_view code,
             std::string message) {
  const FileId file = sources.add(path, "");
  return {file, path, file_error(file, code, std::move(message))};
}

Input take(const std::string& path, Bytes bytes, SourceSet& sources) {
  if (!bytes.code.empty()) {
    return failed(path, sources, bytes.code, std::move(bytes.error));
  }
  if (!is_postfix_binary(bytes.text)) {
    return {sources.add(path, std::move(bytes.text)), path, std::nullopt};
  }
  // Places in a binary are those of the text that it stands for.
  DiagnosticList refused;
  const FileId file =
      add_postfix(sources, path, std::move(bytes.text), refused);
  if (!refused.has_errors()) return {file, path, std::nullopt};
  const Diagnostic& first = refused.items().front();
  return failed(path, sources, first.code, first.message);
}

bool has_known_ending(const fs::path& path) {
  std::string ending = path.extension().string();
  for (char& c : ending)
    c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return std::find(std::begin(kEndings), std::end(kEndings), ending) !=
         std::end(kEndings);
}

/// The scripts below `directory`; `error` when some of it cannot be read.
std::vector<std::string> scripts_below(const std::string& directory,
                                       const FileFilter& wanted,
                                       std::error_code& error) {
  std::vector<std::string> found;
  fs::recursive_directory_iterator at(directory, error);
  while (!error && at != fs::recursive_directory_iterator()) {
    std::error_code ignored;
    std::string path = at->path().lexically_normal().string();
    if (!at->is_directory(ignored) &&
        wanted(path, has_known_ending(at->path()))) {
      found.push_back(std::move(path));
    }
    at.increment(error);
  }
  std::sort(found.begin(), found.end());
  return found;
}

void read_directory(const std::string& path, const FileFilter& wanted,
                    SourceSet& sources, std::vector<Input>& inputs) {
  std::error_code error;
  const std::vector<std::string> scripts = scripts_below(path, wanted, error);
  for (const std::string& script : scripts) {
    inputs.push_back(read_input(script, sources));
  }
  std::string endings;
  for (const std::string_view ending : kEndings) {
    endings += (endings.empty() ? "" : "`, `") + std::string(ending);
  }
  if (error) {
    inputs.push_back(failed(
        path, sources, "RP070",
        fmt::format("cannot read the whole directory: {}", error.message())));
  } else if (scripts.empty()) {
    inputs.push_back(failed(
        path, sources, "RP072",
        "no program in this directory: no file ends in `" + endings + "`"));
  }
}

}  // namespace

Diagnostic file_error(FileId file, std::string_view code, std::string message) {
  Diagnostic diagnostic;
  diagnostic.code = code;
  diagnostic.severity = Severity::Error;
  diagnostic.where = {file, 0, 0};
  diagnostic.message = std::move(message);
  return diagnostic;
}

Input read_input(const std::string& path, SourceSet& sources) {
  return take(path, read_bytes(path), sources);
}

Input read_committed(const std::string& revision, const std::string& path,
                     SourceSet& sources) {
  const std::string label = revision + ":" + path;
  const fs::path file(path);
  const std::string folder = file.parent_path().string();
  // `./` makes git look from the folder on, not from the repository's top.
  ProcessOutput output = run_process(
      {"git", "-C", folder.empty() ? "." : folder, "show", "--end-of-options",
       revision + ":./" + file.filename().string()},
      60, kMaxFileBytes);
  if (!output.error.empty())
    return failed(label, sources, "RP070", output.error);
  if (output.status != 0) {
    const std::string first = output.text.substr(0, output.text.find('\n'));
    return failed(label, sources, "RP070", "git: " + first);
  }
  return take(label, {std::move(output.text), {}, {}}, sources);
}

std::vector<Input> read_inputs(const std::vector<std::string>& paths,
                               const FileFilter& wanted, SourceSet& sources) {
  std::vector<Input> inputs;
  for (const std::string& path : paths) {
    std::error_code ignored;
    if (path != "-" && fs::is_directory(path, ignored)) {
      read_directory(path, wanted, sources, inputs);
    } else {
      inputs.push_back(read_input(path, sources));
    }
  }
  return inputs;
}

std::string working_directory() {
  std::error_code error;
  const fs::path path = fs::current_path(error);
  return error ? std::string() : path.string();
}

}  // namespace rung
