# goalmouth_library(NAME [DEPENDS target...])   a library of all *.cpp in the current folder: goalmouth::NAME
# goalmouth_module(NAME [DEPENDS target...])    a process: library goalmouth::module_NAME from all *.cpp but main.cpp,
#                                               and the program NAME from main.cpp
# goalmouth_program(NAME [DEPENDS target...])   a program of all *.cpp in the current folder
# goalmouth_tests(NAME [SERIAL] [TIMEOUT s] [DEPENDS target...])   one GoogleTest program of all *.cpp in the current folder;
#                                               SERIAL: its tests run beside no other

set(GOALMOUTH_WARNINGS -Wall -Wextra -Wconversion -Wshadow -Wnon-virtual-dtor -Werror)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # Optimising, GCC 12 takes std::optional and strings in aggregates for uninitialised (its bug 80635), and "text" + string
  # for overlapping copies (its bug 105651).
  list(APPEND GOALMOUTH_WARNINGS -Wno-maybe-uninitialized -Wno-restrict)
endif()

function(goalmouth_our_code target)
  # Products and sums are not fused where the processor could: a replay on another machine must give the same bytes.
  target_compile_options(${target} PRIVATE ${GOALMOUTH_WARNINGS} -ffp-contract=off)
  if(GOALMOUTH_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=${GOALMOUTH_SANITIZE} -fno-omit-frame-pointer
                                             -fno-sanitize-recover=all)
    if(GOALMOUTH_SANITIZE MATCHES thread AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
      # The frame ring's fences are unknown to it: what they order it cannot check, and says so.
      target_compile_options(${target} PRIVATE -Wno-tsan)
    endif()
    target_link_options(${target} PUBLIC -fsanitize=${GOALMOUTH_SANITIZE})
  endif()
endfunction()

function(goalmouth_library name)
  cmake_parse_arguments(arg "" "" "DEPENDS" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS *.cpp)
  if(NOT sources)  # headers only
    add_library(goalmouth_${name} INTERFACE)
    add_library(goalmouth::${name} ALIAS goalmouth_${name})
    target_include_directories(goalmouth_${name} INTERFACE ${PROJECT_SOURCE_DIR})
    target_link_libraries(goalmouth_${name} INTERFACE ${arg_DEPENDS})
    return()
  endif()
  add_library(goalmouth_${name} STATIC ${sources})
  add_library(goalmouth::${name} ALIAS goalmouth_${name})
  target_include_directories(goalmouth_${name} PUBLIC ${PROJECT_SOURCE_DIR})
  target_link_libraries(goalmouth_${name} PUBLIC ${arg_DEPENDS})
  goalmouth_our_code(goalmouth_${name})
endfunction()

function(goalmouth_module name)
  cmake_parse_arguments(arg "" "" "DEPENDS" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS *.cpp)
  list(FILTER sources EXCLUDE REGEX "/main\\.cpp$")
  add_library(goalmouth_module_${name} STATIC ${sources})
  add_library(goalmouth::module_${name} ALIAS goalmouth_module_${name})
  target_include_directories(goalmouth_module_${name} PUBLIC ${PROJECT_SOURCE_DIR})
  target_link_libraries(goalmouth_module_${name} PUBLIC goalmouth::process goalmouth::messaging
                                                        goalmouth::conversion ${arg_DEPENDS})
  goalmouth_our_code(goalmouth_module_${name})
  set_property(GLOBAL APPEND PROPERTY GOALMOUTH_MODULES goalmouth::module_${name})
  add_executable(${name} main.cpp)
  target_link_libraries(${name} PRIVATE goalmouth::module_${name})
  goalmouth_our_code(${name})
  set_property(GLOBAL APPEND PROPERTY GOALMOUTH_PROGRAMS ${name})
  install(TARGETS ${name} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endfunction()

function(goalmouth_program name)
  cmake_parse_arguments(arg "" "" "DEPENDS" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS *.cpp)
  add_executable(${name} ${sources})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(${name} PRIVATE ${arg_DEPENDS})
  goalmouth_our_code(${name})
  set_property(GLOBAL APPEND PROPERTY GOALMOUTH_PROGRAMS ${name})
  install(TARGETS ${name} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endfunction()

function(goalmouth_tests name)
  cmake_parse_arguments(arg "SERIAL" "TIMEOUT" "DEPENDS" ${ARGN})
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 120)
  endif()
  file(GLOB sources CONFIGURE_DEPENDS *.cpp)
  add_executable(test_${name} ${sources})
  target_include_directories(test_${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(test_${name} PRIVATE ${arg_DEPENDS} goalmouth::test_support GTest::gtest GTest::gmock GTest::gtest_main)
  target_compile_definitions(test_${name} PRIVATE GOALMOUTH_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
                                                  GOALMOUTH_BINARY_DIR="${PROJECT_BINARY_DIR}")
  goalmouth_our_code(test_${name})
  # Half of the build is test code that runs for milliseconds: not optimised it compiles in two thirds of the time.
  target_compile_options(test_${name} PRIVATE $<$<CONFIG:Release>:-O1>)
  gtest_discover_tests(test_${name} TEST_PREFIX "${name}." DISCOVERY_TIMEOUT 120
                       PROPERTIES TIMEOUT ${arg_TIMEOUT} RUN_SERIAL ${arg_SERIAL} SKIP_REGULAR_EXPRESSION "\\[  SKIPPED \\]|skipped: these tests")
endfunction()
