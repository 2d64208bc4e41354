# Install rules: program, library (shared and static), headers, pkg-config and CMake package files, completion, pages with
# their scenes and examples; and the target uninstall, which takes all of it away again.
# The static library has an export file of its own: only its users need our dependencies.
include(CMakePackageConfigHelpers)
set(PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/pointspec)

set_target_properties(pointspec_program PROPERTIES EXPORT_NAME program)
install(TARGETS pointspec_program pointspec EXPORT pointspec_shared)
if(TARGET pointspec_mpi)
  install(TARGETS pointspec_mpi DESTINATION ${MODULE_DIR})
endif()
install(TARGETS pointspec_static EXPORT pointspec_static)
install(DIRECTORY host/include/pointspec DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  FILES_MATCHING PATTERN "*.h")
# The links of README.md are to docs/.
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR}
  PATTERN man EXCLUDE PATTERN scripts EXCLUDE PATTERN Doxyfile EXCLUDE PATTERN mkdocs.yml EXCLUDE)
install(FILES packages/completion/pointspec DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
install(FILES LICENSE README.md CONTRIBUTING.md CHANGELOG.md CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs/man/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 FILES_MATCHING PATTERN "*.1")
install(FILES docs/man/pointspec.3 DESTINATION ${CMAKE_INSTALL_MANDIR}/man3)

foreach(export pointspec_shared pointspec_static)
  install(EXPORT ${export} FILE ${export}.cmake NAMESPACE pointspec:: DESTINATION ${PACKAGE_DIR})
endforeach()
configure_package_config_file(cmake/pointspec-config.cmake.in pointspec-config.cmake
  INSTALL_DESTINATION ${PACKAGE_DIR} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/pointspec-config-version.cmake
  COMPATIBILITY SameMinorVersion)   # below 1.0 a minor version may change the interface
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/pointspec-config.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/pointspec-config-version.cmake DESTINATION ${PACKAGE_DIR})

# The prefix is found from the place of the .pc file, so an installed tree can be moved.
set(PKGCONFIG_DIR ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
file(RELATIVE_PATH PREFIX_FROM_PKGCONFIG
  ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
configure_file(cmake/pointspec.pc.in pointspec.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/pointspec.pc DESTINATION ${PKGCONFIG_DIR})

add_custom_target(uninstall COMMAND ${CMAKE_COMMAND} -DMANIFEST=${CMAKE_CURRENT_BINARY_DIR}/install_manifest.txt
  -DPREFIX=${CMAKE_INSTALL_PREFIX} -P ${CMAKE_CURRENT_SOURCE_DIR}/cmake/uninstall.cmake)
