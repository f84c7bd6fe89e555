# SHA-256 for the result cache. Debian ships it without a CMake package.
find_path(NETTLE_INCLUDE_DIR nettle/sha2.h REQUIRED)
find_library(NETTLE_LIBRARY nettle REQUIRED)
add_library(rung_nettle INTERFACE)
target_include_directories(rung_nettle SYSTEM INTERFACE ${NETTLE_INCLUDE_DIR})
target_link_libraries(rung_nettle INTERFACE ${NETTLE_LIBRARY})
