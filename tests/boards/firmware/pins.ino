// A program on a board's pins, as a user's sketch has it. Where a test is to say
// how long each scan takes, the clock is not millis() but in registers that
// nothing else uses; so is a counter of scans. With millis(), they show what it
// said last, and count when a pin is begun and done with: odd in between.
#include <Rungproof.h>

struct Reserved {
  char mark[16];
  uint32_t size;
  // The program behind its length, written here by the test.
  uint8_t tape[8192];
};
const Reserved reserved PROGMEM __attribute__((used)) = {
    {'r', 'u', 'n', 'g', 'p', 'r', 'o', 'o', 'f', ' ', 't', 'a', 'p', 'e', ' ',
     '1'},
    8192,
    {0}};

// Names that are not pins already.
const rungproof::Pin pins[] RUNGPROOF_FLASH = {
    {"I0", 2, 0},  {"I1", 4, 0},  {"I2", 5, 0},  {"I3", 6, 0},
    {"I4", 7, 0},  {"I5", 8, 0},  {"Q0", 3, 0},  {"Q1", 13, 0},
    {"Q2", 12, 0}, {"Q3", 11, 0}, {"Q4", 10, 0}, {"Q5", 9, 0},
};

#ifdef RUNG_REAL_CLOCK
class ShownBoard : public rungproof::ArduinoIo {
 public:
  uint32_t clock_ms() override {
    const uint32_t now = millis();
    GPIOR1 = now;
    return now;
  }
  int32_t read(uint8_t pin, rungproof::Signal signal) override {
    GPIOR2 = GPIOR2 + 1;
    const int32_t value = rungproof::ArduinoIo::read(pin, signal);
    GPIOR2 = GPIOR2 + 1;
    return value;
  }
  void write(uint8_t pin, rungproof::Signal signal, int32_t value) override {
    GPIOR2 = GPIOR2 + 1;
    rungproof::ArduinoIo::write(pin, signal, value);
    GPIOR2 = GPIOR2 + 1;
  }
};

typedef ShownBoard Board;
#else
class ScriptedClock : public rungproof::ArduinoIo {
 public:
  // Written while it is read: twice the same is whole.
  uint32_t clock_ms() override {
    uint16_t now = read();
    for (uint16_t again = read(); again != now; again = read()) now = again;
    clock_ += static_cast<uint16_t>(now - last_);
    last_ = now;
    return clock_;
  }

 private:
  static uint16_t read() { return GPIOR1 | (GPIOR2 << 8); }
  uint32_t clock_ = 0;
  uint16_t last_ = 0;
};

typedef ScriptedClock Board;
#endif

uint32_t memory[200];
Board board;
rungproof::Controller controller;

void setup() {
  const rungproof::Refusal refusal = controller.begin(
      reserved.tape + 4, pgm_read_word(reserved.tape), memory, 200, board,
      rungproof::Wiring(pins, sizeof pins / sizeof pins[0]));
  // 128: ready; above: why not.
  GPIOR0 = 128 + static_cast<uint8_t>(refusal);
}

void loop() {
  if (controller.update()) GPIOR0 = (GPIOR0 + 1) & 127;
}
