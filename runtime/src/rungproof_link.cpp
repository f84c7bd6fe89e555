#include "rungproof_link.h"

#include "rungproof_bytes.h"
#include "rungproof_format.h"

namespace rungproof {
namespace {

const uint8_t kFlagClear = 1;
const uint8_t kAnswerHead = 3;  // sequence, command, answer
const uint8_t kImageHead = 16;  // of an image: sequence to number of cells

uint32_t lesser(uint32_t a, uint32_t b) { return a < b ? a : b; }

}  // namespace

Link::Link(LinkTarget& target, const LinkMemory& memory)
    : target_(target),
      memory_(memory),
      reader_(),
      writer_(),
      running_(nullptr),
      running_length_(0),
      now_(0),
      heard_(0),
      checksum_(0),
      scans_(0),
      last_dt_(0),
      longest_dt_(0),
      image_cell_(0),
      length_(0),
      received_(0),
      running_space_(Space::Flash),
      state_(State::Idle),
      image_number_(0),
      in_second_(false),
      clear_(false),
      request_(false),
      monitoring_(false) {}

Refusal Link::begin(const uint8_t* program, uint32_t length) {
  for (uint8_t age = 0; age != 2 && memory_.store != nullptr; ++age) {
    const uint16_t stored =
        memory_.store->load(age, memory_.programs, memory_.capacity);
    if (stored == 0) continue;
    if (target_.run(memory_.programs, stored, Space::Ram, true) ==
        Refusal::None) {
      memory_.store->use(age);
      now_runs(memory_.programs, stored, Space::Ram);
      return Refusal::None;
    }
  }
  const Refusal refusal = target_.run(program, length, Space::Flash, true);
  if (refusal == Refusal::None) now_runs(program, length, Space::Flash);
  return refusal;
}

void Link::now_runs(const uint8_t* program, uint32_t length, Space space) {
  running_ = program;
  running_length_ = length;
  running_space_ = space;
  in_second_ = program == memory_.programs + memory_.capacity;
  scans_ = 0;
  last_dt_ = 0;
  longest_dt_ = 0;
  image_cell_ = 0;
}

uint8_t Link::running_byte(uint32_t at) const {
  return read8(Source(running_, running_space_), static_cast<Offset>(at));
}

uint32_t Link::running_checksum() const {
  if (running_ == nullptr) return 0;
  return read32(Source(running_, running_space_), kAtChecksum);
}

void Link::receive(uint8_t byte) {
  if (request_ || !reader_.put(byte) || reader_.size() < 2) return;
  // An answer comes back where a line echoes: it asks for nothing.
  request_ = (reader_.content()[1] & kAnswerBit) == 0;
}

void Link::poll(uint32_t now_ms) {
  now_ = now_ms;
  if (state_ == State::Storing) store_step();
  if (request_) {
    heard_ = now_;
    if (!writer_.busy()) {
      answer_request();
      request_ = false;
    }
  } else if (now_ - heard_ > kLinkSilenceMs) {
    heard_ = now_;
    monitoring_ = false;
    if (state_ == State::Receiving) state_ = State::Idle;
  }
}

void Link::store_step() {
  const Store::Progress progress = memory_.store->step();
  if (progress == Store::Progress::Done) state_ = State::Idle;
  if (progress == Store::Progress::Failed) state_ = State::NotStored;
}

void Link::reply(Answer answer, uint8_t body_size) {
  uint8_t* const content = writer_.content();
  content[0] = reader_.content()[0];
  content[1] = reader_.content()[1] | kAnswerBit;
  content[2] = static_cast<uint8_t>(answer);
  writer_.send(static_cast<uint8_t>(kAnswerHead + body_size));
}

void Link::answer_request() {
  switch (static_cast<Command>(reader_.content()[1])) {
    case Command::Hello:
      return hello();
    case Command::Status:
      return status();
    case Command::Begin:
      return begin_upload();
    case Command::Data:
      return data();
    case Command::Commit:
      return commit();
    case Command::Abort:
      return abort();
    case Command::Monitor:
      return monitor();
    case Command::Read:
      return read();
  }
  reply(Answer::UnknownCommand, 0);
}

uint8_t Link::flags() const {
  uint8_t flags = 0;
  if (memory_.store != nullptr) flags |= kLinkStores;
  if (state_ == State::Receiving) flags |= kLinkReceiving;
  if (state_ == State::Storing) flags |= kLinkStoring;
  if (target_.machine().fault() != Fault::None) flags |= kLinkStopped;
  if (!target_.machine().interval_held()) flags |= kLinkOffInterval;
  if (monitoring_) flags |= kLinkMonitors;
  return flags;
}

// Its first byte is the protocol in every version of it, whatever the body.
void Link::hello() {
  uint8_t* const to = answer_body();
  uint32_t capacity = memory_.capacity;
  if (memory_.store != nullptr) {
    capacity = lesser(capacity, memory_.store->capacity());
  }
  to[0] = kLinkProtocol;
  to[1] = flags();
  put32(to + 2, capacity);
  put32(to + 6, memory_.memory_words);
  put32(to + 10, running_length_);
  put32(to + 14, running_checksum());
  uint8_t size = 18;
  for (const char* name = memory_.board;
       *name != '\0' && size != kFrameContent - kAnswerHead; ++name) {
    to[size++] = static_cast<uint8_t>(*name);
  }
  reply(Answer::Ack, size);
}

void Link::status() {
  const Machine& machine = target_.machine();
  uint8_t* const to = answer_body();
  to[0] = flags();
  to[1] = static_cast<uint8_t>(machine.fault());
  put32(to + 2, machine.fault_at());
  put32(to + 6, scans_);
  put32(to + 10, last_dt_);
  put32(to + 14, longest_dt_);
  put32(to + 18, running_checksum());
  reply(Answer::Ack, 22);
}

void Link::begin_upload() {
  if (body_size() != 9 || body()[8] > kFlagClear) {
    return reply(Answer::Malformed, 0);
  }
  if (state_ == State::Storing) return reply(Answer::Busy, 0);
  // Whatever was under way has ended, also when this one is not begun.
  state_ = State::Idle;
  const uint32_t length = get32(body());
  if (length > memory_.capacity ||
      (memory_.store != nullptr && length > memory_.store->capacity())) {
    return reply(Answer::TooLarge, 0);
  }
  length_ = static_cast<uint16_t>(length);
  checksum_ = get32(body() + 4);
  clear_ = body()[8] == kFlagClear;
  received_ = 0;
  state_ = State::Receiving;
  reply(Answer::Ack, 0);
}

// Answers how much has come: the host goes on from there. So a frame that
// comes twice does no harm, nor does an answer that is lost.
void Link::data() {
  if (body_size() < 5) return reply(Answer::Malformed, 0);
  if (state_ != State::Receiving) return reply(Answer::NoUpload, 0);
  const uint32_t at = get32(body());
  const uint8_t size = static_cast<uint8_t>(body_size() - 4);
  put32(answer_body(), received_);
  if (at > received_) return reply(Answer::OutOfOrder, 4);
  if (at == received_) {
    if (size > length_ - received_) return reply(Answer::TooLarge, 0);
    uint8_t* const to = spare() + received_;
    for (uint8_t i = 0; i != size; ++i) to[i] = body()[4 + i];
    received_ = static_cast<uint16_t>(received_ + size);
    put32(answer_body(), received_);
  }
  reply(Answer::Ack, 4);
}

// May be asked again, until it is no longer busy: the answer to a commit that
// has succeeded is that its program runs.
void Link::commit() {
  if (body_size() != 4) return reply(Answer::Malformed, 0);
  const uint32_t checksum = get32(body());
  if (state_ == State::Receiving) {
    if (checksum != checksum_) return reply(Answer::NoUpload, 0);
    return finish_upload();
  }
  if (checksum != running_checksum()) return reply(Answer::NoUpload, 0);
  if (state_ == State::Storing) return reply(Answer::Busy, 0);
  reply(state_ == State::NotStored ? Answer::NotStored : Answer::Ack, 0);
}

void Link::finish_upload() {
  if (received_ != length_) return reply(Answer::Incomplete, 0);
  state_ = State::Idle;
  uint8_t* const program = spare();
  // The header's own checksum is the upload's: verifying shows it to be true.
  Refusal refusal = Refusal::BadChecksum;
  uint32_t place = kAtChecksum;
  if (length_ < kHeaderBytes || get32(program + kAtChecksum) == checksum_) {
    refusal = target_.run(program, length_, Space::Ram, clear_);
    place = target_.refused_at();
  }
  if (refusal != Refusal::None) {
    answer_body()[0] = static_cast<uint8_t>(refusal);
    put32(answer_body() + 1, place);
    return reply(Answer::Refused, 5);
  }
  now_runs(program, length_, Space::Ram);
  if (memory_.store == nullptr) return reply(Answer::Ack, 0);
  memory_.store->begin(program, length_);
  state_ = State::Storing;
  reply(Answer::Busy, 0);
}

void Link::abort() {
  if (body_size() != 0) return reply(Answer::Malformed, 0);
  if (state_ == State::Receiving) state_ = State::Idle;
  reply(Answer::Ack, 0);
}

void Link::monitor() {
  if (body_size() != 1 || body()[0] > 1) return reply(Answer::Malformed, 0);
  monitoring_ = body()[0] == 1;
  reply(Answer::Ack, 0);
}

void Link::read() {
  if (body_size() != 4) return reply(Answer::Malformed, 0);
  const uint32_t from = get32(body());
  put32(answer_body(), from);
  uint8_t size = 4;
  for (uint32_t at = from;
       at < running_length_ && size != kFrameContent - kAnswerHead; ++at) {
    answer_body()[size++] = running_byte(at);
  }
  reply(Answer::Ack, size);
}

// A frame takes a part of the image where all of it is too long; each tells
// its scan. No frame is late: where the wire is busy, a scan is left out.
void Link::scanned(uint32_t dt_ms) {
  ++scans_;
  last_dt_ = dt_ms;
  if (dt_ms > longest_dt_) longest_dt_ = dt_ms;
  if (!monitoring_ || request_ || writer_.busy()) return;
  uint8_t* const content = writer_.content();
  content[0] = image_number_++;
  content[1] = kImage;
  put32(content + 2, scans_);
  put32(content + 6, dt_ms);
  put16(content + 10, static_cast<uint16_t>(running_checksum() & 0xffffU));
  put16(content + 12, static_cast<uint16_t>(image_cell_));
  const uint32_t first = image_cell_;
  const uint8_t size =
      image_cells(content + kImageHead, kFrameContent - kImageHead);
  put16(content + 14, static_cast<uint16_t>(image_cell_ - first));
  if (image_cell_ == target_.machine().cell_count()) image_cell_ = 0;
  writer_.send(static_cast<uint8_t>(kImageHead + size));
}

// Bits eight a byte, the first in the lowest; then words of four bytes.
uint8_t Link::image_cells(uint8_t* to, uint8_t room) {
  const Machine& machine = target_.machine();
  uint8_t size = 0;
  uint8_t bit = 8;
  for (; image_cell_ < machine.bit_count(); ++image_cell_) {
    if (bit == 8) {
      if (size == room) return size;
      to[size++] = 0;
      bit = 0;
    }
    if (machine.value(image_cell_) != 0) {
      to[size - 1] = static_cast<uint8_t>(to[size - 1] | (1U << bit));
    }
    ++bit;
  }
  for (; image_cell_ != machine.cell_count() && room - size >= 4;
       ++image_cell_) {
    put32(to + size, static_cast<uint32_t>(machine.value(image_cell_)));
    size = static_cast<uint8_t>(size + 4);
  }
  return size;
}

}  // namespace rungproof
