# What packages are made of (REFLET_PACKAGE): hardened, and the same bytes from any folder. As a part of another project, and
# with sanitizers, nothing of this is set, and what links the library gets none of it. packaging/hardened.sh and
# packaging/reproducible.sh check the results.
option(REFLET_PACKAGE "Hardened, and without paths of this build: what the preset `package` sets" OFF)
if(NOT PROJECT_IS_TOP_LEVEL OR NOT CMAKE_SYSTEM_NAME STREQUAL Linux OR REFLET_SANITIZE OR REFLET_FUZZ)
    return()
endif()
# These cost nothing while running, and all builds have them.
add_link_options(-Wl,-z,relro,-z,now,-z,noexecstack)
set(REFLET_HARDENED_LINK ON)  # for the test
if(REFLET_PACKAGE)
    set(hardening -fstack-protector-strong -fstack-clash-protection -Wformat -Werror=format-security)
    if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64|i.86")
        list(APPEND hardening -fcf-protection=full)
    elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "aarch64|arm64")
        list(APPEND hardening -mbranch-protection=standard)
    endif()
    # Some compilers define it themselves. Without optimization it does nothing but warn.
    if(NOT CMAKE_BUILD_TYPE STREQUAL Debug)
        list(APPEND hardening -U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=2)
    endif()
    add_compile_options(${hardening})
    set(CMAKE_POSITION_INDEPENDENT_CODE ON)
    add_link_options($<$<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>:-pie>)
    # The last that fits counts: the build folder is often inside the sources.
    add_compile_options(-ffile-prefix-map=${CMAKE_SOURCE_DIR}/= -ffile-prefix-map=${CMAKE_BINARY_DIR}/=)
endif()
