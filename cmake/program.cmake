# The program `reflet`: scenes, renderer, reference, comparison, window. Its libraries are Debian packages, see setup.sh.
find_package(CLI11 REQUIRED)
pkg_check_modules(TINYGLTF REQUIRED IMPORTED_TARGET tinygltf)
find_package(Draco REQUIRED)
pkg_check_modules(OPENEXR REQUIRED IMPORTED_TARGET OpenEXR)
pkg_check_modules(SPNG REQUIRED IMPORTED_TARGET spng)
pkg_check_modules(JPEG REQUIRED IMPORTED_TARGET libjpeg)
pkg_check_modules(XXHASH REQUIRED IMPORTED_TARGET libxxhash)
pkg_check_modules(STB REQUIRED IMPORTED_TARGET stb)
pkg_check_modules(WEBP REQUIRED IMPORTED_TARGET libwebp)
pkg_check_modules(WEBPMUX REQUIRED IMPORTED_TARGET libwebpmux libwebp)
pkg_check_modules(ZSTD REQUIRED IMPORTED_TARGET libzstd)
find_package(meshoptimizer REQUIRED)
pkg_check_modules(IMGUI IMPORTED_TARGET imgui)
pkg_check_modules(GLFW IMPORTED_TARGET glfw3)
find_package(TBB REQUIRED)
find_package(embree 4 QUIET)
if(NOT embree_FOUND)
    find_package(embree 3 REQUIRED)
endif()

# Files, JSON, images.
file(GLOB base CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR} src/base/*.cpp src/base/*.h)
list(REMOVE_ITEM base ${core})
reflet_library_of(reflet_base "${base}" reflet_core nlohmann_json::nlohmann_json PRIVATE PkgConfig::OPENEXR PkgConfig::SPNG
    PkgConfig::JPEG)
# tinygltf must be linked before draco: Debian's libdraco exports its own copy of tinygltf, which crashes if it is
# linked instead of the real one.
reflet_library(reflet_scene scene reflet_base PRIVATE PkgConfig::TINYGLTF Draco::Draco PkgConfig::WEBP PkgConfig::ZSTD
    meshoptimizer::meshoptimizer)
reflet_library(reflet_reference reference reflet_scene PRIVATE embree TBB::tbb)
target_compile_definitions(reflet_reference PRIVATE REFLET_EMBREE_MAJOR=${EMBREE_VERSION_MAJOR})
reflet_library(reflet_compare compare reflet_base)
# The program's way to a device: opens one, submits, waits, presents.
reflet_library(reflet_device device reflet_gpu PUBLIC ${CMAKE_DL_LIBS} PRIVATE PkgConfig::XXHASH)

# The deferred renderer: draws scenes, and lights them by the stages.
reflet_library(reflet_renderer renderer reflet_lighting reflet_device reflet_scene reflet_noise)
file(GLOB_RECURSE renderer_shaders CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR} src/renderer/*.vert
    src/renderer/*.frag src/renderer/*.comp)
reflet_shaders(reflet_renderer rendererShaders ${renderer_shaders})
file(GLOB presets CONFIGURE_DEPENDS src/renderer/presets/*.json)
reflet_embed(reflet_renderer embeddedPresets ${presets})

# Images of frames; what is rendered, and sequences of it; measurements; the subcommands.
reflet_library(reflet_capture capture reflet_renderer)
reflet_library(reflet_job job reflet_capture reflet_reference PRIVATE PkgConfig::WEBPMUX PkgConfig::XXHASH
    PkgConfig::STB)
include(cmake/version.cmake)
reflet_version(reflet_job)
reflet_library(reflet_measure measure reflet_job reflet_compare)
file(GLOB report_files CONFIGURE_DEPENDS src/measure/report/*.css src/measure/report/*.js)
reflet_embed(reflet_measure reportFiles ${report_files})
reflet_embed(reflet_measure qualifyFiles src/measure/qualify/grids.json
    src/measure/qualify/model.json)
reflet_library(reflet_dataset dataset reflet_job)
reflet_library(reflet_cli cli reflet_measure reflet_dataset PUBLIC CLI11::CLI11)

add_executable(reflet_program src/main.cpp)
set_target_properties(reflet_program PROPERTIES OUTPUT_NAME reflet)
target_link_libraries(reflet_program PRIVATE reflet_cli)
# The window, where its libraries are.
if(TARGET PkgConfig::IMGUI AND TARGET PkgConfig::GLFW)
    reflet_library(reflet_view view reflet_cli reflet_reflection PRIVATE PkgConfig::IMGUI PkgConfig::GLFW)
    file(GLOB view_shaders CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR} src/view/*.vert src/view/*.frag
        src/view/*.comp)
    reflet_shaders(reflet_view refletViewShaders ${view_shaders})
    # Paths for hot reloading of edited shaders, used if the sources exist at run time. A package has only `--shaders`:
    # who has a folder of that name on another machine must not be asked for code.
    list(JOIN glslc_command " " glslc_line)
    set(shader_sources ${PROJECT_SOURCE_DIR}/src)
    if(REFLET_PACKAGE)
        set(shader_sources "")
    endif()
    target_compile_definitions(reflet_view PRIVATE REFLET_SHADER_SOURCES="${shader_sources}" REFLET_GLSLC="${glslc_line}")
    target_compile_definitions(reflet_program PRIVATE REFLET_WINDOW)
    target_link_libraries(reflet_program PRIVATE reflet_view)
else()
    message(STATUS "Without the window: Dear ImGui (libimgui-dev) or GLFW (libglfw3-dev) is not installed")
endif()

if(REFLET_INSTALL)
    install(TARGETS reflet_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
    include(cmake/desktop.cmake)
endif()
