# SPDX-License-Identifier: Apache-2.0
# `incise::incise`: every module at once, in the build tree and, installed, through find_package(incise).
get_property(incise_built GLOBAL PROPERTY INCISE_BUILT_MODULES)
list(REMOVE_ITEM incise_built mesh_app app session render)  # the front ends' libraries are no part of the engine
add_library(incise INTERFACE)
add_library(incise::incise ALIAS incise)
foreach(module IN LISTS incise_built)
  target_link_libraries(incise INTERFACE incise_${module})
endforeach()

if(NOT INCISE_INSTALL)
  return()
endif()

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(incise_config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/incise)
set(incise_targets incise incise_flags)
foreach(module IN LISTS incise_built)
  list(APPEND incise_targets incise_${module})
  if(IS_DIRECTORY ${PROJECT_SOURCE_DIR}/include/incise/${module})
    install(DIRECTORY include/incise/${module} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/incise)
  endif()
endforeach()
install(FILES include/incise/incise.h ${PROJECT_BINARY_DIR}/generated/incise/version.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/incise)
install(FILES LICENSE THIRD_PARTY.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT licence)
install(TARGETS ${incise_targets} EXPORT inciseTargets)
install(EXPORT inciseTargets NAMESPACE incise:: DESTINATION ${incise_config_dir})

get_property(incise_used GLOBAL PROPERTY INCISE_USED_PACKAGES)
list(REMOVE_DUPLICATES incise_used)
set(incise_find_dependencies "find_dependency(Eigen3 3.4)\n")
foreach(package IN LISTS incise_used)
  string(APPEND incise_find_dependencies "find_dependency(${package})\n")
endforeach()
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/inciseConfig.cmake.in
  ${PROJECT_BINARY_DIR}/generated/inciseConfig.cmake INSTALL_DESTINATION ${incise_config_dir})
# Before 1.0 a minor version may break its users, so 0.1 does not accept 0.2.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/generated/inciseConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/generated/inciseConfig.cmake
              ${PROJECT_BINARY_DIR}/generated/inciseConfigVersion.cmake DESTINATION ${incise_config_dir})
