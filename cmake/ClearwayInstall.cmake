# `cmake --install`: headers, libraries, and the package that find_package(clearway) finds.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/clearway)

install(DIRECTORY include/clearway DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT clearwayTargets NAMESPACE clearway:: DESTINATION ${package_dir})
configure_package_config_file(cmake/clearwayConfig.cmake.in clearwayConfig.cmake
  INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(clearwayConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/clearwayConfig.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/clearwayConfigVersion.cmake cmake/ClearwayOmpl.cmake DESTINATION ${package_dir})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
