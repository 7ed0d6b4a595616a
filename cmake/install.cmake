# `cmake --install` and the package that find_package(tamis) reads. Eigen and OpenMP are found again on the
# user's machine (tamisConfig.cmake.in), so nothing of the builder's is exported.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

set(tamis_package_dir ${CMAKE_INSTALL_DATADIR}/cmake/tamis)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/tamisConfig.cmake.in ${PROJECT_BINARY_DIR}/tamisConfig.cmake
                              INSTALL_DESTINATION ${tamis_package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/tamisConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)

install(TARGETS tamis EXPORT tamis INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT tamis NAMESPACE tamis:: FILE tamisTargets.cmake DESTINATION ${tamis_package_dir})
install(FILES ${PROJECT_BINARY_DIR}/tamisConfig.cmake ${PROJECT_BINARY_DIR}/tamisConfigVersion.cmake
              ${CMAKE_CURRENT_LIST_DIR}/tamisOptional.cmake
        DESTINATION ${tamis_package_dir})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/tamis DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        FILES_MATCHING PATTERN *.hpp)
