#include "app/lock_file.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "reports/json_parts.h"

namespace rung {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSchema = "rungproof.lock/1";

Json json_of(const std::optional<std::int64_t>& value) {
  return value ? Json(*value) : Json();
}

std::optional<std::int64_t> optional_number(const Json& json) {
  if (json.is_null()) return std::nullopt;
  return json.get<std::int64_t>();
}

Json json_of(const LockedProgram& program) {
  Json json;
  json["semantics"] = program.semantics;
  json["scan_ms"] = {program.scan_min_ms, program.scan_max_ms};
  json["slice"] = program.slice;
  json["properties"] = Json::object();
  for (const auto& [text, verdict] : program.verdicts) {
    json["properties"][text] = verdict;
  }
  json["outputs"] = Json::array();
  for (const OutputGroup& group : program.groups) {
    Json one;
    one["outputs"] = group.outputs;
    one["combinations"] = group.combinations;
    json["outputs"].push_back(std::move(one));
  }
  json["not_listed"] = program.not_listed;
  json["responses"] = Json::array();
  for (const LockedResponse& response : program.responses) {
    Json one;
    one["after"] = response.cause;
    one["comes"] = response.response;
    one["within_ms"] = json_of(response.milliseconds);
    one["within_scans"] = json_of(response.scans);
    json["responses"].push_back(std::move(one));
  }
  return json;
}

/// Else `text` is what is wrong.
void require(bool holds, const char* text) {
  if (!holds) throw std::runtime_error(text);
}

void check(const OutputGroup& group) {
  constexpr std::size_t kMost = 6;
  require(!group.outputs.empty() && group.outputs.size() <= kMost,
          "a group has one to six outputs");
  for (const std::string& one : group.combinations) {
    require(one.size() == group.outputs.size() &&
                one.find_first_not_of("01") == std::string::npos,
            "a combination has a 0 or a 1 for each output");
  }
  require(std::is_sorted(group.combinations.begin(), group.combinations.end()),
          "combinations are sorted");
}

void check(const std::optional<std::int64_t>& bound) {
  constexpr std::int64_t kMost = 1'000'000'000'000;
  require(!bound || (*bound >= 0 && *bound <= kMost),
          "a bound is a whole number from 0 on");
}

LockedProgram program_of(const Json& json) {
  LockedProgram program;
  json.at("semantics").get_to(program.semantics);
  json.at("scan_ms").at(0).get_to(program.scan_min_ms);
  json.at("scan_ms").at(1).get_to(program.scan_max_ms);
  json.at("slice").get_to(program.slice);
  for (const auto& [text, verdict] : json.at("properties").items()) {
    program.verdicts[text] = verdict.get<std::string>();
  }
  for (const Json& one : json.at("outputs")) {
    OutputGroup& group = program.groups.emplace_back();
    one.at("outputs").get_to(group.outputs);
    one.at("combinations").get_to(group.combinations);
    check(group);
  }
  json.at("not_listed").get_to(program.not_listed);
  for (const Json& one : json.at("responses")) {
    LockedResponse& response = program.responses.emplace_back();
    one.at("after").get_to(response.cause);
    one.at("comes").get_to(response.response);
    response.milliseconds = optional_number(one.at("within_ms"));
    response.scans = optional_number(one.at("within_scans"));
    check(response.milliseconds);
    check(response.scans);
  }
  return program;
}

}  // namespace

std::string write_lock(const Lock& lock) {
  Json json;
  json["schema"] = kSchema;
  json["programs"] = Json::object();
  for (const auto& [path, program] : lock.programs) {
    json["programs"][path] = json_of(program);
  }
  return dump(json) + "\n";
}

std::variant<Lock, std::string> read_lock(std::string_view text) {
  const Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded()) return "it is not JSON";
  if (!json.is_object() || json.value("schema", "") != kSchema) {
    return "its schema is not " + std::string(kSchema);
  }
  Lock lock;
  try {
    for (const auto& [path, program] : json.at("programs").items()) {
      lock.programs[path] = program_of(program);
    }
  } catch (const std::exception& error) {
    return std::string("it is damaged: ") + error.what();
  }
  std::string again = write_lock(lock);
  while (!again.empty() && again.back() == '\n') again.pop_back();
  while (!text.empty() && text.back() == '\n') text.remove_suffix(1);
  if (again != text) {
    return "it has more in it, or another order, than `rungproof lock` writes";
  }
  return lock;
}

std::string locked_path(const std::string& path, const std::string& lock_path) {
  std::error_code error;
  const fs::path from = fs::absolute(lock_path, error).parent_path();
  const fs::path file = fs::absolute(path, error).lexically_normal();
  const fs::path near = file.lexically_relative(from.lexically_normal());
  return (near.empty() ? file : near).generic_string();
}

}  // namespace rung
