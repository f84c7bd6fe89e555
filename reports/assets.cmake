# Writes assets.cpp with the texts of scripts and styles, and their hashes. A
# script is a CDATA section, so that the page is well-formed XML too.
function(rung_asset name is_script)
  set(text "")
  foreach(file ${ARGN})
    file(READ ${CMAKE_CURRENT_SOURCE_DIR}/${file} part)
    string(APPEND text "${part}")
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  endforeach()
  if(is_script)
    string(CONCAT text "//<![CDATA[\n" "${text}" "//]]>\n")
  endif()
  string(SHA256 hash "${text}")
  string(CONCAT line "const Asset ${name} = {R\"asset(" "${text}"
         ")asset\",\n    \"${hash}\"};\n")
  set(assets "${assets}${line}" PARENT_SCOPE)
endfunction()

set(assets "")
rung_asset(kPageScript TRUE html/elements.js html/ladder.js html/timing.js
  html/exports.js html/page.js)
rung_asset(kPageStyle FALSE html/page.css)
rung_asset(kLadderStyle FALSE ladder/ladder.css)
file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/assets.cpp @ONLY CONTENT
  "#include \"reports/assets.h\"\n\nnamespace rung {\n\n@assets@\n}  // namespace rung\n")
