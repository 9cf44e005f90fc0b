# SPDX-License-Identifier: Apache-2.0
# One CMake target per module, so that an include that the layering forbids fails to link.

# Flags that make results bit-identical over compilers, optimisation levels and WebAssembly.
add_library(incise_flags INTERFACE)
target_compile_features(incise_flags INTERFACE cxx_std_20)
target_compile_definitions(incise_flags INTERFACE EIGEN_DONT_VECTORIZE)
target_compile_options(incise_flags INTERFACE -ffp-contract=off -fno-math-errno)

add_library(incise_warnings INTERFACE)
target_compile_options(incise_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion
                                                 $<$<BOOL:${INCISE_WERROR}>:-Werror>)
if(INCISE_SANITIZE)
  target_compile_options(incise_flags INTERFACE -fsanitize=${INCISE_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(incise_flags INTERFACE -fsanitize=${INCISE_SANITIZE})
endif()

# incise_module(NAME DEPENDS module... PRIVATE library... SOURCES file...)
function(incise_module name)
  cmake_parse_arguments(ARG "" "" "DEPENDS;PRIVATE;SOURCES" ${ARGN})
  add_library(incise_${name} STATIC ${ARG_SOURCES})
  add_library(incise::${name} ALIAS incise_${name})
  set_target_properties(incise_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_include_directories(incise_${name}
    PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:include>
    PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_link_libraries(incise_${name} PUBLIC incise_flags PRIVATE $<BUILD_INTERFACE:incise_warnings> ${ARG_PRIVATE})
  foreach(dep IN LISTS ARG_DEPENDS)
    target_link_libraries(incise_${name} PUBLIC incise_${dep})
  endforeach()
endfunction()
