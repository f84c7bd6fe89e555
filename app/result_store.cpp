#include "app/result_store.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>
#include <utility>
#include <vector>

namespace rung {
namespace {

namespace fs = std::filesystem;

// DIRECTORY/ab/cdef...: a folder for each of 256 first bytes.
constexpr std::size_t kFolderDigits = 2;
constexpr std::size_t kNameDigits = 64 - kFolderDigits;
constexpr std::string_view kTemporary = ".writing-";

bool is_hexadecimal(std::string_view text) {
  return text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

/// The first line of an entry: a digest of its key and all that follows.
std::string seal(const Digest& key, std::string_view bytes) {
  return to_string(Hasher().add(key).add(bytes).finish()) + "\n";
}

std::optional<std::string> read_all(const fs::path& path, std::uint64_t most) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(path, error);
  if (error || size > most) return std::nullopt;
  std::ifstream file(path, std::ios::binary);
  std::string bytes(size, '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(size));
  if (!file) return std::nullopt;
  return bytes;
}

bool write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

struct Entry {
  fs::file_time_type used;
  std::uint64_t bytes = 0;
  fs::path path;
};

/// Left by a process that was stopped while it wrote.
bool is_abandoned(const Entry& entry) {
  constexpr std::chrono::hours kLongest(1);
  return fs::file_time_type::clock::now() - entry.used > kLongest;
}

/// Entries alone: whatever else is in the directory is not ours.
std::vector<Entry> entries_in(const fs::path& directory) {
  std::vector<Entry> found;
  std::error_code error;
  for (fs::directory_iterator folder(directory, error), end;
       !error && folder != end; folder.increment(error)) {
    const std::string name = folder->path().filename().string();
    if (name.size() != kFolderDigits || !is_hexadecimal(name)) continue;
    std::error_code ignored;
    for (fs::directory_iterator file(folder->path(), ignored);
         !ignored && file != end; file.increment(ignored)) {
      const std::string own = file->path().filename().string();
      const bool is_entry = own.size() == kNameDigits && is_hexadecimal(own);
      const bool is_temporary = own.starts_with(kTemporary);
      if (!is_entry && !is_temporary) continue;
      std::error_code gone;  // another process may have removed it
      Entry entry{file->last_write_time(gone), file->file_size(gone),
                  file->path()};
      if (gone) continue;
      if (is_entry || is_abandoned(entry)) found.push_back(std::move(entry));
    }
  }
  return found;
}

}  // namespace

fs::path ResultStore::path_of(const Digest& key) const {
  const std::string name = to_string(key);
  return directory_ / name.substr(0, kFolderDigits) /
         name.substr(kFolderDigits);
}

std::optional<std::string> ResultStore::open() const {
  std::error_code error;
  const bool is_new = fs::create_directories(directory_, error);
  struct stat status {};
  if (error) return error.message();
  if (is_new) ::chmod(directory_.c_str(), S_IRWXU);
  if (::stat(directory_.c_str(), &status) != 0) return std::strerror(errno);
  if (!S_ISDIR(status.st_mode)) return "it is a file";
  if ((status.st_mode & S_IWOTH) != 0) {
    return "every user of this machine may write into it";
  }
  return std::nullopt;
}

std::optional<std::string> ResultStore::find(const Digest& key) const {
  const fs::path path = path_of(key);
  std::optional<std::string> bytes = read_all(path, most_bytes_);
  if (!bytes) return std::nullopt;
  const std::size_t end = bytes->find('\n');
  if (end == std::string::npos) return std::nullopt;
  std::string answer = bytes->substr(end + 1);
  if (bytes->substr(0, end + 1) != seal(key, answer)) return std::nullopt;
  std::error_code ignored;  // trim() then takes it for older than it is
  fs::last_write_time(path, fs::file_time_type::clock::now(), ignored);
  return answer;
}

std::optional<std::string> ResultStore::keep(const Digest& key,
                                             std::string_view bytes) const {
  const fs::path path = path_of(key);
  std::error_code error;
  fs::create_directories(path.parent_path(), error);
  std::string temporary =
      (path.parent_path() / fmt::format("{}XXXXXX", kTemporary)).string();
  const int file = ::mkstemp(temporary.data());
  if (file < 0) return std::strerror(errno);
  const bool written =
      write_all(file, seal(key, bytes)) && write_all(file, bytes);
  const int why = errno;
  const bool closed = ::close(file) == 0;
  if (written && closed) {
    fs::rename(temporary, path, error);
    if (!error) return std::nullopt;
  }
  std::error_code ignored;
  fs::remove(temporary, ignored);
  return error ? error.message() : std::strerror(why);
}

ResultStore::Size ResultStore::size() const {
  Size size;
  for (const Entry& entry : entries_in(directory_)) {
    ++size.entries;
    size.bytes += entry.bytes;
  }
  return size;
}

void ResultStore::shrink(std::uint64_t most_bytes) const {
  std::vector<Entry> entries = entries_in(directory_);
  std::uint64_t all = 0;
  for (const Entry& entry : entries) all += entry.bytes;
  if (all <= most_bytes && most_bytes > 0) return;
  std::sort(entries.begin(), entries.end(),
            [](const Entry& a, const Entry& b) { return a.used < b.used; });
  // Some room, so that not every run has to look for what to remove.
  const std::uint64_t wanted = most_bytes - most_bytes / 10;
  for (const Entry& entry : entries) {
    if (all <= wanted && most_bytes > 0) return;
    std::error_code ignored;
    fs::remove(entry.path, ignored);
    all -= entry.bytes;
  }
}

}  // namespace rung
