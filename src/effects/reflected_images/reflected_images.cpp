// Records what smooth surfaces show of other things.
#include "effects/reflected_images/reflected_images.h"

#include "effects/lobe/ray_tiles.h"
#include "effects/lobe/upsample.h"
#include "effects/to_previous.h"
#include "gpu/context.h"

namespace reflet {

ShownImages withReflectedImages(gpu::PassList& f, const Reflections& in, const ViewParams& view,
                                const ShownImages& shown) {
    if (in.specular.dark) {
        return shown;
    }
    constexpr VkFormat motionFormat = VK_FORMAT_R16G16_SFLOAT;
    const uvec2 size = shown.depth.size;
    const uint32_t moves = shown.motion ? 1 : 0;
    const gpu::Image motion = shown.motion ? shown.motion : f.placeholder(motionFormat);
    const gpu::Image imageMotion = in.specular.imageMotion;
    ShownImages out{f.image("shown_depth", VK_FORMAT_R32_SFLOAT, size),
                    moves != 0 ? f.image("shown_motion", motionFormat, size) : f.placeholder(motionFormat)};
    const uvec2 tiles = (size + rayTileSide - 1U) / rayTileSide;
    const gpu::BufferView list = makeTileList(f, tiles);
    f.compute("polished_tiles", "polished_tiles.comp")
        .constant("moves", moves)
        .read("depth", shown.depth)
        .read("motion", motion)
        .read("material", in.g.material)
        .write("shownDepth", out.depth)
        .write("shownMotion", out.motion)
        .write("list", list)
        .params(PolishedTilesParams{size})
        .dispatch(tiles);
    gpu::ComputePass pass = f.compute("reflected_images", "reflected_images.comp");
    bindSurfaces(f, pass, in.g).constant("lambertOnly", in.lambertOnly ? 1U : 0U);
    bindUpsampledSpecular(f, pass, in.specular)
        .constant("moves", moves)
        .constant("upscaled", in.upscaled ? 1U : 0U)
        .constant("hasImageMotion", moves != 0 && imageMotion ? 1U : 0U)
        .read("depth", in.g.depth)
        .read("frontDepth", shown.depth)
        .read("motion", motion)
        .read("imageMotion", moves != 0 && imageMotion ? imageMotion : f.placeholder(motionFormat))
        .read("normal", in.g.normal)
        .read("geometricNormal", in.g.geometricNormal)
        .read("baseColor", in.g.baseColor)
        .read("material", in.g.material)
        .read("ggxTable", in.ggxTable, f.context().sampler({VK_FILTER_LINEAR, VK_FILTER_LINEAR}))
        .read("lit", in.lit)
        .read("list", list)
        .write("shownDepth", out.depth)
        .write("shownMotion", out.motion)
        .params(ReflectedImagesParams{view, restToPreviousClip(view), blockPixelOffset(in.specular.from.scale)})
        .dispatchIndirect(list, 0);
    out.motion = moves != 0 ? out.motion : gpu::Image{};
    return out;
}

}  // namespace reflet
