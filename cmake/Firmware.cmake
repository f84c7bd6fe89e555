# Firmware for controllers, by the cross compilers that Debian has. Where one is
# missing nothing of its board is built or tested, and configuring says so;
# with RUNG_REQUIRE_BOARDS, as .ci/run has it, that is an error.
option(RUNG_REQUIRE_BOARDS "Fail where a cross compiler or emulator is missing"
  OFF)
find_program(RUNG_AVR_CXX avr-g++)
find_program(RUNG_ARM_CXX arm-none-eabi-g++)
find_program(RUNG_SIMAVR simavr)
find_program(RUNG_QEMU_ARM qemu-system-arm)
find_path(RUNG_ARDUINO_CORE cores/arduino/Arduino.h
  PATHS /usr/share/arduino/hardware/arduino/avr)

set(rung_missing_tools)
foreach(tool RUNG_AVR_CXX RUNG_ARM_CXX RUNG_SIMAVR RUNG_QEMU_ARM
    RUNG_ARDUINO_CORE)
  if(NOT ${tool})
    list(APPEND rung_missing_tools ${tool})
  endif()
endforeach()
if(rung_missing_tools)
  set(level STATUS)
  if(RUNG_REQUIRE_BOARDS)
    set(level FATAL_ERROR)
  endif()
  message(${level} "Boards are left out, firmware and tests, for want of: "
    "${rung_missing_tools} (scripts/deps installs them)")
endif()

set(firmware_dir ${PROJECT_SOURCE_DIR}/boards/firmware)
set(runtime_dir ${PROJECT_SOURCE_DIR}/runtime/src)
set(machine_sources)
foreach(part bytes elements format layout machine run verifier words)
  list(APPEND machine_sources ${runtime_dir}/rungproof_${part}.cpp)
endforeach()
set(firmware_warnings -Wall -Wextra $<$<BOOL:${RUNG_WERROR}>:-Werror>)
file(GLOB firmware_headers CONFIGURE_DEPENDS
  ${firmware_dir}/*.h ${runtime_dir}/*.h)
# Flash and RAM of both AVR boards are shared out between replay and tape:
# 32 KB; 2 and 2.5 KB.
set(firmware_uno avr atmega328p 380)
set(firmware_yun avr atmega32u4 500)
set(firmware_arm arm cortex-m3 0)

set(firmware_avr_flags -DF_CPU=16000000UL -flto -fno-threadsafe-statics
  -DRUNG_TAPE_BYTES=16384 -Wl,--defsym=__TEXT_REGION_LENGTH__=32768)

# rung_avr_firmware(FILE BOARD SOURCE...): the machine and SOURCEs, without the
# Arduino core, for uno or yun.
function(rung_avr_firmware file board)
  list(GET firmware_${board} 1 mcu)
  list(GET firmware_${board} 2 memory_words)
  add_custom_command(OUTPUT ${file}
    COMMAND ${RUNG_AVR_CXX} -mmcu=${mcu} ${firmware_avr_flags}
      -DRUNG_MEMORY_WORDS=${memory_words} -std=gnu++11 -Os -fno-exceptions
      -fno-rtti ${firmware_warnings} -I${runtime_dir} ${ARGN}
      ${machine_sources} -o ${file}
    DEPENDS ${ARGN} ${machine_sources} ${firmware_headers}
    COMMENT "Firmware ${file}"
    COMMAND_EXPAND_LISTS VERBATIM)
endfunction()

# rung_replay_firmware(FILE BOARD [FLAG...]): the replay for uno, yun or arm as
# an image in the build directory; FLAGs serve tests that break it.
function(rung_replay_firmware file board)
  list(GET firmware_${board} 0 family)
  list(GET firmware_${board} 1 mcu)
  list(GET firmware_${board} 2 memory_words)
  set(sources ${firmware_dir}/replay.cpp ${firmware_dir}/board_${family}.cpp
    ${machine_sources})
  if(family STREQUAL avr)
    set(command ${RUNG_AVR_CXX} -mmcu=${mcu} ${firmware_avr_flags}
      -DRUNG_MEMORY_WORDS=${memory_words})
  else()
    set(command ${RUNG_ARM_CXX} -mcpu=${mcu} -mthumb -ffreestanding -nostdlib
      -fno-asynchronous-unwind-tables -fno-tree-loop-distribute-patterns
      -T ${firmware_dir}/arm.ld)
    set(libraries -lgcc)
  endif()
  add_custom_command(OUTPUT ${file}
    COMMAND ${command} -std=gnu++11 -Os -fno-exceptions -fno-rtti
      ${firmware_warnings} -I${runtime_dir} -I${firmware_dir} ${ARGN}
      ${sources} ${libraries} -o ${file}
    DEPENDS ${sources} ${firmware_headers} ${firmware_dir}/arm.ld
    COMMENT "Firmware ${file}"
    COMMAND_EXPAND_LISTS VERBATIM)
endfunction()

# The Arduino core, once a board.
set(arduino_build ${CMAKE_COMMAND} -E env ARDUINO_AVR=${RUNG_ARDUINO_CORE}
  ${PROJECT_SOURCE_DIR}/scripts/arduino)
if(NOT rung_missing_tools)
  foreach(board uno yun)
    set(core ${PROJECT_BINARY_DIR}/boards/core-${board}.a)
    add_custom_command(OUTPUT ${core}
      COMMAND ${CMAKE_COMMAND} -E make_directory ${PROJECT_BINARY_DIR}/boards
      COMMAND ${arduino_build} core ${board} ${core}
      DEPENDS ${PROJECT_SOURCE_DIR}/scripts/arduino
      COMMENT "Arduino core for ${board}" VERBATIM)
    list(APPEND arduino_cores ${core})
  endforeach()
  add_custom_target(arduino_cores DEPENDS ${arduino_cores})
endif()

# rung_arduino_sketch(FILE BOARD SOURCE... [FLAG...]): a sketch with the library
# of runtime/, as the Arduino IDE builds it, for uno or yun.
function(rung_arduino_sketch file board)
  set(sources ${ARGN})
  list(FILTER sources EXCLUDE REGEX "^-")
  file(GLOB library CONFIGURE_DEPENDS ${runtime_dir}/*.cpp)
  add_custom_command(OUTPUT ${file}
    COMMAND ${arduino_build} sketch ${board}
      ${PROJECT_BINARY_DIR}/boards/core-${board}.a ${file} ${ARGN} ${library}
      -I${runtime_dir}
    DEPENDS arduino_cores ${PROJECT_BINARY_DIR}/boards/core-${board}.a
      ${PROJECT_SOURCE_DIR}/scripts/arduino ${sources} ${library}
      ${firmware_headers}
    COMMENT "Sketch ${file}" VERBATIM)
endfunction()

# rung_arm_sketch(FILE CORE SOURCE): a sketch and the library for a Cortex-M3,
# as one object file; CORE is a folder with an Arduino.h, of which Debian has
# none for ARM.
function(rung_arm_sketch file core source)
  file(GLOB library CONFIGURE_DEPENDS ${runtime_dir}/*.cpp)
  add_custom_command(OUTPUT ${file}
    COMMAND ${RUNG_ARM_CXX} -mcpu=cortex-m3 -mthumb -ffreestanding -nostdlib
      -DARDUINO=10819 -std=gnu++11 -Os -fno-exceptions -fno-rtti
      -fno-threadsafe-statics ${firmware_warnings} -I${runtime_dir} -I${core}
      -include Arduino.h -x c++ ${source} ${library} -Wl,-r -o ${file}
    DEPENDS ${source} ${library} ${firmware_headers} ${core}/Arduino.h
    COMMENT "Sketch ${file}"
    COMMAND_EXPAND_LISTS VERBATIM)
endfunction()
