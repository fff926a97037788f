# Installs the headers, one export set of all modules and one per component (so that a missing third party never breaks
# another component), the configuration and version files, the Find modules, and of the driver and the compiled libraries
# what was built.
include(CMakePackageConfigHelpers)
set(config_directory "${CMAKE_INSTALL_LIBDIR}/cmake/dovetail")

install(DIRECTORY "${PROJECT_SOURCE_DIR}/include/dovetail" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}"
  FILES_MATCHING PATTERN "*.hpp" PATTERN "*.ipp")

install(TARGETS dovetail ${dovetail_module_targets} EXPORT dovetail_modules)
install(EXPORT dovetail_modules NAMESPACE dovetail:: FILE dovetail-modules-targets.cmake DESTINATION "${config_directory}")
foreach(component IN LISTS dovetail_components)
  install(TARGETS dovetail_${component} EXPORT dovetail_${component})
  install(EXPORT dovetail_${component} NAMESPACE dovetail::
    FILE dovetail-${component}-targets.cmake DESTINATION "${config_directory}")
endforeach()

foreach(name IN LISTS dovetail_compiled_targets)
  install(TARGETS dovetail_${name} EXPORT dovetail_${name} ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" OPTIONAL)
  install(EXPORT dovetail_${name} NAMESPACE dovetail::
    FILE dovetail-${name}-targets.cmake DESTINATION "${config_directory}")
endforeach()

list(JOIN dovetail_modules " " dovetail_modules_in_words)
configure_package_config_file(
  "${PROJECT_SOURCE_DIR}/cmake/dovetailConfig.cmake.in" "${PROJECT_BINARY_DIR}/dovetailConfig.cmake"
  INSTALL_DESTINATION "${config_directory}" PATH_VARS CMAKE_INSTALL_LIBDIR)
write_basic_package_version_file("${PROJECT_BINARY_DIR}/dovetailConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)

install(FILES
  "${PROJECT_BINARY_DIR}/dovetailConfig.cmake"
  "${PROJECT_BINARY_DIR}/dovetailConfigVersion.cmake"
  "${PROJECT_SOURCE_DIR}/cmake/dovetail_occt.cmake"
  "${PROJECT_SOURCE_DIR}/cmake/FindMETIS.cmake"
  "${PROJECT_SOURCE_DIR}/cmake/FindTetGen.cmake"
  "${PROJECT_SOURCE_DIR}/cmake/FindGmsh.cmake"
  "${PROJECT_SOURCE_DIR}/cmake/FindNetgen.cmake"
  "${PROJECT_SOURCE_DIR}/cmake/FindScotch.cmake"
  "${PROJECT_SOURCE_DIR}/cmake/FindPTScotch.cmake"
  "${PROJECT_SOURCE_DIR}/cmake/FindParMETIS.cmake"
  "${PROJECT_SOURCE_DIR}/cmake/FindSpectra.cmake"
  "${PROJECT_SOURCE_DIR}/cmake/FindHDF5Serial.cmake"
  DESTINATION "${config_directory}")

if(TARGET dovetail_driver)
  install(TARGETS dovetail_driver RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" OPTIONAL)
  get_target_property(help_pages dovetail_driver dovetail_help_pages)
  install(DIRECTORY "${help_pages}/man1" DESTINATION "${CMAKE_INSTALL_MANDIR}" OPTIONAL)
  install(FILES "${help_pages}/_dovetail" DESTINATION "${CMAKE_INSTALL_DATADIR}/zsh/site-functions" OPTIONAL)
  install(FILES "${help_pages}/dovetail.bash" DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions"
    RENAME dovetail OPTIONAL)
endif()

# For programs that are built without CMake. It finds the headers from where it is itself, as the package may be moved.
file(RELATIVE_PATH dovetail_include_from_pc
  "${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig" "${CMAKE_INSTALL_FULL_INCLUDEDIR}")
configure_file("${PROJECT_SOURCE_DIR}/cmake/dovetail.pc.in" "${PROJECT_BINARY_DIR}/dovetail.pc" @ONLY)
install(FILES "${PROJECT_BINARY_DIR}/dovetail.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig")

include(dovetail_pack)
