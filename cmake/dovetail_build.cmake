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

# Linked privately by everything this project compiles.
add_library(dovetail_developer INTERFACE)
if(DOVETAIL_DEVELOPER AND CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
  target_compile_options(dovetail_developer INTERFACE ${dovetail_warnings})
endif()

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
endfunction()

option(DOVETAIL_SANITIZE "Address and undefined-behaviour sanitizers in our own executables" OFF)
if(DOVETAIL_SANITIZE)
  set(sanitizers -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  target_compile_options(dovetail_developer INTERFACE ${sanitizers})
  target_link_options(dovetail_developer INTERFACE ${sanitizers})
endif()
