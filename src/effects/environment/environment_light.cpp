// Records the prefiltering of the environment.
#include "effects/environment/environment_light.h"

#include "gpu/context.h"

namespace reflet {

void bindEnvironment(gpu::ComputePass& pass, const EnvironmentLight& light) {
    pass.constant("environmentIsOneColor", light.texels.size == uvec2(1) ? 1U : 0U)
        .read("environmentTexels", light.texels)
        .params(light.params, "environment");
}

void bindEnvironmentLobes(gpu::ComputePass& pass, gpu::Context& context, const EnvironmentLight& light) {
    const VkSampler linear = context.sampler({VK_FILTER_LINEAR, VK_FILTER_LINEAR, VK_SAMPLER_MIPMAP_MODE_LINEAR});
    pass.read("environmentLobes", light.lobes, linear).read("environmentIrradiance", light.irradiance);
}

void prefilterEnvironment(gpu::PassList& f, const CubeMap& cube, gpu::Image texels) {
    const gpu::Image faces = cube.sharp.mip(0);
    f.compute("environment_cube", "environment_cube.comp")
        .read("texels", texels)
        .write("faces", faces)
        .dispatch(faces.size.x, faces.size.y, faces.layers);
    filterCubeMap(f, cube, 0, 1);
}

}  // namespace reflet
