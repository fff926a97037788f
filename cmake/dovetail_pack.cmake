# Archives of what the target install installs: `cpack -G TGZ` or `cpack -G DEB` in the build folder. In that of the preset
# headers this is the library alone, for any architecture; else what was built is with it.
set(CPACK_GENERATOR TGZ)
set(CPACK_PACKAGE_VENDOR "the dovetail authors")
set(CPACK_PACKAGE_CONTACT "the dovetail authors <dovetail@example.org>")
set(CPACK_RESOURCE_FILE_LICENSE "${PROJECT_SOURCE_DIR}/LICENSE")
set(CPACK_DEBIAN_PACKAGE_SECTION libdevel)
if(TARGET dovetail_driver OR dovetail_compiled_targets)
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
else()
  set(CPACK_PACKAGE_FILE_NAME "dovetail-${PROJECT_VERSION}-headers")
  set(CPACK_DEBIAN_PACKAGE_ARCHITECTURE all)
endif()
include(CPack)
