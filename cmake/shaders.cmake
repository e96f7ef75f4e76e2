# Compiles GLSL to SPIR-V and embeds it in the target: reflet_shaders(TARGET FUNCTION FILE...) adds a source that
# defines `std::span<const reflet::gpu::Shader> FUNCTION()`: words and interfaces, by file name. The SPIR-V
# target is Vulkan 1.2, which every 1.3 device accepts: for 1.3 glslc emits work group sizes in a form that the
# reflection does not support. Not optimized (-O): llvmpipe would make pipelines in 85 % of the time, but RADV's code would
# need more registers (trace_screen: 10 waves instead of 14) and scratch memory.
# Bindings of set 0 have no numbers in the sources: the host binds by name. Those of vertex shaders start above those of
# fragment shaders (not the other way: the base would also be added to the explicit numbers of set 1).
set(glslc_command ${GLSLC} --target-env=vulkan1.2 -Werror -fauto-bind-uniforms)
foreach(kind ubo ssbo image texture sampler)
    list(APPEND glslc_command -f${kind}-binding-base vert 32)
endforeach()

function(reflet_shaders target function)
    set(folder ${CMAKE_CURRENT_BINARY_DIR}/shaders/${target})
    file(MAKE_DIRECTORY ${folder})
    set(arrays "")
    set(table "")
    set(outputs "")
    foreach(shader ${ARGN})
        get_filename_component(name ${shader} NAME)
        string(MAKE_C_IDENTIFIER ${name} symbol)
        set(output ${folder}/${name}.inc)
        add_custom_command(
            OUTPUT ${output}
            COMMAND ${glslc_command} -I ${PROJECT_SOURCE_DIR}/src -MD -MF ${output}.d -MT ${output}
                -o ${folder}/${name}.spv ${CMAKE_CURRENT_SOURCE_DIR}/${shader}
            COMMAND embed_shader ${name} ${folder}/${name}.spv ${output}
            DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${shader} embed_shader
            DEPFILE ${output}.d
            COMMENT "Shader ${name}"
            VERBATIM)
        list(APPEND outputs ${output})
        string(APPEND arrays "namespace ${symbol} {\n#include \"${output}\"\n}\n")
        string(APPEND table "    ${symbol}::shader,\n")
    endforeach()
    set(source ${folder}/embedded.cpp)
    file(GENERATE OUTPUT ${source} CONTENT "// Generated: shaders of ${target}.
#include \"gpu/shader.h\"
namespace {
${arrays}constexpr reflet::gpu::Shader ${function}Table[] = {
${table}};
}  // namespace
std::span<const reflet::gpu::Shader> ${function}();
std::span<const reflet::gpu::Shader> ${function}() { return ${function}Table; }
")
    set_source_files_properties(${source} PROPERTIES OBJECT_DEPENDS "${outputs}" SKIP_PRECOMPILE_HEADERS ON)
    target_sources(${target} PRIVATE ${source})
endfunction()
