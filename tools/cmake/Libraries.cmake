# SPDX-License-Identifier: Apache-2.0
# One static library for each folder of src/. 

add_library(dpslave_warnings INTERFACE)
target_compile_options(dpslave_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast -Wcast-align
  -Wnon-virtual-dtor -Woverloaded-virtual -Wdouble-promotion -Wformat=2 -Wimplicit-fallthrough
  $<$<BOOL:${DPSLAVE_WARNINGS_AS_ERRORS}>:-Werror>)
include(Hardening)
target_link_libraries(dpslave_warnings INTERFACE dpslave_hardening)

add_library(dpslave_flags INTERFACE)
target_link_libraries(dpslave_flags INTERFACE dpslave_warnings)
if(DPSLAVE_SANITIZE)
  target_compile_options(dpslave_flags INTERFACE
    -fsanitize=${DPSLAVE_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer
    # g++ warns wrongly about code that it has instrumented. And its checks of each pointer take more than a third of a build: null
    # and dead objects are what AddressSanitizer finds too, alignment is judged in the fuzz targets, by clang++.
    $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized -fno-sanitize=null,vptr,alignment,object-size>)
  target_link_options(dpslave_flags INTERFACE -fsanitize=${DPSLAVE_SANITIZE})
endif()

# CMAKE_UNITY_BUILD compiles several files of a library at once, which more than halves the time. ALONE names those that
# cannot stand beside a neighbour, each with its reason.
set(CMAKE_UNITY_BUILD_BATCH_SIZE 12)
function(dpslave_alone)
  if(ARGN)
    set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  endif()
endfunction()

# The table says which libraries there are and what each may open.
set(libraries_table ${PROJECT_SOURCE_DIR}/src/libraries.txt)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${libraries_table})
file(STRINGS ${libraries_table} rows REGEX "^[a-z]")
set(DPSLAVE_LIBRARIES)
set(DPSLAVE_ROOMS) # folders of a library that have a row of their own
foreach(row ${rows})
  string(REGEX REPLACE " *\\| *" ";" columns "${row} ")
  list(GET columns 0 name)
  if(name MATCHES "/")
    list(APPEND DPSLAVE_ROOMS ${name})
    continue()
  endif()
  list(GET columns 2 opened)
  list(GET columns 4 outside)
  list(APPEND DPSLAVE_LIBRARIES ${name})
  string(REGEX REPLACE "/[a-z_]+\\.hpp" "" opened "${opened}") # a library, whichever of its headers
  string(REGEX REPLACE "([a-z]+)" "dpslave_\\1" opened "${opened}")
  separate_arguments(opened)
  separate_arguments(outside)
  list(REMOVE_DUPLICATES opened)
  set(dpslave_${name}_opens ${opened})
  set(dpslave_${name}_outside ${outside})
endforeach()

# Code of the start, of callers and of commands is made small: the daemon locks its memory, so all of it stays there. With
# dpslave_program(): what no program calls is not in it. A build for looking into the code (Debug, noopt) stays one.
set(DPSLAVE_SMALL -ffunction-sections -fdata-sections)
if(NOT CMAKE_BUILD_TYPE STREQUAL "Debug" AND NOT CMAKE_CXX_FLAGS MATCHES "-O0")
  list(APPEND DPSLAVE_SMALL -Os)
endif()

# dpslave_library(NAME [FAST] SOURCES ... FAST_SOURCES ... ALONE ...) makes dpslave_NAME, which links what the table lets it open.
# FAST: a telegram or a drive waits for its code. It is made for speed, in the compiler's own order (M1 of tools/run bench).
# FAST_SOURCES: for these alone a telegram or a drive waits.
function(dpslave_library name)
  cmake_parse_arguments(arg "FAST" "" "SOURCES;FAST_SOURCES;ALONE" ${ARGN})
  dpslave_alone(${arg_ALONE})
  add_library(dpslave_${name} STATIC ${arg_SOURCES})
  if(NOT arg_FAST)
    target_compile_options(dpslave_${name} PRIVATE ${DPSLAVE_SMALL})
  endif()
  set(targets dpslave_${name})
  if(arg_FAST_SOURCES)
    add_library(dpslave_${name}_fast OBJECT ${arg_FAST_SOURCES})
    target_sources(dpslave_${name} PRIVATE $<TARGET_OBJECTS:dpslave_${name}_fast>)
    list(APPEND targets dpslave_${name}_fast)
  endif()
  foreach(target ${targets})
    target_include_directories(${target} PUBLIC ${PROJECT_SOURCE_DIR}/include PRIVATE ${PROJECT_SOURCE_DIR}/src)
    target_compile_options(${target} PRIVATE ${DPSLAVE_FORTIFY})
    target_link_libraries(${target} PUBLIC ${dpslave_${name}_opens} PRIVATE dpslave_flags ${dpslave_${name}_outside})
  endforeach()
endfunction()

# dpslave_program(NAME SOURCES ... LINKS ...): LINKS is its library, if it has one, and what the table says.
function(dpslave_program name)
  cmake_parse_arguments(arg "" "" "SOURCES;LINKS" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_compile_options(${name} PRIVATE ${DPSLAVE_FORTIFY} ${DPSLAVE_SMALL})
  target_link_libraries(${name} PRIVATE dpslave_flags ${arg_LINKS})
  target_link_options(${name} PRIVATE -Wl,--gc-sections)
  install(TARGETS ${name} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endfunction()

# The libraries of a list and all that they open.
function(dpslave_closure result)
  set(found)
  while(ARGN)
    list(POP_FRONT ARGN library)
    string(REGEX REPLACE "^dpslave_" "" name "${library}")
    if(name IN_LIST DPSLAVE_LIBRARIES AND NOT library IN_LIST found)
      list(APPEND found ${library})
      list(APPEND ARGN ${dpslave_${name}_opens})
    endif()
  endwhile()
  set(${result} ${found} PARENT_SCOPE)
endfunction()

# With AddressSanitizer it is the libraries that are judged. A test is compiled without, which saves a quarter of the build; so that
# templates and inline functions that both have are those of the library, the libraries stand first when the test is linked.
# INSTRUMENTED: what is judged is in the headers.
function(dpslave_test_is_judge target)
  cmake_parse_arguments(arg "INSTRUMENTED" "" "LINKS" ${ARGN})
  if(NOT DPSLAVE_SANITIZE MATCHES "address" OR arg_INSTRUMENTED)
    target_link_libraries(${target} PRIVATE dpslave_flags)
    return()
  endif()
  dpslave_closure(judged ${arg_LINKS})
  list(TRANSFORM judged REPLACE "(.+)" "$<TARGET_FILE:\\1>")
  target_link_libraries(${target} PRIVATE dpslave_warnings)
  target_compile_definitions(${target} PRIVATE __SANITIZE_ADDRESS__=1) # as the compiler says it where it instruments
  target_link_options(${target} PRIVATE -fsanitize=${DPSLAVE_SANITIZE} LINKER:--whole-archive ${judged} LINKER:--no-whole-archive)
endfunction()

# dpslave_test(NAME SOURCES ... LINKS ... ALONE ... [OPTIMISED] [INSTRUMENTED]) makes the program test_<name> and its ctest entries.
# What is judged is optimised. Its judge is only if it says so: that mostly costs more time than it saves.
function(dpslave_test name)
  cmake_parse_arguments(arg "OPTIMISED;INSTRUMENTED" "" "SOURCES;LINKS;ALONE" ${ARGN})
  dpslave_alone(${arg_ALONE})
  add_executable(test_${name} ${arg_SOURCES})
  target_include_directories(test_${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests ${PROJECT_SOURCE_DIR}/src)
  target_link_libraries(test_${name} PRIVATE ${arg_LINKS} dpslave_test_paths GTest::gmock GTest::gtest_main)
  if(arg_INSTRUMENTED)
    set(instrumented INSTRUMENTED)
  endif()
  dpslave_test_is_judge(test_${name} LINKS ${arg_LINKS} ${instrumented})
  set_target_properties(test_${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
  if(arg_OPTIMISED)
    target_compile_options(test_${name} PRIVATE -O2)
  else()
    target_compile_options(test_${name} PRIVATE -O0 -g1)
  endif()
  dpslave_ctest(${name})
endfunction()

# dpslave_ctest(NAME [FILTER]) makes the ctest entries of the program test_NAME: one for each test. With a sanitizer one for all
# of them, for the start of a sanitized program takes longer than most tests.
function(dpslave_ctest name)
  set(filter ${ARGN})
  if(NOT filter)
    set(filter "*")
  endif()
  if(DPSLAVE_SANITIZE)
    add_test(NAME ${name}.all COMMAND test_${name} --gtest_filter=${filter} --gtest_brief=1)
    set_tests_properties(${name}.all PROPERTIES TIMEOUT 900)
  else()
    gtest_discover_tests(test_${name} TEST_FILTER "${filter}" TEST_PREFIX "${name}." NO_PRETTY_VALUES DISCOVERY_TIMEOUT 60
      PROPERTIES TIMEOUT 120)
  endif()
endfunction()
