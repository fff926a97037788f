# Finds Netgen's nglib and defines Netgen::nglib. Debian's libnglib-dev ships a CMake configuration, but that also asks
# for what only its viewer needs.
find_path(Netgen_INCLUDE_DIR nglib.h PATH_SUFFIXES netgen)
find_library(Netgen_LIBRARY nglib PATH_SUFFIXES netgen)
mark_as_advanced(Netgen_INCLUDE_DIR Netgen_LIBRARY)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Netgen REQUIRED_VARS Netgen_LIBRARY Netgen_INCLUDE_DIR)

if(Netgen_FOUND AND NOT TARGET Netgen::nglib)
  add_library(Netgen::nglib UNKNOWN IMPORTED)
  set_target_properties(Netgen::nglib PROPERTIES
    IMPORTED_LOCATION "${Netgen_LIBRARY}" INTERFACE_INCLUDE_DIRECTORIES "${Netgen_INCLUDE_DIR}")
endif()
