#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "rungproof_link.h"
#include "tests/link/eeprom.h"

namespace rung {

/// Programs for tests, with inputs `a` and outputs `b`: the names say what is
/// assigned. Strict ones of a single rung.
std::string copy_program();    // b = a
std::string invert_program();  // b = !a

/// A controller on the host: the code of runtime/, in exactly the memory that
/// it is given, so that a sanitizer sees what it touches beyond it.
class EmulatedController : public rungproof::LinkTarget {
 public:
  struct Size {
    std::uint16_t capacity = 256;
    std::uint32_t memory_words = 16;
  };
  /// It runs `program`, or what `eeprom` has; without one nothing is stored.
  EmulatedController(const std::string& program, Eeprom* eeprom, Size size);
  EmulatedController(const std::string& program, Eeprom* eeprom)
      : EmulatedController(program, eeprom, Size()) {}

  rungproof::Refusal run(const std::uint8_t* program, std::uint32_t length,
                         rungproof::Space space, bool clear) override;
  std::uint32_t refused_at() const override { return machine_.refused_at(); }
  const rungproof::Machine& machine() const override { return machine_; }

  rungproof::Link& link() { return link_; }
  rungproof::Refusal started() const { return started_; }

  /// Between two scans, and a scan: `dt` ms later.
  void turn(std::uint32_t dt = 1);
  /// Turns until the link has nothing left to do, and what it said.
  std::string exchange(std::string_view bytes);

  /// What runs, as a whole: accepted by the verifier of the tools as well?
  std::string running() const { return running_; }
  bool runs_verified() const;
  /// The value of `b` after a scan with `a`.
  int output(int input);
  /// Whether the last switch was to clear the outputs.
  bool cleared() const { return cleared_; }
  std::uint32_t now() const { return now_; }

 private:
  std::vector<std::uint8_t> builtin_;
  std::vector<std::uint8_t> places_;
  std::vector<std::uint32_t> memory_;
  std::unique_ptr<rungproof::Store> store_;
  rungproof::Machine machine_;
  std::string running_;
  std::uint32_t now_ = 0;
  bool cleared_ = false;
  bool begun_ = false;
  rungproof::Link link_;
  rungproof::Refusal started_ = rungproof::Refusal::TooShort;
};

/// A frame as it goes over the wire.
std::string frame(std::string_view content);
/// The contents of the frames in `bytes`.
std::vector<std::string> contents(std::string_view bytes);

/// Four bytes, the lowest first.
std::string number(std::uint32_t value);
std::uint32_t number_at(std::string_view bytes, std::size_t at);

std::string request(rungproof::Command command, std::string_view body,
                    char sequence = 1);

/// The requests that upload a program, in order.
std::vector<std::string> upload_requests(const std::string& program,
                                         bool clear = false);

/// An answer's third byte and its body.
struct Reply {
  int answer = -1;  // -1: there was none
  std::string body;
};
Reply ask(EmulatedController& controller, const std::string& request);
/// The last answer of an upload, asked until it is not Busy.
Reply upload(EmulatedController& controller, const std::string& program,
             bool clear = false);

}  // namespace rung
