# SPDX-License-Identifier: Apache-2.0
# Installs into WORK_DIR, then builds and runs programs in C that know only the prefix: by CMake, and by pkg-config.
include(${CMAKE_CURRENT_LIST_DIR}/../install/run_step.cmake)

run_step("Configure" ${CMAKE_COMMAND} -S ${CONSUMER_DIR} -B ${consumer_build} -G ${GENERATOR}
  -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_C_COMPILER=${CC} -DWANTED_VERSION=${VERSION} -DEXAMPLE=${EXAMPLE})
run_step("Build" ${CMAKE_COMMAND} --build ${consumer_build})
run_step("Run" ${consumer_build}/c_consumer)

if(NOT PKG_CONFIG)
  message(STATUS "pkg-config is not installed: not tried")
  return()
endif()
file(GLOB_RECURSE pc ${prefix}/*/incise.pc)
get_filename_component(pc_dir "${pc}" DIRECTORY)
get_filename_component(lib_dir "${pc_dir}" DIRECTORY)
execute_process(COMMAND ${CMAKE_COMMAND} -E env PKG_CONFIG_PATH=${pc_dir} ${PKG_CONFIG}
  --define-variable=prefix=${prefix} --cflags --libs incise
  OUTPUT_VARIABLE flags OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "pkg-config does not find incise in ${pc_dir}")
endif()
separate_arguments(flags UNIX_COMMAND "${flags}")
run_step("Build by pkg-config" ${CC} -std=c99 -pedantic -Wall -Wextra -Werror ${EXAMPLE} -o ${WORK_DIR}/by_pkg_config
  ${flags} -Wl,-rpath,${lib_dir})
run_step("Run what pkg-config built" ${WORK_DIR}/by_pkg_config)
