# SPDX-License-Identifier: Apache-2.0
# One CMake target per module, so that an include that the layering forbids fails to link.

# Flags that make results bit-identical over compilers, optimisation levels and WebAssembly. They hold for users
# too, since templates and inline functions of the public headers are compiled in their programs
# (docs/decisions/0002-flags-reach-users.md).
add_library(incise_flags INTERFACE)
set_target_properties(incise_flags PROPERTIES EXPORT_NAME flags)
target_compile_features(incise_flags INTERFACE cxx_std_20)
target_compile_definitions(incise_flags INTERFACE EIGEN_DONT_VECTORIZE)
target_compile_options(incise_flags INTERFACE -ffp-contract=off -fno-math-errno)
target_link_libraries(incise_flags INTERFACE Eigen3::Eigen)
configure_file(${CMAKE_CURRENT_LIST_DIR}/version.h.in ${PROJECT_BINARY_DIR}/generated/incise/version.h @ONLY)
target_include_directories(incise_flags INTERFACE $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/generated>)

add_library(incise_warnings INTERFACE)
target_compile_options(incise_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion
                                                 $<$<BOOL:${INCISE_WERROR}>:-Werror>
  # GCC 12 sees overlaps in std::string operator+ that are not there (its bug 105651).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  # Where sources are compiled together (CMAKE_UNITY_BUILD), it takes a source's own types for those of a header.
  $<$<AND:$<CXX_COMPILER_ID:GNU>,$<BOOL:${CMAKE_UNITY_BUILD}>>:-Wno-subobject-linkage>
  # No warning, but for our own build alone, too: g++ looks less often for memory that it could use again, which takes a fifth
  # more of it, and about 7 % less time.
  $<$<AND:$<COMPILE_LANG_AND_ID:CXX,GNU>,$<BOOL:${CMAKE_UNITY_BUILD}>>:--param=ggc-min-expand=300>)
if(INCISE_SANITIZE)
  target_compile_options(incise_flags INTERFACE
    $<BUILD_INTERFACE:-fsanitize=${INCISE_SANITIZE}> $<BUILD_INTERFACE:-fno-omit-frame-pointer>
    $<BUILD_INTERFACE:-fno-sanitize-recover=all>)
  # What the fuzzer needs of the linker, only a fuzzer's own program asks for.
  string(REPLACE "fuzzer-no-link," "" incise_link_sanitize "${INCISE_SANITIZE}")
  target_link_options(incise_flags INTERFACE $<BUILD_INTERFACE:-fsanitize=${incise_link_sanitize}>)
endif()

# incise_optimise(TARGET LEVEL): how far a release goes where people and files are waited for. It is level 3 elsewhere, which
# takes a quarter longer to compile than 2. Of inline functions that two libraries share, programs keep one copy, and not
# always that of the library at level 3: what the kernels share with others must stay off their hot paths.
function(incise_optimise target level)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O${level}>)
endfunction()

# incise_module(NAME DEPENDS module... PUBLIC library... PRIVATE library... SOURCES file...)
#
# A static library `incise_NAME`, also `incise::NAME`. It may include the modules under DEPENDS and what they may.
# PRIVATE libraries stay out of the public headers; InciseDependencies.cmake must know which package brings them.
function(incise_module name)
  cmake_parse_arguments(ARG "" "" "DEPENDS;PUBLIC;PRIVATE;SOURCES" ${ARGN})
  add_library(incise_${name} STATIC ${ARG_SOURCES})
  add_library(incise::${name} ALIAS incise_${name})
  set_target_properties(incise_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ${incise_native})
  target_include_directories(incise_${name}
    PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:include>
    PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_link_libraries(incise_${name} PUBLIC incise_flags ${ARG_PUBLIC} PRIVATE $<BUILD_INTERFACE:incise_warnings>)
  foreach(library IN LISTS ARG_PRIVATE)
    incise_link_privately(${name} ${library})
  endforeach()
  foreach(dep IN LISTS ARG_DEPENDS)
    target_link_libraries(incise_${name} PUBLIC incise_${dep})
  endforeach()
  set_property(GLOBAL APPEND PROPERTY INCISE_BUILT_MODULES ${name})
endfunction()

# A user of the static library has to link `library` as well, unless it is headers only.
function(incise_link_privately name library)
  if(library IN_LIST incise_header_only)
    target_link_libraries(incise_${name} PRIVATE $<BUILD_INTERFACE:${library}>)
    return()
  endif()
  target_link_libraries(incise_${name} PRIVATE ${library})
  if(DEFINED incise_package_of_${library})
    set_property(GLOBAL APPEND PROPERTY INCISE_USED_PACKAGES ${incise_package_of_${library}})
  elseif(library MATCHES "::")
    message(FATAL_ERROR "incise_${name} links ${library}: say in cmake/InciseDependencies.cmake which package has it")
  endif()
endfunction()
