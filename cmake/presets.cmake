# Embeds presets: reflet_presets(TARGET FILE...) adds a source that defines reflet::embeddedPresets(), name and JSON of
# each file.
function(reflet_presets target)
    set(table "")
    foreach(file ${ARGN})
        set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
        get_filename_component(name ${file} NAME_WE)
        file(READ ${file} json)
        string(APPEND table "    {\"${name}\", R\"json(${json})json\"},\n")
    endforeach()
    set(source ${CMAKE_CURRENT_BINARY_DIR}/presets/embedded.cpp)
    file(CONFIGURE OUTPUT ${source} @ONLY CONTENT "// Generated: the presets.
#include \"render/presets.h\"
namespace reflet {
namespace {
constexpr EmbeddedPreset table[] = {
@table@};
}  // namespace
std::span<const EmbeddedPreset> embeddedPresets() { return table; }
}  // namespace reflet
")
    target_sources(${target} PRIVATE ${source})
endfunction()
