#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "base/digest.h"

namespace rung {

/// Bytes in a directory, each under the digest of what they answer. Any number
/// of processes may use one directory at a time: an entry is written beside its
/// place and renamed into it. What is read is believed only if it is whole and
/// was written under the same key; else there is none.
class ResultStore {
 public:
  static constexpr std::uint64_t kMostBytes = std::uint64_t{256} << 20U;

  struct Size {
    std::uint64_t entries = 0;
    std::uint64_t bytes = 0;
  };

  explicit ResultStore(std::filesystem::path directory,
                       std::uint64_t most_bytes = kMostBytes)
      : directory_(std::move(directory)), most_bytes_(most_bytes) {}

  const std::filesystem::path& directory() const { return directory_; }

  /// Makes the directory. Why it cannot be used: it is no directory, or any
  /// user of the machine may write answers into it.
  [[nodiscard]] std::optional<std::string> open() const;

  std::optional<std::string> find(const Digest& key) const;

  /// Why it could not be written.
  [[nodiscard]] std::optional<std::string> keep(const Digest& key,
                                                std::string_view bytes) const;

  Size size() const;
  /// Removes what was not used for longest until all that is left fits.
  void trim() const { shrink(most_bytes_); }
  /// Removes every entry, and nothing else in the directory.
  void clear() const { shrink(0); }

 private:
  std::filesystem::path path_of(const Digest& key) const;
  void shrink(std::uint64_t most_bytes) const;

  std::filesystem::path directory_;
  std::uint64_t most_bytes_;
};

}  // namespace rung
