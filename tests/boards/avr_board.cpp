#include "avr_board.h"

#include <avr_adc.h>
#include <avr_eeprom.h>
#include <avr_ioport.h>
#include <avr_uart.h>
#include <sim_avr.h>
#include <sim_elf.h>

#include <algorithm>
#include <cstdarg>
#include <cstdlib>
#include <deque>
#include <map>
#include <utility>

// libsimavr keeps what it has allocated for a board's lines and an ELF file.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libsimavr\n";
}

namespace rung {
namespace {

// What is between two looks at a deadline; a test sees pins that precisely.
constexpr std::uint64_t kSlice = 256;

void say_nothing(avr_t*, const int, const char*, va_list) {}
// Without this a sleeping controller sleeps on the host, too.
void do_not_wait(avr_t*, avr_cycle_count_t) {}

struct WatchedPin {
  AvrBoard::Pin pin;
  std::string name;
  avr_t* avr = nullptr;
  std::vector<AvrBoard::Change> changes;
};

struct Serial {
  std::string output;
  std::deque<std::uint8_t> input;
  avr_irq_t* to_board = nullptr;
  bool ready = false;

  void feed() {
    while (ready && !input.empty()) {
      const std::uint8_t byte = input.front();
      input.pop_front();
      avr_raise_irq(to_board, byte);
    }
  }
};

void note_change(avr_irq_t*, std::uint32_t value, void* param) {
  auto& watched = *static_cast<WatchedPin*>(param);
  const bool level = (value & 1U) != 0;
  if (!watched.changes.empty() && watched.changes.back().level == level) return;
  watched.changes.push_back({watched.avr->cycle, level});
}

void note_output(avr_irq_t*, std::uint32_t value, void* param) {
  static_cast<Serial*>(param)->output += static_cast<char>(value);
}

void note_ready(avr_irq_t*, std::uint32_t, void* param) {
  static_cast<Serial*>(param)->ready = true;
}

void note_full(avr_irq_t*, std::uint32_t, void* param) {
  static_cast<Serial*>(param)->ready = false;
}

}  // namespace

struct AvrBoard::Impl {
  avr_t* avr = nullptr;
  std::string error;
  Serial serial;
  std::deque<WatchedPin> pins;  // their addresses stay
  std::map<char, avr_ioport_external_t> outside;

  Impl(const std::string& mcu, const std::string& elf_path) {
    avr_global_logger_set(say_nothing);
    elf_firmware_t firmware = {};
    if (elf_read_firmware(elf_path.c_str(), &firmware) != 0) {
      error = "cannot read " + elf_path;
      return;
    }
    avr = avr_make_mcu_by_name(mcu.c_str());
    if (avr == nullptr) {
      error = "libsimavr has no " + mcu;
      return;
    }
    avr_init(avr);
    if (firmware.flashsize > std::size_t{avr->flashend} + 1) {
      error = elf_path + " does not fit into the flash";
      return;
    }
    avr_load_firmware(avr, &firmware);
    avr->frequency = static_cast<std::uint32_t>(kHertz);
    avr->vcc = avr->avcc = avr->aref = 5000;
    avr->sleep = do_not_wait;
    avr->run_cycle_limit = kSlice;
    connect_serial(mcu == "atmega32u4" ? '1' : '0');
  }

  ~Impl() {
    if (avr == nullptr) return;
    avr_terminate(avr);
    std::free(avr);
  }

  void connect_serial(char port) {
    const auto name = static_cast<std::uint32_t>(port);
    std::uint32_t flags = 0;  // no printing, no sleeping while it is polled
    avr_ioctl(avr, AVR_IOCTL_UART_SET_FLAGS(name), &flags);
    const auto irq = [&](int number) {
      return avr_io_getirq(avr, AVR_IOCTL_UART_GETIRQ(name), number);
    };
    serial.to_board = irq(UART_IRQ_INPUT);
    avr_irq_register_notify(irq(UART_IRQ_OUTPUT), note_output, &serial);
    avr_irq_register_notify(irq(UART_IRQ_OUT_XON), note_ready, &serial);
    avr_irq_register_notify(irq(UART_IRQ_OUT_XOFF), note_full, &serial);
  }

  avr_irq_t* irq(Pin pin) const {
    const auto port = static_cast<std::uint32_t>(pin.port);
    return avr_io_getirq(avr, AVR_IOCTL_IOPORT_GETIRQ(port), pin.bit);
  }

  const WatchedPin* find(Pin pin) const {
    for (const WatchedPin& watched : pins) {
      const bool same =
          watched.pin.port == pin.port && watched.pin.bit == pin.bit;
      if (same) return &watched;
    }
    return nullptr;
  }

  State run(std::uint64_t cycles, const std::function<bool()>* stop) {
    const std::uint64_t end = avr->cycle + cycles;
    while (avr->cycle < end) {
      serial.feed();
      // One instruction at a time where every one is looked at.
      avr->run_cycle_limit =
          stop != nullptr ? 1 : std::min(kSlice, end - avr->cycle);
      const int state = avr_run(avr);
      if (state == cpu_Done) return State::Done;
      if (state == cpu_Crashed) return State::Crashed;
      if (stop != nullptr && (*stop)()) break;
    }
    return State::Running;
  }
};

AvrBoard::AvrBoard(const std::string& mcu, const std::string& elf_path)
    : impl_(std::make_unique<Impl>(mcu, elf_path)) {}

AvrBoard::~AvrBoard() = default;

const std::string& AvrBoard::error() const { return impl_->error; }

void AvrBoard::reset() { avr_reset(impl_->avr); }

void AvrBoard::power_cycle() {
  avr_t& avr = *impl_->avr;
  std::uint8_t noise = 0x5a;
  for (std::uint32_t at = avr.ioend + 1U; at <= avr.ramend; ++at) {
    noise = static_cast<std::uint8_t>(noise * 29U + 17U);
    avr.data[at] = noise;
  }
  impl_->serial.input.clear();
  impl_->serial.output.clear();
  avr_reset(&avr);
}

AvrBoard::State AvrBoard::run(std::uint64_t cycles) {
  return impl_->run(cycles, nullptr);
}

AvrBoard::State AvrBoard::run_until(const std::function<bool()>& stop,
                                    std::uint64_t cycles) {
  return impl_->run(cycles, &stop);
}

std::uint64_t AvrBoard::cycle() const { return impl_->avr->cycle; }

std::span<std::uint8_t> AvrBoard::flash() {
  return {impl_->avr->flash, std::size_t{impl_->avr->flashend} + 1};
}

std::span<std::uint8_t> AvrBoard::eeprom() {
  avr_eeprom_desc_t whole = {nullptr, 0, 0};
  avr_ioctl(impl_->avr, AVR_IOCTL_EEPROM_GET, &whole);
  return {whole.ee, std::size_t{impl_->avr->e2end} + 1};
}

std::span<std::uint8_t> AvrBoard::data() {
  return {impl_->avr->data, std::size_t{impl_->avr->ramend} + 1};
}

// What drives a pin is stronger than its pull-up resistor, which libsimavr
// would else take for the level whenever the port is written.
void AvrBoard::drive(Pin pin, bool level) {
  avr_ioport_external_t& outside = impl_->outside[pin.port];
  const unsigned bit = 1U << static_cast<unsigned>(pin.bit);
  outside.name = static_cast<unsigned char>(pin.port) & 0x7fU;
  outside.mask = (outside.mask | bit) & 0xffU;
  outside.value = (level ? outside.value | bit : outside.value & ~bit) & 0xffU;
  avr_ioctl(impl_->avr,
            AVR_IOCTL_IOPORT_SET_EXTERNAL(static_cast<unsigned>(pin.port)),
            &outside);
  avr_raise_irq(impl_->irq(pin), level ? 1 : 0);
}

void AvrBoard::drive_analog(int channel, std::uint32_t millivolts) {
  avr_raise_irq(avr_io_getirq(impl_->avr, AVR_IOCTL_ADC_GETIRQ, channel),
                millivolts);
}

bool AvrBoard::level(Pin pin) {
  avr_ioport_state_t state = {};
  const auto port = static_cast<std::uint32_t>(pin.port);
  avr_ioctl(impl_->avr, AVR_IOCTL_IOPORT_GETSTATE(port), &state);
  return (static_cast<unsigned>(state.port) >> pin.bit & 1U) != 0;
}

void AvrBoard::watch(Pin pin, std::string name) {
  WatchedPin& watched =
      impl_->pins.emplace_back(WatchedPin{pin, std::move(name), {}, {}});
  watched.avr = impl_->avr;
  watched.changes.push_back({cycle(), level(pin)});
  avr_irq_register_notify(impl_->irq(pin), note_change, &watched);
}

const std::vector<AvrBoard::Change>& AvrBoard::changes(Pin pin) const {
  static const std::vector<Change> none;
  const WatchedPin* const watched = impl_->find(pin);
  return watched == nullptr ? none : watched->changes;
}

std::string AvrBoard::waveform() const {
  struct Event {
    std::uint64_t nanoseconds;
    std::string line;
  };
  std::vector<Event> events;
  std::string text = "$timescale 1 ns $end\n$scope module board $end\n";
  char letter = '!';
  for (const WatchedPin& watched : impl_->pins) {
    text +=
        std::string("$var wire 1 ") + letter + ' ' + watched.name + " $end\n";
    for (const Change& change : watched.changes) {
      events.push_back({change.cycle * 125 / 2,
                        std::string(change.level ? "1" : "0") + letter});
    }
    ++letter;
  }
  text += "$upscope $end\n$enddefinitions $end\n";
  std::stable_sort(events.begin(), events.end(),
                   [](const Event& a, const Event& b) {
                     return a.nanoseconds < b.nanoseconds;
                   });
  for (const Event& event : events) {
    text += "#" + std::to_string(event.nanoseconds) + "\n" + event.line + "\n";
  }
  return text;
}

void AvrBoard::send(std::string_view bytes) {
  impl_->serial.input.insert(impl_->serial.input.end(), bytes.begin(),
                             bytes.end());
}

std::string AvrBoard::take_output() {
  return std::exchange(impl_->serial.output, {});
}

}  // namespace rung
