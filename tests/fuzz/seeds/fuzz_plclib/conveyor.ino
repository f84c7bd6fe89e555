// The single-task program: boxes, apples, and two counters.
// Source: PLC on an Arduino Due with plcLib and ARTe, 2018, figure 4.8, as it
// is printed (`cur1` and `pre1` are `curl` and `prel` there).
// What its text says, and the program does not, is in docs/languages/plclib.md.
//@ inputs stable
//
// "By pushing START key (X0) motor of a conveyor for boxes is activated (Y0)"
//@ starts: always X0 && !X1 && !X3 && !prev(Y1) -> Y0
//@ expect starts proved
// The conveyors never run together.
//@ one-conveyor: never Y0 && Y1
//@ expect one-conveyor proved
// "until STOP key (X3) is pressed": it stops the boxes, and not the apples.
//@ stop-boxes: always X3 -> !Y0
//@ expect stop-boxes proved
//@ stop-apples: always X3 -> !Y1
//@ expect stop-apples violated
// "Presence of the box allows counter to count 10 apples": without one, too.
//@ counts-in-a-box: always C0 > prev(C0) -> Y1 || prev(Y1)
//@ expect counts-in-a-box violated
// "Once the box is full ... the motor of the conveyor for apples stops"
//@ full: always C0 == 10 && prev(C0) == 9 -> !Y1
//@ expect full proved
//@ stays-full: always C0 == 10 -> !Y1
//@ expect stays-full violated
// "Operations repeat": nothing clears the counters.
//@ repeats: reach once(C0 == 10) && C0 < 10
//@ expect repeats violated
// "the blue light pulses 5 times (1 sec ON ...)": the last one is one scan long.
//@ last-pulse: always prev(C1) == 5 -> !Y3
//@ expect last-pulse proved
#include <plcLib.h>

unsigned long T1=0;    //variable to hold ON time of m8013
unsigned long T2=0;    //variable to hold OFF time of m8013
int C0=0;              //variable to hold counting procedure for counter 0
int C1=0;              //variable to hold counting procedure for counter 0
int cur=0;             //variable to hold current State of counter 0
int pre=0;             //variable to hold previous State of counter 0
int cur1=0;            //variable to hold current State of counter 1
int pre1=0;            //variable to hold previous State of counter 1

void setup() {
    setupPLC();        // Setup inputs and outputs
    Serial.begin(9600); //start the counter
}

void loop() {

    load(X0); //read start PB
    set(Y0);  // activate motor of a conveyor for boxes

    load(X1); //read sensor for boxes (PB)
    orLogic(Y1); // OR with motor of a conveyor for apples to make it move continuously
    out(Y1);    // activate motor of a conveyor for apples
    reset(Y0);  //stop motor of a conveyor for boxes

    load(X2); //read sensor for apples
    counter(C0,cur,pre,10); //count 10 apples
    out(Y2);  //Output to red LED to see the counting process

    counterState(C0,cur,pre,10); // use state of counter to activate next stage
    m8013(T1,T2);                //pulse 1sec ON, 1 sec OFF
    counter(C1,cur1,pre1,5); //pulse 5 times
    out(Y3);  //Output to blue LED to indicate the the box is full
    set(Y0);  //restart motor of conveyor for boxes
    reset(Y1); //stop motor of conveyor for apples

    load(X3); //read reset PB
    reset(Y0); //reset procedure
}
