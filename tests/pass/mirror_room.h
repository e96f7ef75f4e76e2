// A mirror on a wall, objects in front of it, behind it and behind the camera, and cameras that see it.
#pragma once

#include "pass/harness.h"

namespace reflet::test {

/// The mirror is called "mirror", metal; turned about its middle, (0, 1.5, -2), of which it faces +Z unturned.
struct MirrorRoom {
    float roughness = 0.0F;
    mat4 turn{1.0F};
    bool waves = false;  ///< it has a normal map
};
Scene makeMirrorRoom(const MirrorRoom& room = {});

/// From the middle of the room, with a sun that has no penumbra.
View viewOfMirrorRoom();

/// Pixels on the mirror whose neighbours have much the same values in the picture.
std::vector<bool> smoothMirrorPixels(const Pictures& p, const FloatImage& picture, float largestStep = 0.15F);

}  // namespace reflet::test
