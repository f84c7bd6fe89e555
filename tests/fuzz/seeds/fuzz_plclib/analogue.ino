#include <plcLib.h>
const unsigned int limit = 500;
unsigned int level; int x;
void setup() { setupPLC(); }
void loop() {
  level = inAnalog(X0); compareGT(limit); out(Y0);
  inAnalog(X1); andBit(Y0); xorBit(level); outPWM(Y1);
  x = level / 4 - 3; x++; level = level * 2 + 1;
  //@ always Y0 == (level > 500)
}
