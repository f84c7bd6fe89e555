// Keeps the running program where a power cut does not reach it: two banks,
// one of which is whole at every moment (docs/link.md).
//
// A bank is the sequence number, the length, a CRC-32 over both and the
// program, a mark, the program. Writing clears the mark first and sets it
// last, after everything was read back; a bank counts only with its mark and
// its CRC. So wherever the power goes, the other bank or this one is whole,
// and no mix of both.
#ifndef RUNGPROOF_STORE_H
#define RUNGPROOF_STORE_H

#include <stdint.h>

namespace rungproof {

/// Bytes that outlive a power cut: EEPROM, FRAM, a file.
class Storage {
 public:
  virtual uint16_t size() const = 0;
  virtual uint8_t read(uint16_t at) const = 0;
  /// Whether a write would start at once, and all before it are complete.
  virtual bool ready() const = 0;
  /// Starts a write. Only called when ready().
  virtual void write(uint16_t at, uint8_t byte) = 0;

 protected:
  ~Storage() {}
};

class Store {
 public:
  enum class Progress : uint8_t { Working, Done, Failed };

  explicit Store(Storage& storage);

  /// Bytes of the longest program.
  uint16_t capacity() const;

  /// Copies a whole program to `to` and says its length: the newest for
  /// `age` 0, the one before for 1; 0 when there is none, or none that `size`
  /// bytes hold.
  uint16_t load(uint8_t age, uint8_t* to, uint16_t size);
  /// That program runs: the next one goes into the other bank.
  void use(uint8_t age);

  /// Begins to write; `program` stays as it is until step() has said Done or
  /// Failed. Not above capacity().
  void begin(const uint8_t* program, uint16_t length);
  /// At most one byte is written. Failed: the storage does not hold what was
  /// written, and what it had before is what counts.
  Progress step();

 private:
  enum class Phase : uint8_t { Idle, Unmark, Write, Verify, Mark, Marked };
  static const uint8_t kNoBank = 2;
  static const uint8_t kHeader = 10;  // in front of the mark

  uint16_t bank_start(uint8_t bank) const;
  void read_header(uint8_t bank, uint8_t* header) const;
  bool whole(uint8_t bank) const;
  void find();
  void forget(uint8_t bank);
  uint8_t wanted(uint16_t at) const;
  void write_next(uint16_t start);
  Progress fail();

  Storage& storage_;
  const uint8_t* program_;
  uint16_t length_;
  uint16_t at_;
  uint32_t sequence_;  // of the newest
  uint8_t header_[kHeader];
  uint8_t banks_[2];  // by age, once they were found
  uint8_t active_;    // the bank whose program runs
  uint8_t target_;    // the bank that is written
  Phase phase_;
  bool found_;
};

}  // namespace rungproof

#endif
