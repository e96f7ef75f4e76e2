# libreflet: the effects behind the C API of include/reflet/reflet.h. One library of all objects that it needs, shared
# (BUILD_SHARED_LIBS) or static; what it exports begins with `reflet`.
include(cmake/embed.cmake)
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

file(GLOB api CONFIGURE_DEPENDS src/api/*.cpp src/api/*.h)
set(library_parts reflet_core reflet_gpu reflet_noise reflet_effects reflet_lighting)
add_library(reflet ${api})
foreach(part IN LISTS library_parts)
    target_sources(reflet PRIVATE $<TARGET_OBJECTS:${part}>)
    add_dependencies(reflet ${part})
endforeach()
add_library(reflet::reflet ALIAS reflet)
# The soname is libreflet.so.0. The number is that of the ABI, not of the version: see CONTRIBUTING.md.
set(REFLET_ABI 0)
set_target_properties(reflet PROPERTIES VERSION ${REFLET_ABI}.${PROJECT_VERSION} SOVERSION ${REFLET_ABI}
    POSITION_INDEPENDENT_CODE ON)
target_include_directories(reflet PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
target_include_directories(reflet PRIVATE src)
target_compile_definitions(reflet PRIVATE REFLET_BUILD)
if(NOT BUILD_SHARED_LIBS)
    target_compile_definitions(reflet INTERFACE REFLET_STATIC)
    if(NOT REFLET_TESTS) # which make a shared library of the same objects
        target_compile_definitions(reflet PRIVATE REFLET_STATIC)
    endif()
endif()
target_link_libraries(reflet PUBLIC Vulkan::Headers)
target_link_libraries(reflet PRIVATE $<BUILD_INTERFACE:reflet_options> $<BUILD_INTERFACE:glm::glm>
    $<BUILD_INTERFACE:reflet_fmt> $<BUILD_INTERFACE:nlohmann_json::nlohmann_json>)
reflet_quick(reflet)
set(library_presets src/renderer/presets/fast.json src/renderer/presets/balanced.json src/renderer/presets/quality.json)
reflet_embed(reflet libraryPresets ${library_presets})
# Templates of the C++ library are weak and visible whatever the flags say; the list of exports is what counts.
if(BUILD_SHARED_LIBS AND UNIX AND NOT APPLE)
    set(exports ${PROJECT_SOURCE_DIR}/cmake/exports.map)
    target_link_options(reflet PRIVATE -Wl,--version-script=${exports})
    set_target_properties(reflet PROPERTIES LINK_DEPENDS ${exports})
endif()

# The shared library, for the test of its exports, of the same objects.
if(REFLET_TESTS AND NOT BUILD_SHARED_LIBS AND UNIX AND NOT APPLE)
    add_library(reflet_exports SHARED $<TARGET_OBJECTS:reflet>)
    set_target_properties(reflet_exports PROPERTIES SOVERSION ${REFLET_ABI} LINKER_LANGUAGE CXX)
    target_link_options(reflet_exports PRIVATE -Wl,--version-script=${PROJECT_SOURCE_DIR}/cmake/exports.map)
    target_link_libraries(reflet_exports PRIVATE reflet_options)
elseif(REFLET_TESTS)
    add_library(reflet_exports ALIAS reflet)
endif()

# The API reference: cmake --build build --target docs writes html/ in the build folder.
find_package(Doxygen QUIET)
if(Doxygen_FOUND AND PROJECT_IS_TOP_LEVEL)
    set(DOXYGEN_OPTIMIZE_OUTPUT_FOR_C YES)
    set(DOXYGEN_JAVADOC_AUTOBRIEF YES)
    set(DOXYGEN_EXTRACT_ALL NO)
    set(DOXYGEN_WARN_AS_ERROR YES)
    set(DOXYGEN_MACRO_EXPANSION YES)
    set(DOXYGEN_EXPAND_ONLY_PREDEF YES)
    set(DOXYGEN_PREDEFINED REFLET_API=)
    doxygen_add_docs(docs include/reflet COMMENT "API reference")
endif()

if(REFLET_INSTALL)
    install(TARGETS reflet EXPORT refletTargets
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library NAMELINK_COMPONENT development
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
        RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT library)
    install(DIRECTORY include/reflet DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
    set(package ${CMAKE_INSTALL_LIBDIR}/cmake/reflet)
    install(EXPORT refletTargets NAMESPACE reflet:: DESTINATION ${package} COMPONENT development)
    configure_package_config_file(cmake/refletConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/refletConfig.cmake
        INSTALL_DESTINATION ${package})
    write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/refletConfigVersion.cmake COMPATIBILITY SameMinorVersion)
    install(FILES ${CMAKE_CURRENT_BINARY_DIR}/refletConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/refletConfigVersion.cmake
        DESTINATION ${package} COMPONENT development)
    file(RELATIVE_PATH pc_up "/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/")
    set(pc_static_define "")
    if(NOT BUILD_SHARED_LIBS)
        set(pc_static_define " -DREFLET_STATIC")
    endif()
    configure_file(cmake/reflet.pc.in ${CMAKE_CURRENT_BINARY_DIR}/reflet.pc @ONLY)
    install(FILES ${CMAKE_CURRENT_BINARY_DIR}/reflet.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
endif()
