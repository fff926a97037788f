# Finds PT-Scotch and defines PTScotch::PTScotch. Debian's libptscotch-dev ships no CMake configuration. The library has
# the functions of Scotch in it.
find_package(MPI QUIET COMPONENTS CXX)
find_path(PTScotch_INCLUDE_DIR ptscotch.h PATH_SUFFIXES scotch)
find_library(PTScotch_LIBRARY ptscotch)
find_library(PTScotch_ERROR_LIBRARY ptscotcherr)
mark_as_advanced(PTScotch_INCLUDE_DIR PTScotch_LIBRARY PTScotch_ERROR_LIBRARY)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(PTScotch
  REQUIRED_VARS PTScotch_LIBRARY PTScotch_ERROR_LIBRARY PTScotch_INCLUDE_DIR MPI_CXX_FOUND)

if(PTScotch_FOUND AND NOT TARGET PTScotch::PTScotch)
  add_library(PTScotch::PTScotch UNKNOWN IMPORTED)
  set_target_properties(PTScotch::PTScotch PROPERTIES
    IMPORTED_LOCATION "${PTScotch_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${PTScotch_INCLUDE_DIR}"
    INTERFACE_LINK_LIBRARIES "${PTScotch_ERROR_LIBRARY};MPI::MPI_CXX")
endif()
