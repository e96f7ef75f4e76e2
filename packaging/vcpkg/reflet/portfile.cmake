# The library alone, from the sources beside this port (an overlay port): vcpkg install reflet --overlay-ports=packaging/vcpkg
# A port of a registry replaces SOURCE_PATH by vcpkg_from_git or by the archive that packaging/archive.sh makes.
get_filename_component(SOURCE_PATH "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)

vcpkg_find_acquire_program(PKGCONFIG)
vcpkg_cmake_configure(
    SOURCE_PATH "${SOURCE_PATH}"
    OPTIONS
        -DREFLET_PROGRAM=OFF
        -DREFLET_TESTS=OFF
        -DREFLET_WERROR=OFF
        "-DPKG_CONFIG_EXECUTABLE=${PKGCONFIG}"
        "-DGLSLC=${CURRENT_HOST_INSTALLED_DIR}/tools/shaderc/glslc"
)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/reflet)
vcpkg_fixup_pkgconfig()
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
file(INSTALL "${CMAKE_CURRENT_LIST_DIR}/usage" DESTINATION "${CURRENT_PACKAGES_DIR}/share/${PORT}")
