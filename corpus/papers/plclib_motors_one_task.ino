// plclib_motors.ino with the second task's calls at the end of loop(): nothing
// preempts anything, and what its text says can be asked of the calls alone.
// Source: PLC on an Arduino Due with plcLib and ARTe, 2018, figure 4.11.
//@ inputs stable
//
//@ starts: always X0 && !X1 -> Y0
//@ expect starts proved
//@ only-start: Y0 only after X0
//@ expect only-start proved
//@ stops: always X1 -> !Y0 && !Y1 && !Y2
//@ expect stops proved
// "The main motor (Y2) will be started after a 10 sec delay"
//@ main-waits: always Y2 && !prev(Y2) -> T0.elapsed > 10000
//@ expect main-waits proved
// "and then the auxiliary motor (Y1) after a 5 sec delay": 15 s after Y2, for
// T1 does not begin to run before Y2 is on.
//@ auxiliary-in-5-s: Y2 for 5500 ms implies Y1
//@ expect auxiliary-in-5-s violated
//@ auxiliary-waits: always Y1 && !prev(Y1) -> T1.elapsed > 15000
//@ expect auxiliary-waits proved
// "the oil pump motor (Y3) is activated for 3 sec": counted from the release of
// X2, not from its press.
//@ oil-for-3-s: never Y3 && T2.elapsed > 3000
//@ expect oil-for-3-s proved
//@ main-with-oil: always Y3 -> Y4
//@ expect main-with-oil proved
//@ main-ends: never Y4 && !Y3 && T3.elapsed > 5000
//@ expect main-ends proved
#include <plcLib.h>

unsigned long T0=0;
unsigned long T1=0;
unsigned long T2=0;
unsigned long T3=0;
void setup() {
    setupPLC();
}

void loop() {
    load(X0);
    set(Y0);
    timerDelay(T0,10000);
    set(Y2);
    timerDelay(T1,15000);
    set(Y1);

    load(X1);
    reset(Y0);
    reset(Y1);
    reset(Y2);

    load(X2);
    timerOn(T2,3000);
    out(Y3);
    timerOn(T3,5000);
    out(Y4);
}
