# SPDX-License-Identifier: Apache-2.0
# One static library per room. What a room links is what it may include: the links are the include rules.

add_library(dpslave_flags INTERFACE)
target_compile_options(dpslave_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast -Wcast-align
  -Wnon-virtual-dtor -Woverloaded-virtual -Wdouble-promotion -Wformat=2 -Wimplicit-fallthrough
  $<$<BOOL:${DPSLAVE_WARNINGS_AS_ERRORS}>:-Werror>)
if(DPSLAVE_SANITIZE)
  target_compile_options(dpslave_flags INTERFACE
    -fsanitize=${DPSLAVE_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer
    $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>) # g++ guesses wrong in code that it has instrumented
  target_link_options(dpslave_flags INTERFACE -fsanitize=${DPSLAVE_SANITIZE})
endif()

include(Hardening)
target_link_libraries(dpslave_flags INTERFACE dpslave_hardening)

# CMAKE_UNITY_BUILD compiles several files of a room at once, which more than halves the time. ALONE names those that
# share the name of something local with a neighbour.
set(CMAKE_UNITY_BUILD_BATCH_SIZE 6)
function(dpslave_alone)
  if(ARGN)
    set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  endif()
endfunction()

# dpslave_room(NAME SOURCES ... MAY_OPEN ... PRIVATE ... ALONE ...)
#   MAY_OPEN: rooms whose doors this room's own doors show.  PRIVATE: what only its .cpp files use.
function(dpslave_room name)
  cmake_parse_arguments(arg "" "" "SOURCES;MAY_OPEN;PRIVATE;ALONE" ${ARGN})
  dpslave_alone(${arg_ALONE})
  add_library(dpslave_${name} STATIC ${arg_SOURCES})
  target_include_directories(dpslave_${name} PUBLIC ${PROJECT_SOURCE_DIR}/include PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
  target_compile_options(dpslave_${name} PRIVATE ${DPSLAVE_FORTIFY})
  target_link_libraries(dpslave_${name} PUBLIC ${arg_MAY_OPEN} PRIVATE dpslave_flags ${arg_PRIVATE})
endfunction()

# dpslave_program(NAME SOURCES ... LINKS ...)
function(dpslave_program name)
  cmake_parse_arguments(arg "" "" "SOURCES;LINKS" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_compile_options(${name} PRIVATE ${DPSLAVE_FORTIFY})
  target_link_libraries(${name} PRIVATE dpslave_flags ${arg_LINKS})
  install(TARGETS ${name} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endfunction()

# dpslave_test(ROOM SOURCES ... LINKS ... ALONE ...) makes tests/<room>: the program test_<room> and its ctest entries.
# What is judged is optimised, its judge is not: that would cost more time than it saves.
function(dpslave_test name)
  cmake_parse_arguments(arg "" "" "SOURCES;LINKS;ALONE" ${ARGN})
  dpslave_alone(${arg_ALONE})
  add_executable(test_${name} ${arg_SOURCES})
  target_include_directories(test_${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_link_libraries(test_${name} PRIVATE dpslave_flags ${arg_LINKS} GTest::gmock GTest::gtest_main)
  set_target_properties(test_${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
  target_compile_options(test_${name} PRIVATE -O0 -g1)
  target_compile_definitions(test_${name} PRIVATE DPSLAVE_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  gtest_discover_tests(test_${name} TEST_PREFIX "${name}." NO_PRETTY_VALUES DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 120)
endfunction()
