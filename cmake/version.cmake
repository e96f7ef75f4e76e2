# reflet_version(TARGET): writes version.h, `reflet::versionText` ("0.2.0 (a1b2c3d)"), anew at every build, and only if
# it has changed. Run as a script (cmake -P), it is the build step that does so.
if(CMAKE_SCRIPT_MODE_FILE)
    cmake_policy(VERSION 3.22)
    execute_process(COMMAND git -C ${source} describe --always --dirty --abbrev=10 --exclude=*
        OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
    if(failed) # a source archive
        set(text ${version})
    else()
        set(text "${version} (${commit})")
    endif()
    file(CONFIGURE OUTPUT ${output} @ONLY CONTENT "// Generated: version and commit.
#pragma once

namespace reflet {
inline constexpr const char* versionText = \"@text@\";
}  // namespace reflet
")
    return()
endif()

function(reflet_version target)
    set(folder ${CMAKE_CURRENT_BINARY_DIR}/version)
    set(output ${folder}/version.h)
    add_custom_target(reflet_version BYPRODUCTS ${output}
        COMMAND ${CMAKE_COMMAND} -Dsource=${PROJECT_SOURCE_DIR} -Dversion=${PROJECT_VERSION} -Doutput=${output}
            -P ${PROJECT_SOURCE_DIR}/cmake/version.cmake
        COMMENT "Version" VERBATIM)
    add_dependencies(${target} reflet_version)
    target_include_directories(${target} PUBLIC ${folder})
endfunction()
