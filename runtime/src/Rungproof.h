// Rungproof: proved rung programs on a controller. This is the header that a
// sketch includes; docs/controllers.md tells the rest.
#ifndef RUNGPROOF_H
#define RUNGPROOF_H

#include "rungproof_controller.h"
#include "rungproof_live.h"
#include "rungproof_machine.h"

#ifdef __AVR__
#include "rungproof_eeprom.h"
#endif
#ifdef ARDUINO
#include "rungproof_arduino.h"
#endif

#endif
