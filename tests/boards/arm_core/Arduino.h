// What the library and its examples use of an Arduino core, for compiling them
// for a Cortex-M3: Debian has no core for ARM. Nothing is behind it.
#ifndef RUNGPROOF_TEST_ARDUINO_H
#define RUNGPROOF_TEST_ARDUINO_H

#include <stddef.h>
#include <stdint.h>

#define HIGH 1
#define LOW 0
#define INPUT 0
#define OUTPUT 1
#define INPUT_PULLUP 2
#define F(text) text
static const uint8_t A0 = 54;  // of the Due

extern "C" {
uint32_t millis();
void pinMode(uint32_t pin, uint32_t mode);
int digitalRead(uint32_t pin);
void digitalWrite(uint32_t pin, uint32_t level);
uint32_t analogRead(uint32_t pin);
void analogWrite(uint32_t pin, uint32_t value);
}

struct SerialPort {
  void begin(uint32_t baud);
  int available();
  int read();
  int availableForWrite();
  size_t write(uint8_t byte);
  void print(const char* text);
  void println(int number);
};
extern SerialPort Serial;

void setup();
void loop();

#endif
