# dovetail_test(NAME <name> SOURCES <files> [LIBRARIES <targets>] [NEEDS_SHARED] [SHARED_CASES <pattern>]
#   [ALONE] [RANKS <n ...>])
#
# A doctest program and its ctest entry. dovetail::dovetail and doctest's main are linked in. When a target of
# LIBRARIES does not exist, nothing is built and the test is reported as skipped. A test that evaluates no assertion
# (all cases skipped, or returned early for want of data) is reported as skipped too.
# Tests of one file, of the same folder and libraries, are a few to a program and translation unit: most of the time to
# compile one goes to what they share. So a test's anonymous names must not be those of another.
# ALONE: it is a program of its own, test_<name>.
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
  cmake_parse_arguments(arg "NEEDS_SHARED;ALONE" "NAME;SHARED_CASES" "SOURCES;LIBRARIES;RANKS" ${ARGN})
  if(NOT arg_NAME OR NOT arg_SOURCES OR arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "dovetail_test: NAME and SOURCES are needed, and not ${arg_UNPARSED_ARGUMENTS}")
  endif()
  foreach(library IN LISTS arg_LIBRARIES)
    if(NOT TARGET ${library})
      dovetail_skipped_test(${arg_NAME} "${library} was not found")
      return()
    endif()
  endforeach()

  list(LENGTH arg_SOURCES source_count)
  if(source_count EQUAL 1 AND NOT arg_RANKS AND NOT arg_ALONE)
    dovetail_join_batch(executable "${arg_SOURCES}" "${arg_LIBRARIES}")
    set(filter "--source-file=*/${arg_SOURCES}")
  else()
    set(executable test_${arg_NAME})
    dovetail_test_program(${executable} "${arg_SOURCES}" "${arg_LIBRARIES}")
    set(filter "")
  endif()
  if(arg_RANKS) # with a main of its own
    foreach(ranks IN LISTS arg_RANKS)
      add_test(NAME ${arg_NAME}_${ranks} COMMAND ${MPIEXEC_EXECUTABLE} -n ${ranks} $<TARGET_FILE:${executable}> ${ranks})
      set_tests_properties(${arg_NAME}_${ranks} PROPERTIES ENVIRONMENT "${dovetail_mpi_environment}")
    endforeach()
    return()
  endif()
  target_link_libraries(${executable} PRIVATE dovetail_test_main)
  if(arg_SHARED_CASES)
    dovetail_doctest_entry(${arg_NAME} "${arg_NEEDS_SHARED}" ${filter} --test-case-exclude=${arg_SHARED_CASES})
    dovetail_doctest_entry(${arg_NAME}_shared TRUE ${filter} --test-case=${arg_SHARED_CASES})
  else()
    dovetail_doctest_entry(${arg_NAME} "${arg_NEEDS_SHARED}" ${filter})
  endif()
endfunction()

# A program of the sources, linked with doctest but for its main.
function(dovetail_test_program name sources libraries)
  add_executable(${name} ${sources})
  dovetail_link(${name} ${libraries})
  target_link_libraries(${name} PRIVATE doctest::doctest)
  target_include_directories(${name} PRIVATE "${PROJECT_SOURCE_DIR}/tests")
  # For clang 22 doctest would number the cases by their lines, which two files may share; it calls the counter an extension.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang" AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 22)
    target_compile_definitions(${name} PRIVATE DOCTEST_COUNTER=__COUNTER__)
    target_compile_options(${name} PRIVATE -Wno-c2y-extensions)
  endif()
  # The compiled library, in which the time goes, is optimised as it is shipped; a test's own code need not be.
  if(dovetail_compiled_targets AND CMAKE_BUILD_TYPE STREQUAL "Release")
    target_compile_options(${name} PRIVATE -O1)
  endif()
endfunction()

# The program with which a test's file is compiled: that of its folder and libraries which is not full yet.
function(dovetail_join_batch program file libraries)
  set(batch_size 1)
  if(DOVETAIL_COMPILE_TOGETHER)
    set(batch_size 6)
  endif()
  cmake_path(GET CMAKE_CURRENT_SOURCE_DIR FILENAME folder)
  string(REGEX REPLACE "dovetail(::|_)" "" with "${libraries}")
  list(REMOVE_ITEM with dovetail)
  list(JOIN with "_" with)
  string(REGEX REPLACE "_$" "" batch "tests_${folder}_${with}")
  get_property(joined DIRECTORY PROPERTY dovetail_files_of_${batch})
  list(LENGTH joined count)
  math(EXPR number "${count} / ${batch_size} + 1")
  set(name ${batch}_${number})
  if(NOT TARGET ${name})
    set(unit "${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp")
    file(GENERATE OUTPUT "${unit}" CONTENT "$<TARGET_PROPERTY:${name},dovetail_includes>")
    dovetail_test_program(${name} "${unit}" "${libraries}")
  endif()
  set_property(DIRECTORY APPEND PROPERTY dovetail_files_of_${batch} "${file}")
  set_property(TARGET ${name} APPEND_STRING PROPERTY dovetail_includes "#include \"${folder}/${file}\"\n")
  set(${program} ${name} PARENT_SCOPE)
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
