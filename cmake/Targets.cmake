# All targets of a directory and of those below it.
function(rung_targets_below directory result)
  get_property(found DIRECTORY ${directory} PROPERTY BUILDSYSTEM_TARGETS)
  get_property(below DIRECTORY ${directory} PROPERTY SUBDIRECTORIES)
  foreach(child IN LISTS below)
    rung_targets_below(${child} more)
    list(APPEND found ${more})
  endforeach()
  set(${result} ${found} PARENT_SCOPE)
endfunction()

# The tests of an executable, one by one; or, where RUNG_TEST_PARTS is set, so
# many runs of parts of them: under sanitizers starting a process costs more
# than most tests.
function(rung_add_tests executable)
  if(NOT RUNG_TEST_PARTS)
    gtest_discover_tests(${executable} DISCOVERY_TIMEOUT 60)
    return()
  endif()
  math(EXPR last "${RUNG_TEST_PARTS} - 1")
  foreach(part RANGE ${last})
    add_test(NAME ${executable}.${part} COMMAND ${executable})
    set_tests_properties(${executable}.${part} PROPERTIES ENVIRONMENT
      "GTEST_TOTAL_SHARDS=${RUNG_TEST_PARTS};GTEST_SHARD_INDEX=${part}")
  endforeach()
endfunction()
