# The library's targets: dovetail::dovetail, which is all modules; one per module, dovetail::<module>, with those that it may
# include; and one per third-party adapter, dovetail::<component>, made only when the third party is found. Each adapter's
# dependencies are written once more, for users, in dovetailConfig.cmake.in.

find_package(Threads REQUIRED)

# What the modules are, and what each may include, is said in one place.
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/cmake/modules.txt")
set(dovetail_modules "")
file(STRINGS "${PROJECT_SOURCE_DIR}/cmake/modules.txt" rows REGEX "^(has|includes) ")
foreach(row IN LISTS rows)
  if(NOT row MATCHES "^(has|includes) *\\| *([a-z_]+) *\\| *([a-z_/ 0-9]+)$")
    message(FATAL_ERROR "cmake/modules.txt: '${row}'")
  endif()
  set(kind ${CMAKE_MATCH_1})
  set(module ${CMAKE_MATCH_2})
  separate_arguments(words UNIX_COMMAND "${CMAKE_MATCH_3}")
  if(module STREQUAL "adapters") # one target for each library
    continue()
  elseif(kind STREQUAL "includes")
    list(TRANSFORM words PREPEND dovetail_)
    target_link_libraries(dovetail_${module} INTERFACE ${words})
  elseif(NOT module IN_LIST dovetail_modules)
    add_library(dovetail_${module} INTERFACE)
    add_library(dovetail::${module} ALIAS dovetail_${module})
    set_target_properties(dovetail_${module} PROPERTIES EXPORT_NAME ${module})
    list(APPEND dovetail_modules ${module})
  endif()
endforeach()

# All modules include the core, and have from it what a compiler has to know.
target_compile_features(dovetail_core INTERFACE cxx_std_20)
# Our warnings are our own affair: for a project that has this one as a subfolder its headers are a system's, as they are
# for one that finds it installed.
set(dovetail_headers_are SYSTEM)
if(PROJECT_IS_TOP_LEVEL)
  set(dovetail_headers_are "")
endif()
target_include_directories(dovetail_core ${dovetail_headers_are} INTERFACE
  "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>"
  "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>")
# The exact predicates are exact only when the compiler does not fuse a product and a sum on its own; nor would the mesh
# be the same on machines with and without fused operations. (By default g++ fuses where -march offers it.)
target_compile_options(dovetail_core INTERFACE
  "$<$<COMPILE_LANG_AND_ID:CXX,GNU,Clang,AppleClang>:-ffp-contract=off>")
target_link_libraries(dovetail_core INTERFACE Threads::Threads)

add_library(dovetail INTERFACE)
add_library(dovetail::dovetail ALIAS dovetail)
list(TRANSFORM dovetail_modules PREPEND dovetail_ OUTPUT_VARIABLE dovetail_module_targets)
target_link_libraries(dovetail INTERFACE ${dovetail_module_targets})

# Packages of dovetail have what they say, whatever else is on the machine that makes them.
set(DOVETAIL_ADAPTERS "found" CACHE STRING
  "Adapters of libraries: 'found' for each whose library is there, or a list of which none may lack its library")

set(dovetail_components "")
set(dovetail_missing_components "")
set(dovetail_unknown_adapters "${DOVETAIL_ADAPTERS}")
list(REMOVE_ITEM dovetail_unknown_adapters found)

# dovetail_adapter(<component> FOUND <found?> LIBRARIES <targets>)
function(dovetail_adapter component)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "FOUND" "LIBRARIES")
  list(REMOVE_ITEM dovetail_unknown_adapters ${component})
  set(dovetail_unknown_adapters "${dovetail_unknown_adapters}" PARENT_SCOPE)
  if(component IN_LIST DOVETAIL_ADAPTERS AND NOT arg_FOUND)
    message(FATAL_ERROR "DOVETAIL_ADAPTERS: the library of '${component}' was not found")
  endif()
  if(NOT DOVETAIL_ADAPTERS STREQUAL "found" AND NOT component IN_LIST DOVETAIL_ADAPTERS)
    set(arg_FOUND FALSE)
  endif()
  if(NOT arg_FOUND)
    set(dovetail_missing_components ${dovetail_missing_components} ${component} PARENT_SCOPE)
    return()
  endif()
  add_library(dovetail_${component} INTERFACE)
  add_library(dovetail::${component} ALIAS dovetail_${component})
  set_target_properties(dovetail_${component} PROPERTIES EXPORT_NAME ${component})
  target_link_libraries(dovetail_${component} INTERFACE dovetail ${arg_LIBRARIES})
  set(dovetail_components ${dovetail_components} ${component} PARENT_SCOPE)
endfunction()

# No version here: its config accepts only its own exact one.
find_package(OpenCASCADE QUIET CONFIG)
if(OpenCASCADE_FOUND)
  include(dovetail_occt)
endif()
dovetail_adapter(occt FOUND "${OpenCASCADE_FOUND}" LIBRARIES dovetail_occt_toolkits)

find_package(TetGen QUIET)
dovetail_adapter(tetgen FOUND "${TetGen_FOUND}" LIBRARIES TetGen::TetGen)

find_package(METIS 5 QUIET)
dovetail_adapter(metis FOUND "${METIS_FOUND}" LIBRARIES METIS::METIS)

find_package(Scotch QUIET)
dovetail_adapter(scotch FOUND "${Scotch_FOUND}" LIBRARIES Scotch::Scotch)

find_package(CGAL 5.4 QUIET CONFIG)
dovetail_adapter(cgal FOUND "${CGAL_FOUND}" LIBRARIES CGAL::CGAL)

find_package(Gmsh 4.8 QUIET)
dovetail_adapter(gmsh FOUND "${Gmsh_FOUND}" LIBRARIES Gmsh::Gmsh)

find_package(Netgen QUIET)
dovetail_adapter(netgen FOUND "${Netgen_FOUND}" LIBRARIES Netgen::nglib)

find_package(Spectra QUIET)
dovetail_adapter(spectra FOUND "${Spectra_FOUND}" LIBRARIES Spectra::Spectra)

find_package(Eigen3 QUIET CONFIG) # 3.3 or newer: of a version asked for, its config accepts the same major version only
if(Eigen3_VERSION VERSION_LESS 3.3)
  set(Eigen3_FOUND FALSE)
endif()
dovetail_adapter(eigen FOUND "${Eigen3_FOUND}" LIBRARIES Eigen3::Eigen)

find_package(Boost 1.71 QUIET CONFIG) # headers of Boost.Graph
dovetail_adapter(boost_graph FOUND "${Boost_FOUND}" LIBRARIES Boost::headers)

find_package(nlohmann_json 3.7 QUIET CONFIG)
dovetail_adapter(json FOUND "${nlohmann_json_FOUND}" LIBRARIES nlohmann_json::nlohmann_json)

find_package(HDF5Serial QUIET)
dovetail_adapter(hdf5 FOUND "${HDF5Serial_FOUND}" LIBRARIES HDF5Serial::HDF5Serial)

find_package(ZLIB QUIET)
dovetail_adapter(zlib FOUND "${ZLIB_FOUND}" LIBRARIES ZLIB::ZLIB)

find_package(MPI QUIET COMPONENTS CXX)
find_package(boost_mpi QUIET CONFIG)
if(MPI_CXX_FOUND AND boost_mpi_FOUND)
  set(dovetail_mpi_found TRUE)
endif()
dovetail_adapter(mpi FOUND "${dovetail_mpi_found}" LIBRARIES Boost::mpi MPI::MPI_CXX)

find_package(PTScotch QUIET)
dovetail_adapter(ptscotch FOUND "${PTScotch_FOUND}" LIBRARIES PTScotch::PTScotch)

find_package(ParMETIS QUIET)
dovetail_adapter(parmetis FOUND "${ParMETIS_FOUND}" LIBRARIES ParMETIS::ParMETIS)

if(dovetail_unknown_adapters)
  message(FATAL_ERROR "DOVETAIL_ADAPTERS: there is no '${dovetail_unknown_adapters}'; there are: "
    "${dovetail_components};${dovetail_missing_components}")
endif()
message(STATUS "dovetail adapters: ${dovetail_components}")
if(dovetail_missing_components)
  message(STATUS "dovetail adapters left out: ${dovetail_missing_components}")
endif()
