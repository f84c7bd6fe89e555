// The dual-task program: loop1 may run between any two calls of loop, and both
// use the one accumulator.
// Source: PLC on an Arduino Due with plcLib and ARTe, 2018, figure 4.11, as it
// is printed. What its text says, and the program does not, is in
// docs/languages/plclib.md.
//@ inputs stable
//
// "starting the oil pump motor (Y0) immediately when START PB is pressed (X0)"
//@ starts: always X0 && !X1 -> Y0
//@ expect starts violated
// Nothing else starts it: but loop1's accumulator does.
//@ only-start: Y0 only after X0
//@ expect only-start violated
// "stopping all motors immediately when STOP PB (X1) is pressed"
//@ stops: always X1 -> !Y0 && !Y1 && !Y2
//@ expect stops violated
// loop1 is not preempted by loop: what it writes is right.
//@ oil-with-main: always Y3 -> Y4
//@ expect oil-with-main proved
#include <plcLib.h>

unsigned long T0=0; //variable to hold delay time of timer 0
unsigned long T1=0; //variable to hold delay time of timer 1
unsigned long T2=0; //variable to hold active time of timer 2
unsigned long T3=0; //variable to hold active time of timer 3
void setup() {
    setupPLC(); // Setup inputs and outputs
}

// Task 1:Driving 3 Motors Sequentiall with DelayDriving 3 Motors Sequentiall with Delay
void loop() {
    load(X0); //read start PB X0
    set(Y0); //activet Oil Motor
    timerDelay(T0,10000); //wait 10 sec befor activating Main motor
    set(Y2); //activate Main motor
    timerDelay(T1,15000); //wait more 5 sec befor activating Auxiliary Motor
    set(Y1); //activate Auxiliary Motor

    load(X1); //read reset PB X1
    reset(Y0); //Stop Oil Motor
    reset(Y1); //Stop Auxiliary Motor
    reset(Y2); //Stop Main motor
}

// Task 2: Driving 2 Motors Simultaneously for spesific period
void loop1(100) {
    load(X2); //read start PB X2
    timerOn(T2,3000); //keep Oil motor active for 3 sec after input is low
    out(Y3); //activate Oil Motor
    timerOn(T3,5000); //keep Main motor active for 8 sec after input is low
    out(Y4); //activate Main Motor
}
