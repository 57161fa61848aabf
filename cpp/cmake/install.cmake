include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

# In a wheel everything must lie inside the Python package; `carom --cmake-dir` prints where.
set(carom_prefix "")
if(DEFINED SKBUILD)
  set(carom_prefix carom/cpp/)
  set(CMAKE_INSTALL_LIBDIR lib)
  set(CMAKE_INSTALL_INCLUDEDIR include)
endif()
set(carom_cmake_dir ${carom_prefix}${CMAKE_INSTALL_LIBDIR}/cmake/carom)

target_include_directories(carom PUBLIC
  $<INSTALL_INTERFACE:${carom_prefix}${CMAKE_INSTALL_INCLUDEDIR}>)
install(TARGETS carom EXPORT carom_targets ARCHIVE DESTINATION ${carom_prefix}${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY cpp/include/ DESTINATION ${carom_prefix}${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT carom_targets NAMESPACE carom:: DESTINATION ${carom_cmake_dir})

configure_package_config_file(cpp/cmake/carom-config.cmake.in
  ${CMAKE_CURRENT_BINARY_DIR}/carom-config.cmake INSTALL_DESTINATION ${carom_cmake_dir})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/carom-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/carom-config.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/carom-config-version.cmake DESTINATION ${carom_cmake_dir})
if(NOT DEFINED SKBUILD)
  install(FILES package.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/carom)  # for colcon
endif()
