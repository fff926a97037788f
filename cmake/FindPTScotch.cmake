# Finds PT-Scotch and defines PTScotch::PTScotch. Debian's libptscotch-dev ships no CMake configuration.
find_package(MPI QUIET COMPONENTS CXX)
find_path(PTScotch_INCLUDE_DIR ptscotch.h PATH_SUFFIXES scotch)
find_library(PTScotch_LIBRARY ptscotch)
find_library(PTScotch_ERROR_LIBRARY ptscotcherr)
find_library(PTScotch_SCOTCH_LIBRARY scotch)
mark_as_advanced(PTScotch_INCLUDE_DIR PTScotch_LIBRARY PTScotch_ERROR_LIBRARY PTScotch_SCOTCH_LIBRARY)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(PTScotch
  REQUIRED_VARS PTScotch_LIBRARY PTScotch_ERROR_LIBRARY PTScotch_INCLUDE_DIR MPI_CXX_FOUND)

if(PTScotch_FOUND AND NOT TARGET PTScotch::PTScotch)
  # Older versions have the functions of Scotch in this library; newer ones leave them in Scotch's own.
  include(CheckCXXSourceCompiles)
  set(CMAKE_REQUIRED_LIBRARIES "${PTScotch_LIBRARY};${PTScotch_ERROR_LIBRARY};MPI::MPI_CXX")
  check_cxx_source_compiles("extern \"C\" int SCOTCH_graphInit(void*); int main() { return SCOTCH_graphInit(nullptr); }"
    PTScotch_HAS_SCOTCH)
  unset(CMAKE_REQUIRED_LIBRARIES)
  set(PTScotch_libraries "${PTScotch_ERROR_LIBRARY}" MPI::MPI_CXX)
  if(NOT PTScotch_HAS_SCOTCH AND PTScotch_SCOTCH_LIBRARY)
    list(PREPEND PTScotch_libraries "${PTScotch_SCOTCH_LIBRARY}")
  endif()
  add_library(PTScotch::PTScotch UNKNOWN IMPORTED)
  set_target_properties(PTScotch::PTScotch PROPERTIES
    IMPORTED_LOCATION "${PTScotch_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${PTScotch_INCLUDE_DIR}"
    INTERFACE_LINK_LIBRARIES "${PTScotch_libraries}")
endif()
