# example_shaders(TARGET): compiles the room's shaders to SPIR-V, as lists of words that host.c includes.
find_program(GLSLC glslc REQUIRED)
function(example_shaders target)
    foreach(shader room.vert room.frag sun.vert light.comp)
        set(source ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/${shader})
        set(output ${CMAKE_CURRENT_BINARY_DIR}/${shader}.inc)
        add_custom_command(OUTPUT ${output} COMMAND ${GLSLC} --target-env=vulkan1.2 -mfmt=c -o ${output} ${source}
            DEPENDS ${source} ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/room.glsl VERBATIM)
        list(APPEND outputs ${output})
    endforeach()
    target_sources(${target} PRIVATE ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/host.c ${outputs})
    target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_FUNCTION_LIST_DIR} ${CMAKE_CURRENT_BINARY_DIR})
endfunction()
