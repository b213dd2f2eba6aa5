# SPDX-License-Identifier: Apache-2.0
# The build's own words. Sources are globbed so that adding a file edits nothing.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()

find_program(CHIARO_CCACHE ccache)
if(CHIARO_CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CHIARO_CCACHE})
endif()

option(CHIARO_WERROR "Warnings are errors" ON)
set(CHIARO_SANITIZE "" CACHE STRING "address, thread or empty")

add_library(chiaro_options INTERFACE)
target_include_directories(chiaro_options INTERFACE ${CMAKE_SOURCE_DIR})
target_compile_options(chiaro_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wnon-virtual-dtor -Woverloaded-virtual
  $<$<BOOL:${CHIARO_WERROR}>:-Werror>
  # GCC 12 alone: false alarms on std::string temporaries (its bug 105651 and kin); sanitisers look for real ones.
  $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  # A seed gives one answer: no contraction into fused multiply-add behind our back.
  -ffp-contract=off)
if(CHIARO_SANITIZE STREQUAL "address")
  target_compile_options(chiaro_options INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(chiaro_options INTERFACE -fsanitize=address,undefined)
elseif(CHIARO_SANITIZE STREQUAL "thread")
  target_compile_options(chiaro_options INTERFACE -fsanitize=thread -fno-omit-frame-pointer
    $<$<CXX_COMPILER_ID:GNU>:-Wno-tsan>)
  # The sanitiser does not understand fences; Asio has them only for handlers without a lock.
  target_compile_definitions(chiaro_options INTERFACE BOOST_ASIO_DISABLE_FENCED_BLOCK)
  target_link_options(chiaro_options INTERFACE -fsanitize=thread)
endif()
find_package(Threads REQUIRED)

# chiaro_library(name [FOLDER dir] USES stages… LIBS system libraries…)
# Every .cpp below the folder (not *_main.cpp) becomes one static library `chiaro_<name>`.
function(chiaro_library name)
  cmake_parse_arguments(ARG "" "FOLDER" "USES;LIBS;EXCLUDE" ${ARGN})
  if(NOT ARG_FOLDER)
    set(ARG_FOLDER ${CMAKE_CURRENT_SOURCE_DIR})
  endif()
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${ARG_FOLDER}/*.cpp)
  list(FILTER sources EXCLUDE REGEX "_main\\.cpp$")
  list(FILTER sources EXCLUDE REGEX "/node_modules/")
  foreach(pattern ${ARG_EXCLUDE})
    list(FILTER sources EXCLUDE REGEX ${pattern})
  endforeach()
  if(sources)
    add_library(chiaro_${name} STATIC ${sources})
    set(scope PUBLIC)
    target_link_libraries(chiaro_${name} PRIVATE ${ARG_LIBS})
  else()
    add_library(chiaro_${name} INTERFACE)
    set(scope INTERFACE)
    target_link_libraries(chiaro_${name} INTERFACE ${ARG_LIBS})
  endif()
  list(TRANSFORM ARG_USES PREPEND chiaro_)
  target_link_libraries(chiaro_${name} ${scope} chiaro_options Threads::Threads ${ARG_USES})
endfunction()

# chiaro_program(name MAIN file USES stages… LIBS …)
function(chiaro_program name)
  cmake_parse_arguments(ARG "" "MAIN" "USES;LIBS" ${ARGN})
  add_executable(${name} ${ARG_MAIN})
  list(TRANSFORM ARG_USES PREPEND chiaro_)
  target_link_libraries(${name} PRIVATE chiaro_options ${ARG_USES} ${ARG_LIBS})
endfunction()

# chiaro_tests(name FOLDER dir [EXCLUDE patterns…] USES stages… LIBS … LABELS …): every *_test.cpp below the folder in
# one GoogleTest program, each test known to ctest.
function(chiaro_tests name)
  cmake_parse_arguments(ARG "" "FOLDER;TIMEOUT" "USES;LIBS;LABELS;EXCLUDE" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${ARG_FOLDER}/*_test.cpp)
  foreach(pattern ${ARG_EXCLUDE})
    list(FILTER sources EXCLUDE REGEX ${pattern})
  endforeach()
  if(NOT sources)
    return()
  endif()
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 300)
  endif()
  find_package(GTest REQUIRED)
  include(GoogleTest)
  add_executable(${name} ${sources})
  list(TRANSFORM ARG_USES PREPEND chiaro_)
  target_link_libraries(${name} PRIVATE chiaro_options ${ARG_USES} ${ARG_LIBS} GTest::gtest GTest::gmock GTest::gtest_main)
  # What is tested is optimised; the tests themselves are read once, and compile a third sooner.
  target_compile_options(${name} PRIVATE -O1)
  target_compile_definitions(${name} PRIVATE CHIARO_SOURCE="${CMAKE_SOURCE_DIR}" CHIARO_BIN="${CMAKE_BINARY_DIR}/bin")
  # One label "integration,threads": discovery flattens lists, and ctest -L matches a part as well.
  list(JOIN ARG_LABELS "," labels)
  gtest_discover_tests(${name} TEST_PREFIX ${name}. DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60
    PROPERTIES LABELS "${labels}" TIMEOUT ${ARG_TIMEOUT})
  # `ninja tests_<label>` builds what `ctest -L <label>` runs.
  foreach(label ${ARG_LABELS})
    if(NOT TARGET tests_${label})
      add_custom_target(tests_${label})
    endif()
    add_dependencies(tests_${label} ${name})
  endforeach()
endfunction()
