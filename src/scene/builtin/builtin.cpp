// The list of built-in scenes.
#include "scene/builtin.h"

#include "scene/builtin/scenes.h"

#include <algorithm>
#include <array>

namespace reflet {
namespace {

constexpr std::array<BuiltinScene, 9> scenes{{
    {"cubes", "a polished box and painted cubes on labelled tiles: first steps, reflections, contact",
     builtin::makeCubes},
    {"tilted-cube", "a tilted patterned box above a plain glossy ground: what a reflection can and cannot know",
     builtin::makeTiltedCube},
    {"cornell", "the classic box with the sun in its open front: colour bleeding", builtin::makeCornell},
    {"cave", "a grotto that the sun enters through one opening: all other light is indirect", builtin::makeCave},
    {"gloss", "roughness 0 to 1, metal and not, on labelled tiles: blurred reflections", builtin::makeGloss},
    {"colonnade", "columns, thin bars at 1, 2 and 5 m and a pierced panel: shadows", builtin::makeColonnade},
    {"mirror-hall", "a hall with a mirror wall and a mirror floor: reflections of reflections",
     builtin::makeMirrorHall},
    {"lamps", "a court at night under a hundred lamps: many lamps of limited range", builtin::makeLamps},
    {"moving", "a box that slides and stops at 1 s, a turning cube, a bending tube over gloss and mirror: motion",
     builtin::makeMoving},
}};

}  // namespace

std::span<const BuiltinScene> builtinScenes() {
    return scenes;
}

const BuiltinScene* findBuiltinScene(std::string_view name) {
    const auto* found = std::find_if(scenes.begin(), scenes.end(), [&](const auto& s) { return s.name == name; });
    return found == scenes.end() ? nullptr : found;
}

std::optional<Scene> makeBuiltinScene(std::string_view name) {
    if (const BuiltinScene* builtin = findBuiltinScene(name)) {
        return builtin->make();
    }
    const std::optional<uint32_t> triangles = builtin::tessellatedTriangles(name);
    return triangles ? std::optional(builtin::makeTessellated(*triangles)) : std::nullopt;
}

}  // namespace reflet
