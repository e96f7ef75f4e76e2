# Embeds text files: reflet_embed(TARGET FUNCTION FILE...) adds a source that defines reflet::FUNCTION(), which returns
# the name and the text of each file (see base/embedded.h).
function(reflet_embed target function)
    set(table "")
    foreach(file ${ARGN})
        set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
        get_filename_component(name ${file} NAME)
        file(READ ${file} text)
        string(APPEND table "    {\"${name}\", R\"embedded(${text})embedded\"},\n")
    endforeach()
    set(source ${CMAKE_CURRENT_BINARY_DIR}/embedded/${function}.cpp)
    file(CONFIGURE OUTPUT ${source} @ONLY CONTENT "// Generated: files.
#include \"base/embedded.h\"
namespace reflet {
namespace {
constexpr EmbeddedFile @function@Table[] = {
@table@};
}  // namespace
std::span<const EmbeddedFile> @function@();
std::span<const EmbeddedFile> @function@() { return @function@Table; }
}  // namespace reflet
")
    target_sources(${target} PRIVATE ${source})
endfunction()
