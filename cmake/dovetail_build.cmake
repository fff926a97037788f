# How our own executables are built. Nothing here reaches a user's target.

get_property(is_multi_config GLOBAL PROPERTY GENERATOR_IS_MULTI_CONFIG)
if(PROJECT_IS_TOP_LEVEL AND NOT is_multi_config AND NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

set(CMAKE_CXX_EXTENSIONS OFF)

if(PROJECT_IS_TOP_LEVEL AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  find_program(DOVETAIL_CCACHE ccache)
  mark_as_advanced(DOVETAIL_CCACHE)
  if(DOVETAIL_CCACHE)
    set(CMAKE_CXX_COMPILER_LAUNCHER "${DOVETAIL_CCACHE}")
  endif()
endif()

# clang's -Wconversion includes -Wsign-conversion, g++'s does not: ids are signed and index vectors.
set(dovetail_warnings -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion -Wpedantic -Werror)

# In Boost.Graph, as CGAL uses it, g++ 12 sees a member that may be uninitialised.
set(dovetail_cgal_options $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)

# Linked privately by everything this project compiles.
add_library(dovetail_developer INTERFACE)
if(DOVETAIL_DEVELOPER AND CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
  target_compile_options(dovetail_developer INTERFACE ${dovetail_warnings})
endif()

# Programs that link Open CASCADE take a third of the time by another linker than g++'s own, where there is one.
if(PROJECT_IS_TOP_LEVEL AND DOVETAIL_DEVELOPER AND NOT CMAKE_EXE_LINKER_FLAGS MATCHES "-fuse-ld")
  include(CheckLinkerFlag)
  foreach(linker IN ITEMS lld gold)
    check_linker_flag(CXX -fuse-ld=${linker} DOVETAIL_LINKS_BY_${linker})
    if(DOVETAIL_LINKS_BY_${linker})
      target_link_options(dovetail_developer INTERFACE -fuse-ld=${linker})
      break()
    endif()
  endforeach()
endif()

# Most of the time to compile a file of the driver or a test goes to the headers that it shares with others.
option(DOVETAIL_COMPILE_TOGETHER "Compile files of the driver and of tests a few to a translation unit" ON)

# What our own programs link: the compiled library where it is built, else the headers alone.
function(dovetail_link target)
  set(libraries dovetail::dovetail ${ARGN})
  foreach(name IN LISTS dovetail_compiled_targets)
    string(REPLACE compiled_ dovetail:: adapter "${name}")
    if(name STREQUAL "compiled" OR adapter IN_LIST ARGN)
      list(PREPEND libraries dovetail::${name})
    endif()
  endforeach()
  target_link_libraries(${target} PRIVATE ${libraries} dovetail_developer)
  if("dovetail::cgal" IN_LIST ARGN AND NOT TARGET dovetail_compiled_cgal)
    target_compile_options(${target} PRIVATE ${dovetail_cgal_options})
  endif()
endfunction()

option(DOVETAIL_SANITIZE "Address and undefined-behaviour sanitizers in our own executables" OFF)
if(DOVETAIL_SANITIZE)
  set(sanitizers -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  target_compile_options(dovetail_developer INTERFACE ${sanitizers})
  target_link_options(dovetail_developer INTERFACE ${sanitizers})
endif()
