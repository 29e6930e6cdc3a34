# LCM for CMake, where the packaged LCM (1.3.1) ships no package file of its own.
#
#   goalmouth::lcm                              imported library, C++ headers included
#   lcm_wrap_types(CPP_TARGET <name> [JAVA_TARGET <name> JAVA_JAR <file>] PACKAGE <package> TYPES <file.lcm>...)
#
# Generates C++ (an INTERFACE library whose headers count as system headers, because generated code does not
# stand up to our warnings) and, where a JDK and lcm.jar are present, a jar of the Java types for lcm-spy and
# Java programs. One .lcm file holds one struct of the same name, which is how the outputs can be named here.

find_package(PkgConfig REQUIRED)
pkg_check_modules(lcm_pc REQUIRED IMPORTED_TARGET lcm)
add_library(goalmouth_lcm INTERFACE)
target_link_libraries(goalmouth_lcm INTERFACE PkgConfig::lcm_pc)
add_library(goalmouth::lcm ALIAS goalmouth_lcm)

find_program(LCM_GEN lcm-gen REQUIRED)
find_file(LCM_JAR lcm.jar PATHS /usr/share/java /usr/local/share/java)
find_program(JAVAC javac)
find_program(JAR jar)

function(lcm_wrap_types)
  cmake_parse_arguments(arg "" "CPP_TARGET;JAVA_TARGET;JAVA_JAR;PACKAGE" "TYPES" ${ARGN})

  set(cpp_dir ${CMAKE_CURRENT_BINARY_DIR}/cpp)
  set(headers)
  foreach(type_file IN LISTS arg_TYPES)
    get_filename_component(type ${type_file} NAME_WE)
    list(APPEND headers ${cpp_dir}/${arg_PACKAGE}/${type}.hpp)
  endforeach()
  add_custom_command(OUTPUT ${headers} DEPENDS ${arg_TYPES}
                     COMMAND ${LCM_GEN} -x --cpp-std c++11 --cpp-hpath ${cpp_dir} ${arg_TYPES}
                     COMMAND ${CMAKE_COMMAND} -E touch ${headers}
                     COMMENT "Generating C++ for LCM package ${arg_PACKAGE}" VERBATIM)
  add_custom_target(${arg_CPP_TARGET}_generated DEPENDS ${headers})
  add_library(${arg_CPP_TARGET} INTERFACE)
  add_dependencies(${arg_CPP_TARGET} ${arg_CPP_TARGET}_generated)
  target_include_directories(${arg_CPP_TARGET} SYSTEM INTERFACE ${cpp_dir})
  target_link_libraries(${arg_CPP_TARGET} INTERFACE goalmouth::lcm)

  if(arg_JAVA_TARGET)
    if(NOT (LCM_JAR AND JAVAC AND JAR))
      message(STATUS "No JDK or lcm.jar: the Java types for lcm-spy are not built")
      return()
    endif()
    set(java_dir ${CMAKE_CURRENT_BINARY_DIR}/java)
    set(sources)
    foreach(type_file IN LISTS arg_TYPES)
      get_filename_component(type ${type_file} NAME_WE)
      list(APPEND sources ${java_dir}/${arg_PACKAGE}/${type}.java)
    endforeach()
    add_custom_command(OUTPUT ${arg_JAVA_JAR} DEPENDS ${arg_TYPES}
                       COMMAND ${CMAKE_COMMAND} -E rm -rf ${java_dir}
                       COMMAND ${LCM_GEN} -j --jpath ${java_dir} ${arg_TYPES}
                       COMMAND ${CMAKE_COMMAND} -E make_directory ${java_dir}/classes
                       COMMAND ${JAVAC} -nowarn -classpath ${LCM_JAR} -d ${java_dir}/classes ${sources}
                       COMMAND ${JAR} cf ${arg_JAVA_JAR} -C ${java_dir}/classes .
                       COMMENT "Building the Java types of LCM package ${arg_PACKAGE}" VERBATIM)
    add_custom_target(${arg_JAVA_TARGET} ALL DEPENDS ${arg_JAVA_JAR})
  endif()
endfunction()
