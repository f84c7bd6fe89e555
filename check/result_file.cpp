#include "check/result_file.h"

#include <nlohmann/json.hpp>
#include <unordered_set>

namespace rung::check {
namespace {

using Json = nlohmann::json;

/// Deeper induction is not what anyone proves with, and a text a scan long
/// for each is not what a solver is to be given.
constexpr std::uint64_t kDeepest = 64;

struct BadResult {
  std::string what;
};

const Json& member(const Json& object, const char* name) {
  if (!object.is_object() || !object.contains(name)) {
    throw BadResult{std::string("it has no `") + name + "`"};
  }
  return object.at(name);
}

std::string text_of(const Json& object, const char* name) {
  const Json& value = member(object, name);
  if (!value.is_string()) {
    throw BadResult{std::string("`") + name + "` is no text"};
  }
  return value.get<std::string>();
}

const Json& list_of(const Json& object, const char* name) {
  const Json& value = member(object, name);
  if (!value.is_array()) {
    throw BadResult{std::string("`") + name + "` is no list"};
  }
  return value;
}

std::vector<std::string> texts_of(const Json& object, const char* name) {
  std::vector<std::string> texts;
  for (const Json& one : list_of(object, name)) {
    if (!one.is_string()) {
      throw BadResult{std::string("`") + name + "` is no list of texts"};
    }
    texts.push_back(one.get<std::string>());
  }
  return texts;
}

std::int64_t number_of(const Json& value) {
  if (!value.is_number_integer()) throw BadResult{"a number is none"};
  return value.get<std::int64_t>();
}

void read_certificate(const Json& json, ClaimedProperty& property) {
  property.has_certificate = true;
  const std::int64_t k = number_of(member(json, "k"));
  if (k < 0 || static_cast<std::uint64_t>(k) > kDeepest) {
    throw BadResult{"`k` is out of range"};
  }
  property.k = static_cast<std::uint32_t>(k);
  property.lemmas = texts_of(json, "lemmas");
  if (json.contains("conditions")) {
    property.conditions = texts_of(json, "conditions");
  }
  if (json.contains("ways")) property.ways = texts_of(json, "ways");
}

ClaimedProperty read_property(const Json& json) {
  ClaimedProperty property;
  property.name = text_of(json, "name");
  property.kind = text_of(json, "kind");
  property.text = text_of(json, "text");
  property.goal = text_of(json, "goal");
  property.verdict = text_of(json, "verdict");
  const Json& certificate = member(json, "certificate");
  if (!certificate.is_null()) read_certificate(certificate, property);
  return property;
}

void read_file(const Json& json, ClaimedResult& result) {
  result.language = text_of(json, "language");
  result.dialect = text_of(json, "dialect");
  result.semantics = text_of(json, "semantics");
  const Json& scan = list_of(json, "scan_ms");
  if (scan.size() != 2) throw BadResult{"`scan_ms` is no interval"};
  result.scan_min_ms = number_of(scan[0]);
  result.scan_max_ms = number_of(scan[1]);
}

/// An output is a property: that it is the same in both programs.
void read_equivalence(const Json& json, ClaimedResult& result) {
  result.is_equivalence = true;
  result.is_settled =
      json.contains("settled") && json.at("settled") != Json(false);
  const std::int64_t delay = number_of(member(json, "delay"));
  if (delay < 0 || static_cast<std::uint64_t>(delay) > kDeepest) {
    throw BadResult{"`delay` is out of range"};
  }
  result.delay = static_cast<std::uint32_t>(delay);
  ClaimedProperty property;
  property.kind = "equiv";
  property.goal = "invariant";
  const std::string verdict = text_of(json, "verdict");
  property.verdict = verdict == "equivalent"  ? "proved"
                     : verdict == "different" ? "violated"
                                              : verdict;
  const Json& certificate = member(json, "certificate");
  if (!certificate.is_null()) read_certificate(certificate, property);
  for (const std::string& name : texts_of(json, "outputs")) {
    property.name = name;
    result.properties.push_back(property);
  }
}

void read_whole(const Json& json, ClaimedResult& result) {
  const std::string schema = text_of(json, "schema");
  if (schema == "rungproof.equiv/1") return read_equivalence(json, result);
  if (schema != "rungproof.result/1") {
    throw BadResult{"its schema is not `rungproof.result/1`"};
  }
  const Json& files = list_of(json, "files");
  if (files.size() != 1) {
    throw BadResult{"it is about " + std::to_string(files.size()) +
                    " files: check them one by one"};
  }
  read_file(files[0], result);
  std::unordered_set<std::string> names;
  for (const Json& one : list_of(json, "properties")) {
    result.properties.push_back(read_property(one));
    const std::string& name = result.properties.back().name;
    if (!names.insert(name).second) {
      throw BadResult{"two properties are called `" + name + "`"};
    }
  }
}

}  // namespace

ClaimedResult read_result(std::string_view text) {
  ClaimedResult result;
  const Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded()) {
    result.error = "it is no JSON";
    return result;
  }
  try {
    read_whole(json, result);
  } catch (const BadResult& bad) {
    result.error = bad.what;
  } catch (const Json::exception& bad) {
    result.error = bad.what();
  }
  return result;
}

}  // namespace rung::check
