#include <fmt/format.h>

#include "app/link_client.h"

namespace rung {

// Section 5 of docs/postfix.md; 64 and 65 are the controller's own.
std::string refusal_words(std::uint8_t refusal) {
  using rungproof::Refusal;
  switch (static_cast<Refusal>(refusal)) {
    case Refusal::None:
      break;
    case Refusal::TooShort:
      return "it is shorter than a header";
    case Refusal::BadMagic:
      return "it is no program in the postfix format";
    case Refusal::BadVersion:
      return "the board does not know this version of the postfix format";
    case Refusal::BadLength:
      return "its length is not the one that its header says";
    case Refusal::BadChecksum:
      return "its checksum is wrong";
    case Refusal::BadHeader:
      return "its header has an unknown flag or no scan interval";
    case Refusal::BadSections:
      return "its sections do not fill it";
    case Refusal::BadCell:
      return "a cell's attribute or range is wrong";
    case Refusal::BadSlot:
      return "the board does not know an element of it";
    case Refusal::BadName:
      return "a name is wrong";
    case Refusal::BadNote:
      return "a property line is wrong";
    case Refusal::BadOpcode:
      return "the board does not know an instruction of it";
    case Refusal::BadEnd:
      return "its code does not end where it should";
    case Refusal::NotShortest:
      return "an operand does not have its shortest form";
    case Refusal::BadAddress:
      return "there is no such cell";
    case Refusal::BadElement:
      return "there is no such element";
    case Refusal::WritesInput:
      return "a rung writes an input";
    case Refusal::StackUnderflow:
      return "an operand is missing";
    case Refusal::StackNotEmpty:
      return "a rung leaves a value behind";
    case Refusal::BadSkip:
      return "a skip leaves its rung or lands where it may not";
    case Refusal::StrictSkip:
      return "a skip in a program of strict evaluation";
    case Refusal::BadDivisor:
      return "a divisor is no constant other than 0";
    case Refusal::WrongDepth:
      return "it claims another stack depth than it needs";
    case Refusal::NoMemory:
      return "it needs more memory than the board has for its image";
    case Refusal::NoPin:
      return "an input or output is on no pin of the board";
    case Refusal::PinTaken:
      return "an output is on a pin that is taken";
  }
  return fmt::format("for reason {}, which this program does not know",
                     refusal);
}

std::string fault_words(std::uint8_t fault) {
  using rungproof::Fault;
  switch (static_cast<Fault>(fault)) {
    case Fault::None:
      return "no fault";
    case Fault::Overflow:
      return "a word or a counter would leave 32 bits";
    case Fault::Range:
      return "a word would leave its declared range";
  }
  return fmt::format("fault {}", fault);
}

}  // namespace rung
