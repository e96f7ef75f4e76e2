# example_shaders(TARGET [SHADER...]): compiles the room's shaders, and others, to SPIR-V, as lists of words for #include.
find_program(GLSLC glslc REQUIRED)
function(example_shaders target)
    list(TRANSFORM ARGN PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/ OUTPUT_VARIABLE sources)
    foreach(shader room.vert room.frag sun.vert light.comp)
        list(APPEND sources ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/${shader})
    endforeach()
    foreach(source IN LISTS sources)
        get_filename_component(name ${source} NAME)
        set(output ${CMAKE_CURRENT_BINARY_DIR}/${name}.inc)
        add_custom_command(OUTPUT ${output} COMMAND ${GLSLC} --target-env=vulkan1.2 -mfmt=c
            -I ${CMAKE_CURRENT_FUNCTION_LIST_DIR} -o ${output} ${source}
            DEPENDS ${source} ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/room.glsl VERBATIM)
        list(APPEND outputs ${output})
    endforeach()
    target_sources(${target} PRIVATE ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/host.c ${outputs})
    target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_FUNCTION_LIST_DIR} ${CMAKE_CURRENT_BINARY_DIR})
endfunction()
