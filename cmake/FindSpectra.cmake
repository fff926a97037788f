# Finds Spectra, a library of headers on top of Eigen: the package of Debian 12 has no CMake configuration.
# Defines Spectra::Spectra.
find_package(Eigen3 QUIET CONFIG)
find_path(Spectra_INCLUDE_DIR NAMES Spectra/SymEigsSolver.h)
mark_as_advanced(Spectra_INCLUDE_DIR)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Spectra REQUIRED_VARS Spectra_INCLUDE_DIR Eigen3_FOUND)

if(Spectra_FOUND AND NOT TARGET Spectra::Spectra)
  add_library(Spectra::Spectra INTERFACE IMPORTED)
  set_target_properties(Spectra::Spectra PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES "${Spectra_INCLUDE_DIR}" INTERFACE_LINK_LIBRARIES Eigen3::Eigen)
endif()
