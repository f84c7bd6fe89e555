# Tests that need packages from npm, or other programs of other people.
find_program(NPM npm)
find_program(NODE node)

# rung_add_npm_test(NAME [NEEDS VARIABLE...] COMMAND ...)
# Runs COMMAND with the packages of this folder's package.json, which are
# installed into the build directory, where its scripts are copied
# (tests/npm/run.sh). NEEDS: variables of find_program that have to be set. Where
# something is missing, the test is listed as skipped in every run, so that
# nobody takes it for passed; in CI it fails.
function(rung_add_npm_test name)
  cmake_parse_arguments(PARSE_ARGV 1 test "" "" "NEEDS;COMMAND")
  set(missing)
  foreach(program NPM NODE ${test_NEEDS})
    if(NOT ${program})
      string(TOLOWER ${program} program)
      list(APPEND missing ${program})
    endif()
  endforeach()
  if(missing)
    list(JOIN missing ", " missing)
    message(WARNING "${name} will NOT run, for want of ${missing} "
                    "(scripts/deps --all)")
    add_test(NAME ${name} COMMAND sh -c
      "echo 'SKIPPED: no ${missing}, ${name} did NOT run'; [ -n \"$CI\" ] && exit 1; exit 77")
  else()
    add_test(NAME ${name} COMMAND ${PROJECT_SOURCE_DIR}/tests/npm/run.sh
      ${NPM} ${CMAKE_CURRENT_SOURCE_DIR} ${CMAKE_CURRENT_BINARY_DIR}
      ${test_COMMAND})
  endif()
  set_tests_properties(${name} PROPERTIES SKIP_RETURN_CODE 77 LABELS npm
    RESOURCE_LOCK ${CMAKE_CURRENT_BINARY_DIR})  # one installs, the others wait
endfunction()
