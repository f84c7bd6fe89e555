#include "app/controller.h"

#include <fmt/format.h>

#include <cstdint>
#include <filesystem>

#include "backend/postfix/cost.h"
#include "backend/postfix/lower.h"
#include "rungproof_controller.h"

namespace rung {
namespace {

constexpr std::uint64_t kCyclesAMillisecond = 16'000;

const std::uint8_t* bytes_of(const std::string& bytes) {
  return reinterpret_cast<const std::uint8_t*>(bytes.data());
}

std::uint32_t length_of(const std::string& bytes) {
  return static_cast<std::uint32_t>(bytes.size());
}

/// What a sketch's controller needs: the machine's memory, and pins.
std::uint32_t memory_words(const std::string& bytes) {
  return rungproof::Controller::memory_words(bytes_of(bytes), length_of(bytes));
}

}  // namespace

LoadedMachine::LoadedMachine(const std::string& program)
    : memory(memory_words(program)) {
  refusal = machine.begin(bytes_of(program), length_of(program), memory.data(),
                          static_cast<std::uint32_t>(memory.size()));
}

std::uint32_t LoadedMachine::memory_words(const std::string& program) {
  return rungproof::Machine::memory_words(bytes_of(program),
                                          length_of(program));
}

std::string controller_header(const std::string& bytes,
                              const Options& options) {
  const bool named = !options.output.empty() && options.output != "-";
  const std::filesystem::path path =
      named ? options.output : options.files.front();
  return postfix_header(bytes, memory_words(bytes), path.stem().string());
}

std::string controller_report(const std::string& bytes) {
  const PostfixCost cost = cost_of_postfix(bytes);
  const std::uint32_t words = memory_words(bytes);
  const auto plural = [](std::size_t count) { return count == 1 ? "" : "s"; };
  std::string text = fmt::format(
      "flash    {} bytes, {} of them code: {} instruction{}\n"
      "memory   {} bytes ({} words)\n"
      "stacks   {} bit{}, {} word{}\n",
      cost.bytes, cost.code_bytes, cost.instructions, plural(cost.instructions),
      4 * words, words, cost.bit_stack, plural(cost.bit_stack), cost.word_stack,
      plural(cost.word_stack));
  text += "longest scan, without reading and writing pins\n";
  for (const char* board : {"uno", "yun"}) {
    text += fmt::format("  {}    {:.3f} ms ({} cycles at 16 MHz)\n", board,
                        static_cast<double>(cost.avr_cycles) /
                            static_cast<double>(kCyclesAMillisecond),
                        cost.avr_cycles);
  }
  text += "  arm    not known: its emulator counts no cycles\n";
  return text;
}

}  // namespace rung
