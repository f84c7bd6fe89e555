#include "app/answer_cache.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <utility>

#include "app/build_identity.h"
#include "app/config.h"
#include "app/known_proofs.h"

namespace rung {
namespace {

namespace fs = std::filesystem;

/// Of what is written, and of what it is filed under.
constexpr std::string_view kSchema = "rungproof.answer/1";

/// Options that change how an answer is shown and never what it is. All others
/// are part of what was asked: one that is forgotten here costs time and is
/// never wrong.
constexpr std::string_view kOnlyShown[] = {
    "FILE",     "--baseline", "--cache", "--color",  "--fail-on",
    "--format", "--jobs",     "--quiet", "--verbose"};

/// Options that what is decided for good does not depend on either: a budget, a
/// choice of what is asked, and what slices have in them.
constexpr std::string_view kOnlySelect[] = {"--property", "--props", "--sweep",
                                            "--timeout"};

template <std::size_t N>
bool is_one_of(std::string_view option, const std::string_view (&list)[N]) {
  return std::find(std::begin(list), std::end(list), option) != std::end(list);
}

/// Answers with effects outside of a report, from a program that may be another
/// one tomorrow, or that are made to be wrong.
bool may_be_kept(const Options& options) {
  return options.certificates.empty() && options.recheck.empty() &&
         options.replay_on.empty() && !options.explain &&
         !options.inject_wrong_invariant && !options.inject_wrong_trace;
}

std::string from_environment(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? std::string() : std::string(value);
}

std::string users_directory() {
  const std::string named = from_environment("XDG_CACHE_HOME");
  if (named.starts_with('/')) return named + "/rungproof";
  const std::string home = from_environment("HOME");
  return home.empty() ? std::string() : home + "/.cache/rungproof";
}

Hasher tool(const Digest& build) {
  Hasher hasher;
  hasher.add(kSchema).add(build);
  for (const auto& [name, version] : solver_versions()) {
    hasher.add(name).add(version);
  }
  return hasher;
}

Digest key_of_answers(const Options& options, const Digest& build) {
  Hasher hasher = tool(build);
  hasher.add("answer").add(options.command);
  for (const auto& [name, value] : options.given) {
    if (!is_one_of(name, kOnlyShown)) hasher.add(name).add(value);
  }
  return hasher.finish();
}

Digest key_of_proofs(const Options& options, const Digest& build) {
  Hasher hasher = tool(build);
  hasher.add("proofs");
  for (const auto& [name, value] : options.given) {
    if (is_one_of(name, kOnlyShown) || is_one_of(name, kOnlySelect)) continue;
    hasher.add(name).add(value);
  }
  return hasher.finish();
}

}  // namespace

std::string cache_directory(const Options& options) {
  const std::string& wanted = options.cache.empty()
                                  ? from_environment("RUNGPROOF_CACHE")
                                  : options.cache;
  if (wanted == "off") return {};
  return wanted == "on" ? users_directory() : wanted;
}

AnswerCache::AnswerCache(const Options& options, ResultStore store,
                         const Digest& build)
    : store_(std::move(store)),
      answers_(key_of_answers(options, build)),
      proofs_(key_of_proofs(options, build)) {}

AnswerCache::~AnswerCache() {
  if (has_written_) store_.trim();
}

std::variant<std::unique_ptr<AnswerCache>, std::string> AnswerCache::open(
    const Options& options) {
  std::string directory = cache_directory(options);
  if (directory.empty() || !may_be_kept(options)) {
    return std::unique_ptr<AnswerCache>();
  }
  ResultStore store(std::move(directory));
  const auto refused = [&](const std::string& why) {
    return fmt::format("--cache {}: {}", store.directory().string(), why);
  };
  if (const auto error = store.open()) return refused(*error);
  const std::optional<Digest> build = build_identity();
  if (!build) {
    return refused("this build of rungproof has no build id to tell it by");
  }
  return std::unique_ptr<AnswerCache>(
      new AnswerCache(options, std::move(store), *build));
}

AnswerCache::Question AnswerCache::question(const SourceSet& sources,
                                            const FileReport& loaded,
                                            FileId properties,
                                            std::string_view preset,
                                            const Options& options) const {
  Hasher hasher;
  hasher.add(answers_).add(preset).add(settings_text(options));
  hasher.add(loaded.language).add(loaded.dialect).add(loaded.semantics);
  hasher.add(sources[loaded.file].text());
  hasher.add(properties.has_value() ? sources[properties].text() : "");
  return {hasher.finish(), {loaded.file, properties}, loaded.notes.size()};
}

bool AnswerCache::find(const Question& question, FileReport& report) {
  const std::optional<std::string> bytes = store_.find(question.key);
  return bytes && unpack_answer(*bytes, question.files, texts_, report);
}

void AnswerCache::keep(const Question& question, const FileReport& report) {
  const std::optional<std::string> bytes =
      pack_answer(report, question.first_note, question.files);
  if (!bytes) return;
  write(question.key, *bytes);
}

VerifyReport AnswerCache::verify(const FileReport& report,
                                 std::string_view preset,
                                 const Options& settings,
                                 const VerifyOptions& options) {
  const Program& program = *report.program;
  std::error_code error;
  const fs::path path = fs::absolute(report.path, error);
  if (report.path == "-" || error) {
    return rung::verify(program, report.properties, options);
  }
  Hasher hasher;
  hasher.add(proofs_).add(preset).add(settings_text(settings));
  hasher.add(path.lexically_normal().string());
  hasher.add(report.language).add(report.dialect).add(report.semantics);
  const Digest key = hasher.finish();
  const std::string before = store_.find(key).value_or("");
  std::string known = before;
  KnownProofs proofs =
      verify_unknown(program, report.properties, options, known);
  if (known != before) write(key, known);
  return std::move(proofs.report);
}

void AnswerCache::write(const Digest& key, std::string_view bytes) {
  const std::optional<std::string> error = store_.keep(key, bytes);
  const std::lock_guard<std::mutex> lock(mutex_);
  has_written_ = true;
  if (error) failure_ = *error;
}

std::string AnswerCache::failure() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return failure_;
}

}  // namespace rung
