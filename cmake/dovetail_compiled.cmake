# dovetail::compiled: what no policy touches, compiled once. Every x.ipp of the library defines what x.hpp beside it
# declares; a folder's are compiled together. Those that need Open CASCADE are a library of their own,
# dovetail::compiled_occt. Whoever links one of these gets the declarations alone.
option(DOVETAIL_BUILD_COMPILED "Build the compiled library beside the header-only one" ${PROJECT_IS_TOP_LEVEL})

set(dovetail_compiled_targets "")
if(NOT DOVETAIL_BUILD_COMPILED)
  return()
endif()

# dovetail_compiled_library(<name> LINKS <targets> DEFINITION <switch> FILES <x.ipp ...>)
function(dovetail_compiled_library name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "DEFINITION" "LINKS;FILES")
  set(sources "")
  foreach(file IN LISTS arg_FILES)
    cmake_path(GET file PARENT_PATH folder)
    string(REPLACE "/" "_" folder "${folder}")
    string(APPEND includes_of_${folder} "#include \"dovetail/${file}\"\n")
    list(APPEND folders ${folder})
  endforeach()
  list(REMOVE_DUPLICATES folders)
  foreach(folder IN LISTS folders)
    set(source "${PROJECT_BINARY_DIR}/${name}/${folder}.cpp")
    file(CONFIGURE OUTPUT "${source}" CONTENT "${includes_of_${folder}}" @ONLY)
    list(APPEND sources "${source}")
  endforeach()
  add_library(dovetail_${name} STATIC ${sources})
  add_library(dovetail::${name} ALIAS dovetail_${name})
  set_target_properties(dovetail_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_compile_definitions(dovetail_${name} PUBLIC ${arg_DEFINITION})
  target_link_libraries(dovetail_${name} PUBLIC ${arg_LINKS} PRIVATE $<BUILD_INTERFACE:dovetail_developer>)
  set(dovetail_compiled_targets ${dovetail_compiled_targets} ${name} PARENT_SCOPE)
endfunction()

file(GLOB_RECURSE definitions CONFIGURE_DEPENDS RELATIVE "${PROJECT_SOURCE_DIR}/include/dovetail"
  "${PROJECT_SOURCE_DIR}/include/dovetail/*.ipp")
list(SORT definitions)
set(of_occt ${definitions})
set(uses_occt "^models/occt|^experiments/builtin_models")
list(FILTER of_occt INCLUDE REGEX "${uses_occt}")
list(FILTER definitions EXCLUDE REGEX "${uses_occt}")

dovetail_compiled_library(compiled LINKS dovetail DEFINITION DOVETAIL_COMPILED FILES ${definitions})
if(TARGET dovetail_occt AND of_occt)
  dovetail_compiled_library(compiled_occt
    LINKS dovetail_compiled dovetail_occt DEFINITION DOVETAIL_COMPILED_OCCT FILES ${of_occt})
endif()
