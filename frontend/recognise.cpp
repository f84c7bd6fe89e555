#include "frontend/recognise.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "frontend/ascii/reader.h"
#include "frontend/il_iec/reader.h"
#include "frontend/il_mitsubishi/reader.h"
#include "frontend/ldmicro/reader.h"
#include "frontend/plclib/reader.h"
#include "frontend/plcopen/reader.h"
#include "frontend/postfix/reader.h"
#include "frontend/rockwell/reader.h"
#include "frontend/script/reader.h"
#include "frontend/st/reader.h"
#include "frontend/stl/reader.h"

namespace rung {
namespace {

constexpr std::string_view kBlanks = " \t\r\n\f";

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) + 1 - begin);
}

/// Calls `visit(line)` for each line, until it returns true.
template <class Visit>
bool any_line(std::string_view text, Visit visit) {
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = text.find_first_of("\r\n", at);
    if (end == std::string_view::npos) end = text.size();
    if (visit(trimmed(text.substr(at, end - at)))) return true;
    at = end + 1;
  }
  return false;
}

/// The same for the lines with `word`, which are few.
template <class Visit>
bool any_line_with(std::string_view text, std::string_view word, Visit visit) {
  for (std::size_t at = 0; (at = text.find(word, at)) != text.npos;) {
    std::size_t begin = text.find_last_of("\r\n", at);
    begin = begin == text.npos ? 0 : begin + 1;
    const std::size_t end =
        std::min(text.find_first_of("\r\n", at), text.size());
    if (visit(trimmed(text.substr(begin, end - begin)))) return true;
    at = end;
  }
  return false;
}

/// The first line that is neither empty nor a comment.
std::string_view first_line(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  std::string_view found;
  any_line(text, [&](std::string_view line) {
    if (line.empty() || line.starts_with("//")) return false;
    found = line;
    return true;
  });
  return found;
}

/// `line` begins with `word` as a statement: `TYPE = I0;` of a script does not.
bool starts_word(std::string_view line, std::string_view word) {
  if (!line.starts_with(word)) return false;
  const std::string_view rest = line.substr(word.size());
  if (rest.empty()) return true;
  return kBlanks.find(rest.front()) != std::string_view::npos &&
         !trimmed(rest).starts_with("=");
}

bool is_ldmicro(std::string_view text) {
  const std::string_view line = first_line(text);
  return line.starts_with("LDmicro0.") || line == "LDmicro";
}

bool is_plclib(std::string_view text) {
  // A tab of a sketch has no #include.
  const std::string_view first = first_line(text);
  if (starts_word(first, "void") && first.find('(') != first.npos) return true;
  return any_line_with(text, "#include", [](std::string_view line) {
    return line.starts_with("#include") &&
           line.find("plcLib") != std::string_view::npos;
  });
}

// Files that no reader takes. What is in them may look like another language:
// the networks of a project, say.

bool is_classicladder(std::string_view text) {
  return text.starts_with("_FILES_CLASSICLADDER");
}

bool is_vovkplc(std::string_view text) {
  return first_line(text).starts_with("VOVKPLCPROJECT");
}

/// `let a: u8 @ M0 = 1;` or `function f(): u8 {`.
bool is_plcscript(std::string_view text) {
  const std::string_view line = first_line(text);
  return (starts_word(line, "let") && line.find(':') != line.npos) ||
         (starts_word(line, "function") && line.ends_with('{'));
}

bool is_json(std::string_view text) {
  text = trimmed(text);
  if (!text.starts_with('{')) return false;
  text = trimmed(text.substr(1));
  return text.starts_with('"') || text.starts_with('}');
}

bool is_script(std::string_view) { return true; }

using Names = std::string_view;
constexpr std::array<Names, 2> kScriptPresets = {"yun", "sim"};
constexpr std::array<Names, 4> kIecPresets = {"iec", "openplc", "beremiz-py2",
                                              "esbmc"};
constexpr std::array<Names, 1> kMelsecPresets = {"melsec"};
constexpr std::array<Names, 1> kS7Presets = {"s7"};
constexpr std::array<Names, 4> kDrawingPresets = {"openplc", "beremiz-py2",
                                                  "esbmc", "iec"};
constexpr std::array<Names, 1> kLogixPresets = {"logix"};
constexpr std::array<Names, 1> kAsciiPresets = {"ladder-logic"};
constexpr std::array<Names, 2> kLdmicroPresets = {"ldmicro0.1", "ldmicro0.2"};
constexpr std::array<Names, 2> kPlclibPresets = {"plclib14", "plclib"};

Ast postfix_reader(const SourceSet& sources, FileId file,
                   const ReadOptions& /*options*/, DiagnosticSink& sink) {
  return read_postfix(sources, file, sink);
}

Ast il_mitsubishi_reader(const SourceSet& sources, FileId file,
                         const ReadOptions& /*options*/, DiagnosticSink& sink) {
  return read_il_mitsubishi(sources, file, sink);
}

Ast stl_reader(const SourceSet& sources, FileId file,
               const ReadOptions& /*options*/, DiagnosticSink& sink) {
  return read_stl(sources, file, sink);
}

Ast script_reader(const SourceSet& sources, FileId file,
                  const ReadOptions& options, DiagnosticSink& sink) {
  return read_script(sources, file, options.dialect, sink);
}

constexpr std::array kLanguages = {
    Language{"classicladder",
             {},
             is_classicladder,
             nullptr,
             "ClassicLadder projects"},
    Language{"vovkplc", {}, is_vovkplc, nullptr, "VovkPLC projects"},
    Language{"plcscript", {}, is_plcscript, nullptr, "scripts of VovkPLC"},
    Language{"json", {}, is_json, nullptr, "JSON files"},
    Language{"postfix", kScriptPresets, is_postfix, postfix_reader},
    Language{"ldmicro", kLdmicroPresets, is_ldmicro, read_ldmicro},
    Language{"l5x", kLogixPresets, is_l5x, read_l5x},
    Language{"plcopen", kDrawingPresets, is_plcopen, read_plcopen},
    Language{"plclib", kPlclibPresets, is_plclib, read_plclib},
    Language{"il-mitsubishi", kMelsecPresets, is_il_mitsubishi,
             il_mitsubishi_reader},
    Language{"stl", kS7Presets, is_stl, stl_reader},
    Language{"rungs", kLogixPresets, is_rungs_text, read_rungs_text},
    Language{"il-iec", kIecPresets, is_il_iec, read_il_iec},
    Language{"st", kIecPresets, is_structured_text, read_structured_text},
    Language{"ascii", kAsciiPresets, is_ascii_ladder, read_ascii},
    Language{"script", kScriptPresets, is_script, script_reader},
};

}  // namespace

bool Language::has_preset(std::string_view preset) const {
  return std::find(presets.begin(), presets.end(), preset) != presets.end();
}

std::span<const Language> languages() { return kLanguages; }

const Language* find_language(std::string_view name) {
  for (const Language& language : kLanguages) {
    if (language.name == name) return &language;
  }
  return nullptr;
}

std::string_view declared_language(std::string_view text) {
  std::string_view found;
  any_line_with(text, "language", [&](std::string_view line) {
    const std::size_t mark = line.starts_with(";@") ? 2 : 3;
    if (mark == 3 && !line.starts_with("//@") && !line.starts_with("(*@")) {
      return false;
    }
    line = trimmed(line.substr(mark));
    if (!starts_word(line, "language")) return false;
    line = trimmed(line.substr(8));
    if (line.ends_with("*)")) line = trimmed(line.substr(0, line.size() - 2));
    found = line;
    return true;
  });
  return found;
}

const Language& recognise(std::string_view text) {
  for (const Language& language : kLanguages) {
    if (language.looks_so(text)) return language;
  }
  return kLanguages.back();
}

}  // namespace rung
