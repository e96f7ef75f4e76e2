// Records depth of field.
#include "effects/depth_of_field/depth_of_field.h"

#include "effects/levels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>

namespace reflet {

namespace {

// The layers at half resolution.
struct Layers {
    gpu::Image ground, groundBlur, front, frontBlur;
};

constexpr VkFormat half4Format = VK_FORMAT_R16G16B16A16_SFLOAT;
constexpr VkFormat half2Format = VK_FORMAT_R16G16_SFLOAT;
constexpr VkFormat floatFormat = VK_FORMAT_R32_SFLOAT;

// cells: of level 0, with the other levels at its right (dof_layers.glsl).
Layers makeLayers(gpu::PassList& f, uvec2 cells) {
    const uvec2 levels = levelsImageSize(cells, dofLevels);
    const uvec2 size(cells.x + levels.x, std::max(cells.y, levels.y));
    return {f.image("dof.ground", half4Format, size), f.image("dof.ground_blur", half2Format, size),
            f.image("dof.front", half4Format, size), f.image("dof.front_blur", half2Format, size)};
}

gpu::ComputePass& writeLayers(gpu::ComputePass& pass, const Layers& layers) {
    return pass.write("ground", layers.ground)
        .write("groundBlur", layers.groundBlur)
        .write("front", layers.front)
        .write("frontBlur", layers.frontBlur);
}

// Area of a regular polygon inside the unit circle, or of that circle.
float shapeArea(uint32_t corners) {
    const auto n = static_cast<float>(corners);
    return corners < 3 ? glm::pi<float>() : 0.5F * n * std::sin(2.0F * glm::pi<float>() / n);
}

// The depth of what pixels show.
gpu::Image apparentDepth(gpu::PassList& f, const DofInputs& in) {
    const bool reflects = in.reflections && in.settings.reflections != 0;
    return reflects ? withReflectedImages(f, *in.reflections, in.view, {in.depth, {}}).depth : in.depth;
}

gpu::Image circleOfConfusion(gpu::PassList& f, gpu::HistoryImage& own, const DofInputs& in, float height) {
    const uvec2 size = in.depth.size;
    const gpu::History coc = own.swap(f, VK_FORMAT_R32_SFLOAT, size, gpu::Resample::nearest);
    const bool steady = in.motion && coc.valid;
    const bool orthographic = in.view.eye.w == 0.0F;
    const float pixelAngle = in.view.pixelAngle * in.view.size.y / height;  // of the picture
    const float atInfinity = in.lens.apertureRadius / (pixelAngle * (orthographic ? 1.0F : in.lens.focusDistance));
    const vec4 lens(atInfinity, 1.0F / in.lens.focusDistance, orthographic ? 1.0F : 0.0F,
                    in.settings.maxRadius * height);
    f.compute("coc", "dof_coc.comp")
        .read("depth", apparentDepth(f, in))
        .read("motion", steady ? in.motion : f.placeholder(VK_FORMAT_R16G16_SFLOAT))
        .read("previous", coc.previous)
        .write("coc", coc.next)
        .params(DofCocParams{in.view.depthToDistance, lens, size, steady ? 1U : 0U})
        .dispatch(size);
    return coc.next;
}

void makeMips(gpu::PassList& f, const Layers& layers, DofSizes sizes) {
    for (sizes.level = 1; sizes.level < dofLevels; ++sizes.level) {
        gpu::ComputePass pass = f.compute("mips." + std::to_string(sizes.level), "dof_mips.comp");
        writeLayers(pass, layers).params(sizes).dispatch(levelSize(sizes.half2, sizes.level));
    }
}

// Blocks grow with the picture, as disks do.
uint32_t blockSide(uint32_t height) {
    return height < 540 ? 4 : height < 1080 ? 8 : 16;
}

// Largest radius of disks that are drawn at full resolution. In large pictures fewer are, as cost grows with their
// area.
float fullDisk(uint32_t height) {
    return height < 540 ? 3.0F : 1.5F;
}

// What tiles hold, as dof_tiles.comp writes it, and the lists of tiles.
struct Tiles {
    gpu::Image layers, smallDisks, lists;
    gpu::BufferView heads;
};

Tiles describeTiles(gpu::PassList& f, const Layers& layers, const DofSizes& sizes) {
    const uvec2 count = (sizes.half2 + dofTile - 1U) / dofTile;
    const uint32_t rows = (count.x * count.y + dofListRow - 1U) / dofListRow;
    std::array<DofListHead, dofLists> heads{};
    heads.fill({{dofListRow, 0, 1}, 0});
    const Tiles tiles{f.image("dof.tiles", half4Format, count), f.image("dof.small_disks", half4Format, count),
                      f.image("dof.tile_lists", VK_FORMAT_R32_UINT, {dofListRow * dofGroupTiles, dofLists * rows}),
                      f.buffer("dof.heads", sizeof(heads))};
    f.update(tiles.heads, std::as_bytes(std::span(heads)));
    f.clear(tiles.lists, {.uint32 = {~0U, ~0U, ~0U, ~0U}});
    f.compute("tiles", "dof_tiles.comp")
        .read("ground", layers.ground)
        .read("groundBlur", layers.groundBlur)
        .read("front", layers.front)
        .read("frontBlur", layers.frontBlur)
        .write("tiles", tiles.layers)
        .write("smallDisks", tiles.smallDisks)
        .write("tileLists", tiles.lists)
        .write("heads", tiles.heads)
        .params(sizes)
        .dispatch(count);
    return tiles;
}

// Light that is drawn apart; as dof_highlights.comp and dof_lists.comp write it.
struct Highlights {
    gpu::Image light, shape, lists;
};

// Takes highlights out of the layers.
Highlights findHighlights(gpu::PassList& f, const Layers& layers, const Tiles& tiles, gpu::Image radiance,
                          gpu::Image coc, const DofSizes& sizes) {
    const uvec2 blocks = (sizes.size + sizes.block - 1U) / sizes.block;
    const Highlights out{f.image("dof.highlights", half4Format, blocks),
                         f.image("dof.highlight_shape", half4Format, blocks),
                         f.image("dof.lists", half4Format, tiles.layers.size)};
    gpu::ComputePass find = f.compute("highlights", "dof_highlights.comp");
    find.read("radiance", radiance).read("coc", coc).read("tiles", tiles.layers);
    writeLayers(find, layers)
        .read("tileLists", tiles.lists)
        .write("highlights", out.light)
        .write("highlightShape", out.shape)
        .params(sizes)
        .dispatchIndirect(tiles.heads, dofBright * sizeof(DofListHead));
    f.compute("lists", "dof_lists.comp")
        .read("tiles", tiles.layers)
        .write("highlights", out.light)
        .write("highlightShape", out.shape)
        .write("lists", out.lists)
        .params(sizes)
        .dispatch(tiles.layers.size);
    return out;
}

// How far the disks of each tile reach, and the tiles whose highlights reach it.
struct Reach {
    gpu::Image layers, drawn, drawnTiles;
};

// around: tiles that the largest disk reaches.
Reach makeReach(gpu::PassList& f, const Tiles& tiles, gpu::Image lists, uint32_t around) {
    const uvec2 count = tiles.layers.size;
    const Reach reach{f.image("dof.reach", half4Format, count), f.image("dof.drawn", floatFormat, count),
                      f.image("dof.drawn_tiles", floatFormat, (2U * around + 1U) * count)};
    f.compute("reach", "dof_reach.comp")
        .constant("around", around)
        .read("tiles", tiles.layers)
        .read("smallDisks", tiles.smallDisks)
        .read("lists", lists)
        .write("reach", reach.layers)
        .write("drawn", reach.drawn)
        .write("drawnTiles", reach.drawnTiles)
        .write("tileLists", tiles.lists)
        .write("heads", tiles.heads)
        .dispatch(count);
    return reach;
}

// Both layers, blurred.
struct Blurred {
    gpu::Image ground, front;
};

// large: the result for large disks, at half of `size`; none: makes it.
Blurred gather(gpu::PassList& f, const Layers& layers, const Tiles& tiles, const Reach& reach, const DofInputs& in,
               const DofSizes& sizes, const Blurred& large) {
    const bool coarse = !large.ground;
    const uvec2 size = levelSize(sizes.half2, coarse ? 1 : 0);
    const Blurred out{f.image("dof.ground_out", half4Format, size), f.image("dof.front_out", half4Format, size)};
    // Tiles that are not gathered are looked up beside others.
    f.clear(out.ground);
    f.clear(out.front);
    const gpu::Image none = f.placeholder(half4Format);
    for (const uint32_t front : {0U, dofFront}) {
        f.compute(coarse ? "gather_large" : "gather", "dof_gather.comp")
            .constant("polygon", in.lens.blades < 3 ? 0U : 1U)
            .constant("coarse", coarse ? 1U : 0U)
            .constant("hasFront", front)
            .read("ground", layers.ground)
            .read("groundBlur", layers.groundBlur)
            .read("front", layers.front)
            .read("frontBlur", layers.frontBlur)
            .read("reach", reach.layers)
            .read("tileLists", tiles.lists)
            .read("groundCoarse", coarse ? none : large.ground)
            .read("frontCoarse", coarse ? none : large.front)
            .write("groundOut", out.ground)
            .write("frontOut", out.front)
            .params(DofGatherParams{sizes.half2, in.settings.samples, sizes.disk, sizes.turn, sizes.blades})
            .dispatchIndirect(tiles.heads, ((coarse ? dofGatherLarge : dofGather) + front) * sizeof(DofListHead));
    }
    return out;
}

}  // namespace

bool blurs(const Lens& lens, const DofSettings& settings) {
    return settings.enabled != 0 && lens.apertureRadius > 0.0F;
}

DofImages depthOfField(gpu::PassList& f, gpu::HistoryImage& own, const DofInputs& in) {
    if (!blurs(in.lens, in.settings)) {
        return {in.radiance, {}};
    }
    const auto scope = f.scope("dof");
    const uvec2 size = in.radiance.size;
    const auto height = static_cast<float>(size.y);
    const gpu::Image coc = circleOfConfusion(f, own, in, height);
    const DofSizes sizes{size,
                         (size + 1U) / 2U,
                         vec2(coc.size) / vec2(size),
                         0,
                         blockSide(size.y),
                         fullDisk(size.y),
                         1.0F / shapeArea(in.lens.blades),
                         in.lens.bladeRotation,
                         in.lens.blades};
    const Layers layers = makeLayers(f, sizes.half2);
    gpu::ComputePass split = f.compute("split", "dof_split.comp");
    split.read("radiance", in.radiance).read("coc", coc);
    writeLayers(split, layers).params(sizes).dispatch(sizes.half2);
    const Tiles tiles = describeTiles(f, layers, sizes);
    const Highlights highlights = findHighlights(f, layers, tiles, in.radiance, coc, sizes);
    makeMips(f, layers, sizes);
    // Holes are filled from up to three tiles away.
    const float largest = 0.5F * in.settings.maxRadius * height;
    const uint32_t around = 1U + std::max(static_cast<uint32_t>(std::ceil(largest / static_cast<float>(dofTile))), 3U);
    const Reach reach = makeReach(f, tiles, highlights.lists, around);
    const Blurred large = gather(f, layers, tiles, reach, in, sizes, {});
    const Blurred all = gather(f, layers, tiles, reach, in, sizes, large);
    const gpu::Image result = f.image("depth_of_field", half4Format, size);
    for (uint32_t list = dofComposite; list <= dofCopy; ++list) {
        f.compute("composite", "dof_composite.comp")
            .constant("around", around)
            .constant("polygon", in.lens.blades < 3 ? 0U : 1U)
            .constant("list", list)
            .read("radiance", in.radiance)
            .read("coc", coc)
            .read("groundOut", all.ground)
            .read("frontOut", all.front)
            .read("highlights", highlights.light)
            .read("highlightShape", highlights.shape)
            .read("lists", highlights.lists)
            .read("drawn", reach.drawn)
            .read("drawnTiles", reach.drawnTiles)
            .read("reach", reach.layers)
            .read("tileLists", tiles.lists)
            .write("result", result)
            .params(sizes)
            .dispatchIndirect(tiles.heads, list * sizeof(DofListHead));
    }
    return {result, coc};
}

}  // namespace reflet
