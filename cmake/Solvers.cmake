# Debian ships Z3 and CaDiCaL without CMake packages.
find_path(Z3_INCLUDE_DIR z3++.h REQUIRED)
find_library(Z3_LIBRARY z3 REQUIRED)
add_library(rung_z3 INTERFACE)
target_include_directories(rung_z3 SYSTEM INTERFACE ${Z3_INCLUDE_DIR})
target_link_libraries(rung_z3 INTERFACE ${Z3_LIBRARY})

find_path(CADICAL_INCLUDE_DIR cadical.hpp REQUIRED)
find_library(CADICAL_LIBRARY NAMES libcadical.a cadical REQUIRED)
add_library(rung_cadical INTERFACE)
target_include_directories(rung_cadical SYSTEM INTERFACE
  ${CADICAL_INCLUDE_DIR})
target_link_libraries(rung_cadical INTERFACE ${CADICAL_LIBRARY})
