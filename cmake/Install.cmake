# `make install`, the Debian package, and the CMake package through which C++
# programs link the library: find_package(rungproof), rungproof::rung_smt.
include(CMakePackageConfigHelpers)

set(cmake_dir ${CMAKE_INSTALL_LIBDIR}/cmake/rungproof)
install(TARGETS rungproof rungproof-check RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS rung_options rung_z3 rung_cadical rung_nettle rung_base
                rung_digest rung_frontend
                rung_analysis rung_rules rung_smt rung_backend rung_boards
                rung_reports rung_runtime
  EXPORT rungproof-targets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT rungproof-targets NAMESPACE rungproof::
  DESTINATION ${cmake_dir})
foreach(folder base frontend analysis smt backend boards reports runtime)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${folder}
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/rungproof
    FILES_MATCHING PATTERN "*.h")
endforeach()
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/rungproof-config.cmake.in
  ${PROJECT_BINARY_DIR}/rungproof-config.cmake INSTALL_DESTINATION ${cmake_dir})
write_basic_package_version_file(
  ${PROJECT_BINARY_DIR}/rungproof-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/rungproof-config.cmake
              ${PROJECT_BINARY_DIR}/rungproof-config-version.cmake
  DESTINATION ${cmake_dir})
install(FILES ${PROJECT_SOURCE_DIR}/docs/rungproof.1
              ${PROJECT_SOURCE_DIR}/docs/rungproof-check.1
  DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
# What `prove --replay-on` runs: of a build that has the cross compilers.
if(NOT rung_missing_tools)
  install(FILES ${replay_images}
    DESTINATION ${CMAKE_INSTALL_DATADIR}/rungproof/boards)
endif()
set(completions ${PROJECT_SOURCE_DIR}/app/completions)
install(FILES ${completions}/rungproof.bash RENAME rungproof
  DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
install(FILES ${completions}/_rungproof
  DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions)
install(FILES ${completions}/rungproof.fish
  DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE
  DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/rungproof RENAME copyright)

set(CPACK_PACKAGE_CONTACT "Rungproof maintainers <maintainers@rungproof.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY ${PROJECT_DESCRIPTION})
set(CPACK_DEBIAN_PACKAGE_SECTION devel)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "simavr, qemu-system-arm")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_GENERATOR DEB)
include(CPack)
