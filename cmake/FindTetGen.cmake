# Finds TetGen as a library and defines TetGen::TetGen. Debian's libtet1.5-dev ships no CMake configuration.
# TETLIBRARY makes tetgen.h declare the library's interface, and its errors exceptions instead of exit().
find_path(TetGen_INCLUDE_DIR tetgen.h)
find_library(TetGen_LIBRARY NAMES tet tetgen)
mark_as_advanced(TetGen_INCLUDE_DIR TetGen_LIBRARY)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(TetGen REQUIRED_VARS TetGen_LIBRARY TetGen_INCLUDE_DIR)

# A shared library is not linked but loaded by adapters/tetgen_library.hpp, which says why.
if(TetGen_FOUND AND NOT TARGET TetGen::TetGen)
  file(REAL_PATH "${TetGen_LIBRARY}" TetGen_file)
  if(TetGen_file MATCHES "\\.so(\\.[0-9.]+)?$")
    add_library(TetGen::TetGen INTERFACE IMPORTED)
    set_target_properties(TetGen::TetGen PROPERTIES
      INTERFACE_LINK_LIBRARIES "${CMAKE_DL_LIBS}"
      INTERFACE_COMPILE_DEFINITIONS "TETLIBRARY;DOVETAIL_TETGEN_SHARED_LIBRARY=\"${TetGen_file}\"")
  else()
    add_library(TetGen::TetGen UNKNOWN IMPORTED)
    set_target_properties(TetGen::TetGen PROPERTIES
      IMPORTED_LOCATION "${TetGen_LIBRARY}"
      INTERFACE_COMPILE_DEFINITIONS TETLIBRARY)
  endif()
  set_target_properties(TetGen::TetGen PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${TetGen_INCLUDE_DIR}")
endif()
