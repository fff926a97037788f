# Finds the Gmsh library and defines Gmsh::Gmsh. Debian's libgmsh-dev ships no CMake configuration.
find_path(Gmsh_INCLUDE_DIR gmsh.h)
find_library(Gmsh_LIBRARY gmsh)
mark_as_advanced(Gmsh_INCLUDE_DIR Gmsh_LIBRARY)

if(Gmsh_INCLUDE_DIR)
  file(STRINGS "${Gmsh_INCLUDE_DIR}/gmsh.h" lines REGEX "#define GMSH_API_VERSION_(MAJOR|MINOR|PATCH)")
  list(TRANSFORM lines REPLACE "^.*[ \t]([0-9]+)[ \t]*$" "\\1")
  list(JOIN lines "." Gmsh_VERSION)
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Gmsh REQUIRED_VARS Gmsh_LIBRARY Gmsh_INCLUDE_DIR VERSION_VAR Gmsh_VERSION)

if(Gmsh_FOUND AND NOT TARGET Gmsh::Gmsh)
  add_library(Gmsh::Gmsh UNKNOWN IMPORTED)
  set_target_properties(Gmsh::Gmsh PROPERTIES
    IMPORTED_LOCATION "${Gmsh_LIBRARY}" INTERFACE_INCLUDE_DIRECTORIES "${Gmsh_INCLUDE_DIR}")
endif()
