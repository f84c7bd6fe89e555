#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "app/text_pool.h"
#include "reports/report.h"

namespace rung {

/// The files that places in an answer are in: the program's, and that of the
/// `--props` lines (no value: there are none).
struct AnswerFiles {
  FileId program;
  FileId properties;
};

/// What lint rules and engines said of one program, its notes from the
/// `first_note`-th on, as bytes. Everything that a report shows is in them, and
/// nothing that only the engines use: obligations lose their terms.
/// Nothing where an answer cannot be kept so: it has a place in another file,
/// or a part that is no value of its own (a repair is a program).
std::optional<std::string> pack_answer(const FileReport& report,
                                       std::size_t first_note,
                                       const AnswerFiles& files);

/// Puts the answer into a report of the same program, as it was loaded. False,
/// and the report is as it was: these bytes are none. Texts of the answer live
/// as long as `texts`.
bool unpack_answer(std::string_view bytes, const AnswerFiles& files,
                   TextPool& texts, FileReport& report);

}  // namespace rung
