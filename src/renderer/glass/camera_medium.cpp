// Finds the volume that the camera is in, and records its attenuation.
#include "renderer/glass/camera_medium.h"

#include "renderer/material.h"

#include <algorithm>

namespace reflet {

namespace {

bool mayHold(const Draw& draw, const vec3& eye) {
    return draw.glass && glm::all(glm::greaterThanEqual(eye, draw.boundsW.min)) &&
           glm::all(glm::lessThanEqual(eye, draw.boundsW.max));
}

}  // namespace

std::optional<CameraMedium> cameraMedium(VolumeFinder& volumes, const Scene& scene, const ScenePose* pose,
                                         const DrawList& list, const Camera& camera) {
    if (!list.glass || std::ranges::none_of(list.draws, [&](const Draw& d) { return mayHold(d, camera.position); })) {
        return std::nullopt;
    }
    const std::vector<uint32_t> around = volumes.around(scene, pose, camera);
    if (around.empty()) {
        return std::nullopt;
    }
    const auto materialOf = [&](uint32_t instance) { return scene.meshes[scene.instances[instance].mesh].material; };
    const uint32_t material = materialOf(around.back());
    CameraMedium medium{.draw = around.back(),
                        .kind = glassKind(materialAt(scene, pose, material), material + 1),
                        .extinction = materialParams(materialAt(scene, pose, material)).extinction};
    if (around.size() > 1) {
        medium.outerIor = std::max(materialAt(scene, pose, materialOf(around[around.size() - 2])).ior, 1.0F);
    }
    return medium;
}

lighting::Light throughMedium(gpu::PassList& f, const CameraMedium& medium, const ViewParams& view,
                              const lighting::Light& light) {
    const auto scope = f.scope("glass");
    const auto attenuated = [&](gpu::Image layer) {
        if (!layer) {
            return layer;
        }
        const gpu::Image out = f.image("lit.medium", VK_FORMAT_R16G16B16A16_SFLOAT, layer.size);
        f.compute("camera_medium", "camera_medium.comp")
            .read("depth", light.depth)
            .read("behind", layer)
            .write("over", out)
            .params(CameraMediumParams{view, medium.extinction})
            .dispatch(out.size);
        return out;
    };
    lighting::Light out = light;
    out.lit = attenuated(light.lit);
    out.direct = attenuated(light.direct);
    out.indirectDiffuse = attenuated(light.indirectDiffuse);
    out.indirectSpecular = attenuated(light.indirectSpecular);
    return out;
}

}  // namespace reflet
