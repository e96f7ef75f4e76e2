// The list of built-in scenes.
#include "scene/builtin.h"

#include "scene/builtin/motion_scenes.h"
#include "scene/builtin/scenes.h"

#include <algorithm>
#include <array>

namespace reflet {
namespace {

constexpr std::array<BuiltinScene, 13> scenes{{
    {"cubes", "a polished box and painted cubes on labelled tiles: reflections, contact shadows, first steps",
     builtin::makeCubes},
    {"tilted-cube",
     "a tilted box with numbered faces above a glossy floor: reflections of faces that the camera does not see",
     builtin::makeTiltedCube},
    {"cornell", "the Cornell box, sunlit through its open front: colour bleeding", builtin::makeCornell},
    {"cave", "a cave with sunlight through a single shaft: indirect light", builtin::makeCave},
    {"gloss", "metals and dielectrics of roughness 0 to 1 on labelled tiles: glossy reflections", builtin::makeGloss},
    {"colonnade", "columns, thin bars at heights of 1, 2 and 5 m and a perforated panel: soft shadows",
     builtin::makeColonnade},
    {"mirror-hall", "a hall with a mirror wall and a mirror floor: planar reflections, mirrors in mirrors",
     builtin::makeMirrorHall},
    {"lamps", "a courtyard at night with a hundred lamps: many lights of limited range", builtin::makeLamps},
    {"moving",
     "a box that slides and stops at 1 s, a rotating cube and a bending tube on glossy and mirror floors: motion",
     builtin::makeMoving},
    {"lens", "near rods, figures in focus, far lamps before a wall, a wide aperture: depth of field",
     builtin::makeLens},
    {"glass", "clear, frosted and tinted glass, panes and a bottle with liquid before labelled tiles: refraction",
     builtin::makeGlass},
    {"quay",
     "a long quay at dusk: a low sun in the sky's image, tiny bulbs, wet paving, a swinging lantern, moving cloth",
     builtin::makeQuay},
    {"street",
     "a wet street at night: puddles, neon signs, lit windows, street lamps, a car of clear-coated paint: everything",
     builtin::makeStreet},
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
    if (std::optional<Scene> scene = builtin::makeMotionScene(name)) {
        return scene;
    }
    const std::optional<uint32_t> triangles = builtin::tessellatedTriangles(name);
    return triangles ? std::optional(builtin::makeTessellated(*triangles)) : std::nullopt;
}

}  // namespace reflet
