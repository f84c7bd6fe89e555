// What the published plcLib, version 1.4, and Arduino's core declare of what
// written sketches use: enough for a compiler to look at them.
#pragma once

const int A0 = 14, A1 = 15, A2 = 16, A3 = 17, A4 = 18, A5 = 19, A6 = 20,
          A7 = 21;
enum { LOW, HIGH };
enum { INPUT, OUTPUT };

void pinMode(unsigned char pin, unsigned char mode);
void digitalWrite(unsigned char pin, unsigned char value);
int digitalRead(unsigned char pin);
int analogRead(unsigned char pin);

// An `int` is the number of a pin, anything unsigned a variable.
unsigned int in(int pin);
unsigned int in(unsigned int variable);
unsigned int in(unsigned long variable);
unsigned int inNot(int pin);
unsigned int inNot(unsigned int variable);
unsigned int inNot(unsigned long variable);
unsigned int inAnalog(int pin);
unsigned int andBit(int pin);
unsigned int andBit(unsigned int variable);
unsigned int andBit(unsigned long variable);
unsigned int andNotBit(int pin);
unsigned int andNotBit(unsigned int variable);
unsigned int andNotBit(unsigned long variable);
unsigned int orBit(int pin);
unsigned int orBit(unsigned int variable);
unsigned int orBit(unsigned long variable);
unsigned int orNotBit(int pin);
unsigned int orNotBit(unsigned int variable);
unsigned int orNotBit(unsigned long variable);
unsigned int out(int pin);
unsigned int out(unsigned int& variable);
unsigned int out(unsigned long& variable);
unsigned int timerOn(unsigned long& timer, unsigned long period);
unsigned int timerOff(unsigned long& timer, unsigned long period);
unsigned int timerPulse(unsigned long& timer, unsigned long period);

class Stack {
 public:
  void push();
  void pop();
  void orBlock();
  void andBlock();
};
