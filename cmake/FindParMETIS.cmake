# Finds ParMETIS, or what has its interface: PT-Scotch's, which is Debian's libscotchparmetis-dev. Defines
# ParMETIS::ParMETIS.
find_package(MPI QUIET COMPONENTS CXX)
find_package(METIS QUIET)
find_path(ParMETIS_INCLUDE_DIR parmetis.h PATH_SUFFIXES parmetis)
find_library(ParMETIS_LIBRARY parmetis)
mark_as_advanced(ParMETIS_INCLUDE_DIR ParMETIS_LIBRARY)

if(ParMETIS_INCLUDE_DIR)
  file(STRINGS "${ParMETIS_INCLUDE_DIR}/parmetis.h" ParMETIS_of_scotch REGEX "SCOTCH_PARMETIS_VERSION")
  if(ParMETIS_of_scotch)
    find_package(PTScotch QUIET)
    set(ParMETIS_of_scotch PTScotch_FOUND)
  endif()
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(ParMETIS
  REQUIRED_VARS ParMETIS_LIBRARY ParMETIS_INCLUDE_DIR METIS_FOUND MPI_CXX_FOUND ${ParMETIS_of_scotch})

if(ParMETIS_FOUND AND NOT TARGET ParMETIS::ParMETIS)
  add_library(ParMETIS::ParMETIS UNKNOWN IMPORTED)
  set_target_properties(ParMETIS::ParMETIS PROPERTIES
    IMPORTED_LOCATION "${ParMETIS_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${ParMETIS_INCLUDE_DIR}"
    INTERFACE_LINK_LIBRARIES "METIS::METIS;MPI::MPI_CXX;$<TARGET_NAME_IF_EXISTS:PTScotch::PTScotch>")
endif()
