# dovetail_test(NAME <name> SOURCES <files> [LIBRARIES <targets>] [NEEDS_SHARED] [SHARED_CASES <pattern>]
#   [RANKS <n ...>])
#
# A doctest executable and its ctest entry. dovetail::dovetail and doctest's main are linked in. When a target of
# LIBRARIES does not exist, nothing is built and the test is reported as skipped. A test that evaluates no assertion
# (all cases skipped, or returned early for want of data) is reported as skipped too.
# RANKS: the executable has its own main, which takes the number of ranks, and is run by mpirun with each of them.
# No test has a time limit of its own: ctest's, 1500 s, ends one that hangs, and none that is slow.
# NEEDS_SHARED: the test reads the models in the directory named by the environment variable DOVETAIL_SHARED.
# SHARED_CASES: its cases of these names do, and are an entry of their own, <name>_shared.

if(DEFINED ENV{DOVETAIL_SHARED})
  set(shared_directory "$ENV{DOVETAIL_SHARED}")
else()
  cmake_path(SET shared_directory NORMALIZE "${PROJECT_SOURCE_DIR}/../shared")
endif()
if(IS_DIRECTORY "${shared_directory}")
  set(DOVETAIL_SHARED_DIRECTORY "${shared_directory}")
else()
  set(DOVETAIL_SHARED_DIRECTORY "")
endif()

option(DOVETAIL_REQUIRE_ALL_TESTS "A test that lacks a library or tool fails instead of being skipped" OFF)

# What OpenMPI needs to run in containers, as root, with more ranks than processors (up to version 4, and from 5 on).
set(dovetail_mpi_environment
  OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
  PRTE_MCA_mapby=:oversubscribe OMPI_MCA_mpi_yield_when_idle=1 OMPI_MCA_btl_vader_single_copy_mechanism=none)

# A ctest entry that only says why the test is not there.
function(dovetail_skipped_test name reason)
  if(DOVETAIL_REQUIRE_ALL_TESTS)
    add_test(NAME ${name} COMMAND sh -c "echo 'missing: ${reason}'; exit 1")
    return()
  endif()
  add_test(NAME ${name} COMMAND ${CMAKE_COMMAND} -E echo "skipped: ${reason}")
  set_tests_properties(${name} PROPERTIES SKIP_REGULAR_EXPRESSION "^skipped: ")
endfunction()

function(dovetail_test)
  cmake_parse_arguments(arg "NEEDS_SHARED" "NAME;SHARED_CASES" "SOURCES;LIBRARIES;RANKS" ${ARGN})
  if(NOT arg_NAME OR NOT arg_SOURCES OR arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "dovetail_test: NAME and SOURCES are needed, and not ${arg_UNPARSED_ARGUMENTS}")
  endif()
  foreach(library IN LISTS arg_LIBRARIES)
    if(NOT TARGET ${library})
      dovetail_skipped_test(${arg_NAME} "${library} was not found")
      return()
    endif()
  endforeach()

  set(executable test_${arg_NAME})
  add_executable(${executable} ${arg_SOURCES})
  dovetail_link(${executable} ${arg_LIBRARIES})
  # The compiled library, in which the time goes, is optimised as it is shipped; a test's own code need not be.
  if(dovetail_compiled_targets AND CMAKE_BUILD_TYPE STREQUAL "Release")
    target_compile_options(${executable} PRIVATE -O1)
  endif()
  if(arg_RANKS)
    target_link_libraries(${executable} PRIVATE doctest::doctest)
    target_include_directories(${executable} PRIVATE "${PROJECT_SOURCE_DIR}/tests")
    foreach(ranks IN LISTS arg_RANKS)
      add_test(NAME ${arg_NAME}_${ranks} COMMAND ${MPIEXEC_EXECUTABLE} -n ${ranks} $<TARGET_FILE:${executable}> ${ranks})
      set_tests_properties(${arg_NAME}_${ranks} PROPERTIES ENVIRONMENT "${dovetail_mpi_environment}")
    endforeach()
    return()
  endif()
  target_link_libraries(${executable} PRIVATE dovetail_test_main)
  if(arg_SHARED_CASES)
    dovetail_doctest_entry(${arg_NAME} "${arg_NEEDS_SHARED}" --test-case-exclude=${arg_SHARED_CASES})
    dovetail_doctest_entry(${arg_NAME}_shared TRUE --test-case=${arg_SHARED_CASES})
  else()
    dovetail_doctest_entry(${arg_NAME} "${arg_NEEDS_SHARED}")
  endif()
endfunction()

# The ctest entry <name> of the executable of dovetail_test, with arguments for it.
function(dovetail_doctest_entry name needs_shared)
  add_test(NAME ${name} COMMAND ${executable} ${ARGN})
  if(needs_shared OR NOT DOVETAIL_REQUIRE_ALL_TESTS)
    set_tests_properties(${name} PROPERTIES SKIP_RETURN_CODE 77)
  endif()
  if(DOVETAIL_SHARED_DIRECTORY)
    set_property(TEST ${name} APPEND PROPERTY ENVIRONMENT "DOVETAIL_SHARED=${DOVETAIL_SHARED_DIRECTORY}")
  endif()
endfunction()
