# Packages: `cpack` in a build folder makes a tarball of what `cmake --install` installs, and, of a build with the shared
# library (preset `package`), the Debian packages reflet (the program), python3-reflet, libreflet0 and libreflet-dev.
# packaging/check.sh makes them and tries them on a clean Debian.
set(REFLET_MAINTAINER "The Reflet authors <maintainers@reflet.invalid>" CACHE STRING "Maintainer of the packages")
set(REFLET_PACKAGE_REVISION 1)
set(CPACK_PACKAGE_NAME reflet)
set(CPACK_PACKAGE_VENDOR "The Reflet authors")
set(CPACK_PACKAGE_CONTACT "${REFLET_MAINTAINER}")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES ON)
set(CPACK_GENERATOR TGZ)
set(CPACK_COMPONENTS_ALL library development)
if(REFLET_PROGRAM)
    list(APPEND CPACK_COMPONENTS_ALL program)
endif()
if(REFLET_PROGRAM AND BUILD_SHARED_LIBS)  # others use pip: Debian's folder for modules is in no other prefix
    list(APPEND CPACK_COMPONENTS_ALL python)
    install(DIRECTORY python/reflet DESTINATION lib/python3/dist-packages COMPONENT python EXCLUDE_FROM_ALL
        FILES_MATCHING PATTERN *.py PATTERN __pycache__ EXCLUDE)
endif()

if(BUILD_SHARED_LIBS)
    list(APPEND CPACK_GENERATOR DEB)
endif()
set(library_package libreflet${REFLET_ABI})
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE ${REFLET_PACKAGE_REVISION})
set(CPACK_DEBIAN_PACKAGE_SOURCE reflet)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
# Descriptions: the first line is the summary; an empty line divides paragraphs.
set(effects "Reflet computes screen-space reflections, screen-space global
illumination, ambient occlusion, soft shadows and depth of field with Vulkan.")

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME reflet)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION graphics)
# Vulkan's loader is opened at run time, so no tool finds that it is needed.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "libvulkan1, mesa-vulkan-drivers | vulkan-icd")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "fonts-dejavu-core")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "renderer for screen-space lighting, with a path tracer
${effects}

This package has the program: it renders glTF scenes to pictures or in a
window, path traces references on the CPU, and measures errors and times.")

set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME ${library_package})
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/packaging/triggers)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION "screen-space lighting for Vulkan renderers
${effects}

This package has the library, which records the effects into a host's own
Vulkan command buffer.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libreflet-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "${library_package} (= ${PROJECT_VERSION}-${REFLET_PACKAGE_REVISION}), libvulkan-dev")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "screen-space lighting for Vulkan renderers - development files
${effects}

This package has the C header and what CMake and pkg-config need.")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-reflet)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3:any, python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS reflet)
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
    ${PROJECT_SOURCE_DIR}/packaging/python/postinst ${PROJECT_SOURCE_DIR}/packaging/python/prerm)
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "reads data sets and images of Reflet in Python
${effects}

This package has the Python module: it reads data sets for denoisers and EXR
files as NumPy arrays, and runs the program.")

# Every Debian package has these under its own name; the tarball has them once for each, too.
set(doc ${CMAKE_CURRENT_BINARY_DIR}/package)
configure_file(packaging/changelog.in ${doc}/changelog.Debian @ONLY)
find_program(GZIP gzip REQUIRED)
execute_process(COMMAND ${GZIP} -9nf ${doc}/changelog.Debian COMMAND_ERROR_IS_FATAL ANY)
configure_file(CHANGELOG.md ${doc}/changelog COPYONLY)
execute_process(COMMAND ${GZIP} -9nf ${doc}/changelog COMMAND_ERROR_IS_FATAL ANY)
set(package_of_program reflet)
set(package_of_library ${library_package})
set(package_of_development libreflet-dev)
set(package_of_python python3-reflet)
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
    set(only_packaged)
    if(component STREQUAL python)
        set(only_packaged EXCLUDE_FROM_ALL)
    endif()
    install(FILES packaging/copyright ${doc}/changelog.Debian.gz ${doc}/changelog.gz
        DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package_of_${component}} COMPONENT ${component} ${only_packaged})
endforeach()
include(CPack)
