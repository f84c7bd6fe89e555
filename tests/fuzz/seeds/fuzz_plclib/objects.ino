#define noPinDefs
#include <plcLib.h>
#define led out1
int in1 = A0, out1 = 7;
unsigned int a = 1, b;
unsigned long T1, T2;
Counter c(3, 1);
Shift s(0x8001);
Stack st;
Pulse p;
void customIO() { pinMode(in1, INPUT); pinMode(led, OUTPUT); }
void setup() { customIO(); b = a + 2; }
void half() { in(a); p.inClock(); p.rising(); }
void loop() {
  half();
  c.countUp(); c.countDown(); c.preset(); c.clear(); c.upperQ();
  st.push(); in(in1); st.andBlock(); timerCycle(T1, 100, T2, 200);
  s.inputBit(); s.shiftLeft(); s.bitValue(3); s.reset();
  if (a == 1 && !digitalRead(in1)) { out(led); } else b = c.count() > 2 ? 1 : 0;
  for (int i = 0; i < 3; i++) { b += i; b = b % 5; }
}
