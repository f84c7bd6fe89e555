// The controller's end of the wire: programs come in while the old one runs,
// and the image goes out (docs/link.md has the protocol).
//
// Any stream of bytes will do. Nothing waits: bytes are handed over as they
// come, poll() does what is to be done between two scans, and what takes long
// (writing EEPROM) is done a byte at a time.
//
// A program is received into RAM beside the one that runs, verified there as a
// whole, switched to between two scans, and then stored. Whatever is wrong, and
// wherever it ends, a verified program runs.
#ifndef RUNGPROOF_LINK_H
#define RUNGPROOF_LINK_H

#include <stdint.h>

#include "rungproof_frame.h"
#include "rungproof_machine.h"
#include "rungproof_store.h"

namespace rungproof {

const uint8_t kLinkProtocol = 1;

enum class Command : uint8_t {
  Hello = 1,
  Status = 2,
  Begin = 3,
  Data = 4,
  Commit = 5,
  Abort = 6,
  Monitor = 7,
  Read = 8,
};
/// In an answer's command; an answer is never answered.
const uint8_t kAnswerBit = 0x80;
/// The command of what monitor mode sends without being asked.
const uint8_t kImage = 0xc0;

enum class Answer : uint8_t {
  Ack = 0,
  UnknownCommand = 1,
  Malformed = 2,   // the body's size, or an undefined flag
  TooLarge = 3,    // for the memory that programs are received in
  NoUpload = 4,    // nothing was begun, or it was given up
  OutOfOrder = 5,  // data beyond what has come so far
  Incomplete = 6,  // commit before the last byte
  Refused = 7,     // by the verifier: a Refusal and its place follow
  Busy = 8,        // the program runs and is still being stored: ask again
  NotStored = 9,   // the program runs, but its storage did not hold it
};

/// A silent host has gone: uploads and monitor mode end after this time.
const uint32_t kLinkSilenceMs = 10000;

/// Flags of Hello and Status.
const uint8_t kLinkStores = 1;        // there is storage for programs
const uint8_t kLinkReceiving = 2;     // an upload is under way
const uint8_t kLinkStoring = 4;       // the running program is being stored
const uint8_t kLinkStopped = 8;       // a fault has stopped the machine
const uint8_t kLinkOffInterval = 16;  // a scan was outside the interval
const uint8_t kLinkMonitors = 32;

/// What a link works on.
class LinkTarget {
 public:
  /// Verifies the program and runs it from the next scan on; the one before
  /// goes on undisturbed when it is refused. `clear`: outputs go to their safe
  /// values until that scan, else they are held.
  virtual Refusal run(const uint8_t* program, uint32_t length, Space space,
                      bool clear) = 0;
  /// The place that the last refusal speaks of.
  virtual uint32_t refused_at() const = 0;
  virtual const Machine& machine() const = 0;

 protected:
  ~LinkTarget() {}
};

/// What a link is given to work with.
struct LinkMemory {
  const char* board;  // its name, for people
  uint8_t* programs;  // 2 * capacity bytes: one program runs, one comes in
  uint16_t capacity;
  uint32_t memory_words;  // of the machine, for people
  Store* store;           // or null
};

class Link {
 public:
  Link(LinkTarget& target, const LinkMemory& memory);

  /// Runs the newest stored program that the target does not refuse; without
  /// one, `program`, which lies where constants do. The refusal of that.
  Refusal begin(const uint8_t* program, uint32_t length);

  /// Whether receive() takes a byte; not while a request waits for poll().
  bool listening() const { return !request_; }
  void receive(uint8_t byte);
  /// The next byte to be sent, or -1.
  int16_t next() { return writer_.next(); }

  /// Between two scans, with the time: answers, stores, gives up.
  void poll(uint32_t now_ms);
  /// After every scan, with its `dt`: monitor mode sends the image.
  void scanned(uint32_t dt_ms);

  /// poll(), and as many bytes of an Arduino's Serial as there are, each way.
  template <class Port>
  void serve(Port& port, uint32_t now_ms) {
    for (uint8_t i = 0; i != kFrameWire && listening(); ++i) {
      if (port.available() <= 0) break;
      receive(static_cast<uint8_t>(port.read()));
    }
    poll(now_ms);
    while (writer_.busy() && port.availableForWrite() > 0) {
      port.write(static_cast<uint8_t>(next()));
    }
  }

 private:
  enum class State : uint8_t { Idle, Receiving, Storing, NotStored };

  void store_step();
  void answer_request();
  void reply(Answer answer, uint8_t body_size);
  // Each reads the request's body and writes the answer's.
  void hello();
  void status();
  void begin_upload();
  void data();
  void commit();
  void finish_upload();
  void abort();
  void monitor();
  void read();
  uint8_t image_cells(uint8_t* to, uint8_t room);
  uint8_t flags() const;

  const uint8_t* body() const { return reader_.content() + 2; }
  uint8_t body_size() const { return static_cast<uint8_t>(reader_.size() - 2); }
  uint8_t* answer_body() { return writer_.content() + 3; }
  uint8_t* spare() const {
    return memory_.programs + (in_second_ ? 0 : memory_.capacity);
  }
  uint8_t running_byte(uint32_t at) const;
  uint32_t running_checksum() const;
  void now_runs(const uint8_t* program, uint32_t length, Space space);

  LinkTarget& target_;
  LinkMemory memory_;
  FrameReader reader_;
  FrameWriter writer_;
  const uint8_t* running_;
  uint32_t running_length_;
  uint32_t now_;
  uint32_t heard_;     // when the last frame came
  uint32_t checksum_;  // of the upload: what its header says
  uint32_t scans_;
  uint32_t last_dt_;
  uint32_t longest_dt_;
  uint32_t image_cell_;  // where the next frame of the image begins
  uint16_t length_;      // of the upload
  uint16_t received_;
  Space running_space_;
  State state_;
  uint8_t image_number_;
  bool in_second_;  // the second half of memory_.programs is the one that runs
  bool clear_;
  bool request_;
  bool monitoring_;
};

}  // namespace rungproof

#endif
