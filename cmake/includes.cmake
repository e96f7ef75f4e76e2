# Each folder of src may include only itself and the folders that are named here; cmake -P includes.cmake SOURCE_DIR
# fails with the file and line of every other include. The build runs it, so an effect that includes the scene or the
# renderer does not build.
cmake_minimum_required(VERSION 3.22)
set(base "")
set(scene base)
set(noise base)
set(compare base)
set(reference base scene compare)
set(shaders base effects noise)
set(gpu base)
set(effects base gpu shaders)
set(device base gpu)
set(renderer base gpu effects device scene noise shaders)
set(apps base gpu effects device scene noise shaders renderer reference compare)
set(view ${apps} apps)
set(folders base scene noise compare reference shaders gpu effects device renderer apps view)

foreach(folder IN LISTS folders)
    file(GLOB_RECURSE files ${SOURCE_DIR}/src/${folder}/*.h ${SOURCE_DIR}/src/${folder}/*.cpp
        ${SOURCE_DIR}/src/${folder}/*.glsl ${SOURCE_DIR}/src/${folder}/*.comp ${SOURCE_DIR}/src/${folder}/*.vert
        ${SOURCE_DIR}/src/${folder}/*.frag)
    foreach(file IN LISTS files)
        file(STRINGS ${file} lines REGEX "^#include \"[a-z_]+/")
        foreach(line IN LISTS lines)
            string(REGEX REPLACE "^#include \"([a-z_]+)/.*" "\\1" used "${line}")
            if(used IN_LIST folders AND NOT used STREQUAL folder AND NOT used IN_LIST ${folder})
                message(SEND_ERROR "${file}: ${line}\nsrc/${folder} may include only itself and: ${${folder}}")
            endif()
        endforeach()
    endforeach()
endforeach()
