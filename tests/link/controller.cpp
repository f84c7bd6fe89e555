#include "tests/link/controller.h"

#include "frontend/postfix/disassemble.h"
#include "tests/postfix/image.h"

namespace rung {
namespace {

constexpr std::size_t kPiece = 32;

std::uint8_t byte_of(char value) { return static_cast<std::uint8_t>(value); }

}  // namespace

std::string copy_program() { return Image().file(); }

std::string invert_program() {
  Image image;
  image.code = Image::bytes_of({0x03, 0, 0x05, 0x04, 1, 0x00});
  return image.file();
}

EmulatedController::EmulatedController(const std::string& program,
                                       Eeprom* eeprom, Size size)
    : builtin_(program.begin(), program.end()),
      places_(2U * size.capacity),
      memory_(size.memory_words),
      store_(eeprom == nullptr ? nullptr
                               : std::make_unique<rungproof::Store>(*eeprom)),
      link_(*this, {"emulated", places_.data(), size.capacity,
                    size.memory_words, store_.get()}) {
  started_ =
      link_.begin(builtin_.data(), static_cast<std::uint32_t>(builtin_.size()));
}

rungproof::Refusal EmulatedController::run(const std::uint8_t* program,
                                           std::uint32_t length,
                                           rungproof::Space space, bool clear) {
  rungproof::Refusal refusal = rungproof::Refusal::None;
  if (begun_) {
    refusal = machine_.replace(program, length, space);
  } else {
    refusal = machine_.begin(program, length, memory_.data(),
                             static_cast<std::uint32_t>(memory_.size()), space);
  }
  if (refusal != rungproof::Refusal::None) return refusal;
  begun_ = true;
  cleared_ = clear;
  running_.assign(program, program + length);
  return refusal;
}

void EmulatedController::turn(std::uint32_t dt) {
  now_ += dt;
  link_.poll(now_);
  if (machine_.scan(dt)) link_.scanned(dt);
}

std::string EmulatedController::exchange(std::string_view bytes) {
  std::string said;
  std::size_t at = 0;
  do {
    while (at != bytes.size() && link_.listening()) {
      link_.receive(byte_of(bytes[at++]));
    }
    turn();
    for (std::int16_t byte = link_.next(); byte >= 0; byte = link_.next()) {
      said += static_cast<char>(byte);
    }
  } while (at != bytes.size() || !link_.listening());
  return said;
}

bool EmulatedController::runs_verified() const {
  return disassemble_postfix(running_).has_value();
}

int EmulatedController::output(int input) {
  machine_.set(0, input);
  turn();
  return machine_.value(1);
}

std::string frame(std::string_view content) {
  rungproof::FrameWriter writer;
  for (std::size_t i = 0; i < content.size(); ++i) {
    writer.content()[i] = byte_of(content[i]);
  }
  writer.send(static_cast<std::uint8_t>(content.size()));
  std::string bytes;
  for (std::int16_t byte = writer.next(); byte >= 0; byte = writer.next()) {
    bytes += static_cast<char>(byte);
  }
  return bytes;
}

std::vector<std::string> contents(std::string_view bytes) {
  rungproof::FrameReader reader;
  std::vector<std::string> found;
  for (const char byte : bytes) {
    if (!reader.put(byte_of(byte))) continue;
    found.emplace_back(reader.content(), reader.content() + reader.size());
  }
  return found;
}

std::string number(std::uint32_t value) {
  std::uint8_t bytes[4];
  rungproof::put32(bytes, value);
  return {bytes, bytes + 4};
}

std::uint32_t number_at(std::string_view bytes, std::size_t at) {
  const std::string four(bytes.substr(at, 4));
  return rungproof::get32(reinterpret_cast<const std::uint8_t*>(four.data()));
}

std::string request(rungproof::Command command, std::string_view body,
                    char sequence) {
  std::string content(1, sequence);
  content += static_cast<char>(command);
  return frame(content.append(body));
}

std::vector<std::string> upload_requests(const std::string& program,
                                         bool clear) {
  using rungproof::Command;
  const std::string checksum = program.substr(12, 4);
  const auto length = static_cast<std::uint32_t>(program.size());
  std::vector<std::string> all = {
      request(Command::Begin,
              number(length) + checksum + std::string(1, clear ? '\1' : '\0'))};
  for (std::uint32_t at = 0; at < length; at += kPiece) {
    all.push_back(
        request(Command::Data, number(at) + program.substr(at, kPiece)));
  }
  all.push_back(request(Command::Commit, checksum));
  return all;
}

Reply ask(EmulatedController& controller, const std::string& request) {
  Reply reply;
  for (const std::string& content : contents(controller.exchange(request))) {
    if (content.size() < 3 || content[1] == static_cast<char>(0xc0)) continue;
    reply = {byte_of(content[2]), content.substr(3)};
  }
  return reply;
}

Reply upload(EmulatedController& controller, const std::string& program,
             bool clear) {
  constexpr int kMostAsks = 10000;
  Reply reply;
  const std::vector<std::string> requests = upload_requests(program, clear);
  for (const std::string& item : requests) reply = ask(controller, item);
  for (int i = 0; i < kMostAsks; ++i) {
    if (reply.answer != static_cast<int>(rungproof::Answer::Busy)) break;
    reply = ask(controller, requests.back());
  }
  return reply;
}

}  // namespace rung
