#pragma once

#include <string>

#include "reports/report.h"

namespace rung {

/// Schema rungproof.result/1; docs/reports.md describes every key. The order
/// of keys and items is fixed: same input, same bytes, apart from the times.
std::string write_json(const Report& report);

/// The same as one event a line: "start" with the schema, then "file",
/// "finding", "property" and "self-check-failure" in the order of the files,
/// at last "summary".
std::string write_jsonl(const Report& report);

}  // namespace rung
