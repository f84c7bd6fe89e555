// Cortex-M3 as qemu-system-arm -M mps2-an385 has it, bare: the tape lies in
// the external RAM, where qemu puts it; report and end by semihosting.
#include "board.h"

extern "C" {
extern uint32_t data_source[];
extern uint32_t data_begin[];
extern uint32_t data_end[];
extern uint32_t bss_begin[];
extern uint32_t bss_end[];
extern uint32_t stack_top[];
int main();
void reset();
void stop();
}

namespace {

const uint32_t kTape = 0x21000000;
const uint32_t kMemoryWords = 0x40000;
uint32_t machine_memory[kMemoryWords];

// "Semihosting for AArch32 and AArch64", operations.
const uint32_t kOpen = 0x01;
const uint32_t kWrite = 0x05;
const uint32_t kExit = 0x18;
const uint32_t kApplicationExit = 0x20026;
const uint32_t kRunTimeError = 0x20023;

uint32_t semihosting(uint32_t operation, uint32_t argument) {
  register uint32_t r0 __asm__("r0") = operation;
  register uint32_t r1 __asm__("r1") = argument;
  __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
  return r0;
}

uint32_t address(const void* object) {
  return reinterpret_cast<uint32_t>(object);
}

uint32_t console = 0;
char buffer[4096];
uint32_t buffered = 0;

void flush() {
  const uint32_t block[] = {console, address(buffer), buffered};
  semihosting(kWrite, address(block));
  buffered = 0;
}

}  // namespace

namespace board {

const uint8_t* tape() { return reinterpret_cast<const uint8_t*>(kTape); }
uint8_t read(const uint8_t* at) { return *at; }
uint32_t* memory() { return machine_memory; }
uint32_t memory_words() { return kMemoryWords; }

void begin() {
  const uint32_t kWriteText = 4;  // the mode "w"
  const uint32_t block[] = {address(":tt"), kWriteText, 3};
  console = semihosting(kOpen, address(block));
}

void put(char c) {
  buffer[buffered++] = c;
  if (buffered == sizeof buffer) flush();
}

void end() {
  flush();
  semihosting(kExit, kApplicationExit);
}

}  // namespace board

// What the compiler calls by itself. Built with
// -fno-tree-loop-distribute-patterns, or they would call themselves.
extern "C" void* memset(void* to, int value, unsigned size) {
  unsigned char* const bytes = static_cast<unsigned char*>(to);
  for (unsigned i = 0; i != size; ++i) {
    bytes[i] = static_cast<unsigned char>(value);
  }
  return to;
}

extern "C" void* memcpy(void* to, const void* from, unsigned size) {
  unsigned char* const bytes = static_cast<unsigned char*>(to);
  const unsigned char* const source = static_cast<const unsigned char*>(from);
  for (unsigned i = 0; i != size; ++i) bytes[i] = source[i];
  return to;
}

// A fault of the processor: not the end that the host waits for.
void stop() {
  semihosting(kExit, kRunTimeError);
  for (;;) {
  }
}

void reset() {
  const uint32_t* from = data_source;
  for (uint32_t* to = data_begin; to != data_end;) *to++ = *from++;
  for (uint32_t* to = bss_begin; to != bss_end;) *to++ = 0;
  main();
  stop();
}

typedef void (*Handler)();
struct Vectors {
  uint32_t* stack;
  Handler handlers[15];
};
extern "C" const Vectors vectors;
const Vectors vectors __attribute__((section(".vectors"), used)) = {
    stack_top,
    {reset, stop, stop, stop, stop, stop, stop, stop, stop, stop, stop, stop,
     stop, stop, stop}};
