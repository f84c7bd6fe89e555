#include "backend/plclib/names.h"

#include <string>
#include <string_view>

namespace rung::backend {
namespace {

constexpr std::string_view kWords =
    // C++
    "alignas alignof and and_eq asm auto bitand bitor bool break case catch "
    "char char16_t char32_t class compl const const_cast constexpr continue "
    "decltype default delete do double dynamic_cast else enum explicit export "
    "extern false float for friend goto if inline int long mutable namespace "
    "new noexcept not not_eq nullptr operator or or_eq private protected "
    "public register reinterpret_cast return short signed sizeof static "
    "static_assert static_cast struct switch template this thread_local throw "
    "true try typedef typeid typename union unsigned using virtual void "
    "volatile wchar_t while xor xor_eq "
    // plcLib, the thesis's too
    "Counter Pulse Shift Stack andBit andInv andLogic andNotBit compareGT "
    "compareLT counter counterState customIO in inAnalog inNot latch load "
    "loadInv m8013 noPinDefs orBit orInv orLogic orNotBit out outNot outPWM "
    "reset scanValue serialMonitor set setupPLC timerCycle timerDelay timerOff "
    "timerOn timerPulse xorBit "
    // Arduino's core
    "ARDUINO CHANGE DEFAULT DEG_TO_RAD DISPLAY EULER EXTERNAL F FALLING "
    "HALF_PI "
    "HIGH INPUT INPUT_PULLUP INTERNAL LED_BUILTIN LOW LSBFIRST MISO MOSI "
    "MSBFIRST NOT_A_PIN NOT_A_PORT OUTPUT PI Print Printable RAD_TO_DEG RISING "
    "SCK SCL SDA SERIAL SS Serial Stream String TIMER_A TWO_PI USBDevice WORD "
    "analogRead analogReference analogWrite attachInterrupt bit bitClear "
    "bitRead bitSet bitWrite boolean byte cli clockCyclesPerMicrosecond "
    "constrain degrees delay delayMicroseconds detachInterrupt digitalRead "
    "digitalWrite false highByte init initVariant interrupts loop lowByte main "
    "makeWord map max micros millis min noInterrupts noTone pinMode "
    "portInputRegister pulseIn pulseInLong radians random randomSeed round sei "
    "serialEvent setup setupUSB shiftIn shiftOut sq tone true word yield "
    // the C library
    "NULL abort abs acos asin atan atan2 atexit atof atoi atol bsearch calloc "
    "cbrt ceil clearerr copysign cos cosh div exit exp fabs fclose fdim feof "
    "ferror ffs fflush fgetc fgets floor fma fmax fmin fmod fopen fprintf "
    "fputc fputs fread free frexp fscanf fwrite getc getchar getenv gets hypot "
    "index isalnum isalpha isascii isblank iscntrl isdigit isfinite isgraph "
    "isinf islower isnan isprint ispunct isspace isupper isxdigit itoa labs "
    "ldexp ldiv log log10 lrint lround ltoa malloc memccpy memchr memcmp "
    "memcpy memmem memmove memrchr memset modf perror pow printf putc putchar "
    "puts qsort rand realloc remove rename rewind scanf setbuf setjmp signbit "
    "sin sinh snprintf sprintf sqrt square srand srandom sscanf stderr stdin "
    "stdout strcat strchr strcmp strcpy strlen strlwr strncat strncmp strncpy "
    "strrev strsep strstr strtod strtok strtol strtoul strupr system tan tanh "
    "toascii tolower toupper trunc ungetc utoa vprintf vsprintf";

// Of the registers and their bits, and of pins: what stands before a number.
constexpr std::string_view kStems =
    " A ACBG ACD ACI ACIC ACIE ACIS ACME ACO ACSR ADC ADCH ADCL ADCW ADEN ADIE "
    "ADIF ADPS ADSC ADTS AS ASSR AVR BODS BORF CAL CPHA CPOL CS DD DDA DDB DDC "
    "DDD DDE DDF DDG DDH DDJ DDK DDL DDRA DDRB DDRC DDRD DDRE DDRF DDRG DDRH "
    "DDRJ DDRK DDRL DIDR DOR DORD EEAR EECR EEDR EEPE EEPM EERE EIFR EIND FE "
    "ICES ICF ICIE ICNC ICR IDRD INT INTF ISC IVCE JTD JTRF MPCM MSTR MUX OCDR "
    "PA PB PC PCIE PCIF PD PE PF PG PH PIN PINA PINB PINC PIND PINE PINF PING "
    "PINH PINJ PINK PINL PJ PK PL PORF PORT PORTA PORTB PORTC PORTD PORTE "
    "PORTF PORTG PORTH PORTJ PORTK PORTL PRR PUD REFS RXB RXC RXEN SE SM SMCR "
    "SP SPCR SPDR SPE SPH SPIE SPIF SPL SPR SPSR SRE SREG SRL SRW TCNT TIFR "
    "TOIE TOV TSM TWA TWAM TWAR TWBR TWCR TWD TWDR TWEA TWEN TWIE TWPS TWS "
    "TWSR TWWC TXB TXC TXEN UBRR UCSZ UDR UDRE UPE UPM USBS WCOL WDCE WDE WDIE "
    "WDIF WDP WDRF WGM XH XL XMBK XMM YH YL ZH ZL ";

bool is_macro(std::string_view name) {
  // B0101 is a number.
  const bool binary = name.size() > 1 && name.size() <= 9 && name[0] == 'B' &&
                      name.find_first_not_of("01", 1) == std::string_view::npos;
  if (binary) return true;
  const std::size_t end = name.find_last_not_of("0123456789") + 1;
  const std::string_view stem = name.substr(0, end);
  if (stem.empty() || name == "A") return false;
  return kStems.find(' ' + std::string(stem) + ' ') != std::string_view::npos;
}

}  // namespace

const NameRules& plclib_names() {
  static constexpr NameRules kRules = {
      .reserved = kWords, .ignores_case = false, .is_reserved = is_macro};
  return kRules;
}

}  // namespace rung::backend
