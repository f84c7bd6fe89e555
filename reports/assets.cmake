# Writes assets.cpp with the texts of scripts and styles, and their hashes. A
# script is a CDATA section, so that the page is well-formed XML too.
function(rung_asset name file is_script)
  file(READ ${CMAKE_CURRENT_SOURCE_DIR}/${file} text)
  if(is_script)
    string(CONCAT text "//<![CDATA[\n" "${text}" "//]]>\n")
  endif()
  string(SHA256 hash "${text}")
  string(CONCAT line "const Asset ${name} = {R\"asset(" "${text}"
         ")asset\",\n    \"${hash}\"};\n")
  set(assets "${assets}${line}" PARENT_SCOPE)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
endfunction()

set(assets "")
rung_asset(kPageScript html/page.js TRUE)
rung_asset(kPageStyle html/page.css FALSE)
rung_asset(kLadderStyle ladder/ladder.css FALSE)
file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/assets.cpp @ONLY CONTENT
  "#include \"reports/assets.h\"\n\nnamespace rung {\n\n@assets@\n}  // namespace rung\n")
