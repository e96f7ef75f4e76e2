// Scenes: .gltf and .glb, with all that is inside them.
#include "scene/gltf/gltf.h"
#include "fuzz.h"
#include "scene/pose.h"

FUZZ_TARGET(gltf) {
    const auto path = file("scene.glb", bytes, size);
    return survive([&] {
        const Scene scene = loadGltf(path, {});
        (void)scenePose(scene, 0.7);
    });
}
