# The headers that most files include, once for each larger target. Only where
# it was asked for: GCC 12 warns falsely about code behind such headers, and a
# build without them sees an include that is missing.

set(headers <algorithm> <cstdint> <functional> <map> <memory> <optional>
  <string> <string_view> <unordered_map> <utility> <vector>)

rung_targets_below(${CMAKE_CURRENT_SOURCE_DIR} targets)
foreach(target IN LISTS targets)
  get_target_property(type ${target} TYPE)
  get_target_property(sources ${target} SOURCES)
  list(LENGTH sources count)
  if(NOT type MATCHES "STATIC_LIBRARY|EXECUTABLE" OR count LESS 4)
    continue()
  endif()
  get_target_property(directory ${target} SOURCE_DIR)
  target_precompile_headers(${target} PRIVATE ${headers})
  if(target STREQUAL rung_reports)
    target_precompile_headers(${target} PRIVATE <nlohmann/json.hpp>)
  endif()
  if(directory MATCHES "/tests/" AND NOT directory MATCHES "/fuzz")
    target_precompile_headers(${target} PRIVATE <gtest/gtest.h>)
  endif()
endforeach()
