# goalmouth_library(NAME [DEPENDS target...] [OPTIONS flag...])   a library of all *.cpp in the current folder: goalmouth::NAME;
#                                               OPTIONS: what the compiler is told beyond the usual
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
  # -pthread, which LCM asks for, to all: with one set of options they share precompiled headers.
  target_compile_options(${target} PRIVATE ${GOALMOUTH_WARNINGS} -ffp-contract=off -pthread)
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

# Half of the build is test code that runs for milliseconds: not optimised it compiles in two thirds of the time.
function(goalmouth_test_optimisation target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

# Half of what the compiler does for a file is to read other people's headers, the same ones every time. It takes a precompiled header only
# with the options that header was made with, so there is one for each set of them. They hold what most files of the set include, and nothing
# that leaves code in files without use for it, as CLI11 and <iostream> do: objects are the same with and without. Every file names what it
# uses all the same: GOALMOUTH_PCH=OFF builds without, as builds with sanitizers do unless told otherwise.
if(CMAKE_BUILD_TYPE STREQUAL Release AND NOT GOALMOUTH_SANITIZE)
  set(precompile ON)
else()
  set(precompile OFF)
endif()
option(GOALMOUTH_PCH "Precompile other people's headers that most of our files include" ${precompile})
if(GOALMOUTH_PCH AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # The standard library silences these for its strings, which GCC forgets in a precompiled header. Builds without keep them.
  list(APPEND GOALMOUTH_WARNINGS -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread)
endif()

# goalmouth_precompiled(TARGET product|tests)   compiles cmake/precompiled/*.h for the target's sources
function(goalmouth_precompiled target headers)
  if(GOALMOUTH_PCH)
    target_precompile_headers(${target} PRIVATE ${PROJECT_SOURCE_DIR}/cmake/precompiled/${headers}.h)
  endif()
endfunction()

# goalmouth_shared_precompiled(TARGET libraries|programs|tests)   the same, compiled once for all such targets
function(goalmouth_shared_precompiled target group)
  if(NOT GOALMOUTH_PCH)
    return()
  endif()
  set(owner goalmouth_precompiled_${group})
  if(NOT TARGET ${owner})
    set(source ${PROJECT_BINARY_DIR}/precompiled/${group}.cpp)  # CMake wants a source beside a header
    file(CONFIGURE OUTPUT ${source} CONTENT "// Nothing: its target has a header to compile.\n")
    add_library(${owner} OBJECT ${source})
    target_include_directories(${owner} PRIVATE ${PROJECT_SOURCE_DIR})
    target_link_libraries(${owner} PRIVATE Eigen3::Eigen)
    goalmouth_our_code(${owner})
    if(NOT group STREQUAL "libraries")  # as CMake compiles for executables
      set_target_properties(${owner} PROPERTIES POSITION_INDEPENDENT_CODE OFF)
      target_compile_options(${owner} PRIVATE -fPIE)
    endif()
    if(group STREQUAL "tests")
      target_link_libraries(${owner} PRIVATE GTest::gtest GTest::gmock)
      goalmouth_test_optimisation(${owner})
      goalmouth_precompiled(${owner} tests)
    else()
      goalmouth_precompiled(${owner} product)
    endif()
  endif()
  target_precompile_headers(${target} REUSE_FROM ${owner})
endfunction()

function(goalmouth_library name)
  cmake_parse_arguments(arg "" "" "DEPENDS;OPTIONS" ${ARGN})
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
  if(arg_OPTIONS)  # others than a shared precompiled header was made with: one of its own
    target_compile_options(goalmouth_${name} PRIVATE ${arg_OPTIONS})
    goalmouth_precompiled(goalmouth_${name} product)
  else()
    goalmouth_shared_precompiled(goalmouth_${name} libraries)
  endif()
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
  goalmouth_shared_precompiled(goalmouth_module_${name} libraries)
  set_property(GLOBAL APPEND PROPERTY GOALMOUTH_MODULES goalmouth::module_${name})
  add_executable(${name} main.cpp)
  target_link_libraries(${name} PRIVATE goalmouth::module_${name})
  goalmouth_our_code(${name})
  goalmouth_shared_precompiled(${name} programs)
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
  goalmouth_shared_precompiled(${name} programs)
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
  goalmouth_test_optimisation(test_${name})
  goalmouth_shared_precompiled(test_${name} tests)
  gtest_discover_tests(test_${name} TEST_PREFIX "${name}." DISCOVERY_TIMEOUT 120
                       PROPERTIES TIMEOUT ${arg_TIMEOUT} RUN_SERIAL ${arg_SERIAL} SKIP_REGULAR_EXPRESSION "\\[  SKIPPED \\]|skipped: these tests")
endfunction()
