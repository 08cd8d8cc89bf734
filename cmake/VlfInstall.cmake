include(CMakePackageConfigHelpers)

get_property(modules GLOBAL PROPERTY VLF_MODULES)
install(TARGETS ${modules} EXPORT vlfTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS vlf RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY src/vlf DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
install(EXPORT vlfTargets NAMESPACE vlf:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/vlf)
configure_package_config_file(cmake/vlfConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/vlfConfig.cmake
    INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/vlf)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/vlfConfigVersion.cmake
    COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/vlfConfig.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/vlfConfigVersion.cmake
              cmake/VlfDependencies.cmake
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/vlf)
