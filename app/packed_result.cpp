#include "app/packed_result.h"

#include <stdexcept>
#include <utility>

namespace rung {
namespace {

Packed pack(const Certificate& certificate) {
  return {certificate.lemmas,      certificate.checked_by,
          certificate.smtlib_path, certificate.reused,
          certificate.ways,        certificate.k,
          certificate.conditions};
}

Certificate unpack_certificate(const Packed& packed) {
  Certificate certificate;
  packed.at(0).get_to(certificate.lemmas);
  packed.at(1).get_to(certificate.checked_by);
  packed.at(2).get_to(certificate.smtlib_path);
  certificate.reused = packed.at(3).get<bool>();
  packed.at(4).get_to(certificate.ways);
  packed.at(5).get_to(certificate.k);
  packed.at(6).get_to(certificate.conditions);
  return certificate;
}

Packed pack(const Trace& trace) {
  Packed steps = Packed::array();
  for (const Trace::Step& step : trace.steps) {
    steps.push_back(Packed::array(
        {step.scan, step.dt_ms, step.repeat, step.values, step.changes}));
  }
  const Packed loop = trace.loop ? Packed(*trace.loop) : Packed();
  return Packed::array({std::move(steps), loop});
}

Trace unpack_trace(const Packed& packed, std::size_t cells) {
  Trace trace;
  for (const Packed& from : packed.at(0)) {
    Trace::Step& step = trace.steps.emplace_back();
    from.at(0).get_to(step.scan);
    from.at(1).get_to(step.dt_ms);
    from.at(2).get_to(step.repeat);
    from.at(3).get_to(step.values);
    step.changes = from.at(4).get<bool>();
    if (step.values.size() != cells) {
      throw std::out_of_range("a step of another program");
    }
  }
  const Packed& loop = packed.at(1);
  if (!loop.is_null()) trace.loop = loop.get<std::size_t>();
  if (trace.loop && *trace.loop >= trace.steps.size()) {
    throw std::out_of_range("a loop behind the end");
  }
  return trace;
}

}  // namespace

Packed pack_result(const ObligationResult& result) {
  return Packed::array(
      {result.verdict, result.engine, result.scans, result.milliseconds,
       result.reason, result.certificate ? pack(*result.certificate) : Packed(),
       result.trace ? pack(*result.trace) : Packed()});
}

ObligationResult unpack_result(const Packed& packed, std::size_t cells) {
  ObligationResult result;
  result.verdict = unpack_enum(packed.at(0), Verdict::Unknown);
  packed.at(1).get_to(result.engine);
  packed.at(2).get_to(result.scans);
  packed.at(3).get_to(result.milliseconds);
  packed.at(4).get_to(result.reason);
  if (!packed.at(5).is_null()) {
    result.certificate = unpack_certificate(packed.at(5));
  }
  if (!packed.at(6).is_null()) {
    result.trace = unpack_trace(packed.at(6), cells);
  }
  return result;
}

std::string to_bytes(const Packed& packed) {
  std::string bytes;
  Packed::to_cbor(packed, bytes);
  return bytes;
}

Packed from_bytes(std::string_view bytes) {
  constexpr bool kStrict = true;
  constexpr bool kThrows = false;
  Packed packed = Packed::from_cbor(bytes, kStrict, kThrows);
  return packed.is_discarded() ? Packed() : packed;
}

}  // namespace rung
