# cmake --install: the program, the static library, its one public header, and find_package(lanecast).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS lanecast_lib EXPORT lanecast_targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS lanecast RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(FILES src/lanecast/lanecast.hpp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/lanecast)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/lanecast)
configure_package_config_file(cmake/lanecast-config.cmake.in ${CMAKE_BINARY_DIR}/lanecast-config.cmake
  INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/lanecast-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/lanecast-config.cmake ${CMAKE_BINARY_DIR}/lanecast-config-version.cmake
  DESTINATION ${package_dir})
install(EXPORT lanecast_targets NAMESPACE lanecast:: FILE lanecast-targets.cmake DESTINATION ${package_dir})
