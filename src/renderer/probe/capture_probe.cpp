// Captures probes and tracks when captures are out of date.
#include "renderer/probe/capture_probe.h"

#include "gpu/context.h"
#include "renderer/sub_views.h"
#include "renderer/view_params.h"

#include <algorithm>
#include <array>
#include <bit>

namespace reflet {

Camera cubeFaceCamera(const Probe& probe, uint32_t face) {
    constexpr float usualNear = 0.01F;
    constexpr float ofBox = 1e-3F;  // in scenes of a few centimetres, walls would be nearer than the usual near plane
    static constexpr std::array<vec3, probeFaces> forward{vec3(1, 0, 0),  vec3(-1, 0, 0), vec3(0, 1, 0),
                                                          vec3(0, -1, 0), vec3(0, 0, 1),  vec3(0, 0, -1)};
    static constexpr std::array<vec3, probeFaces> up{vec3(0, 1, 0), vec3(0, 1, 0), vec3(0, 0, -1),
                                                     vec3(0, 0, 1), vec3(0, 1, 0), vec3(0, 1, 0)};
    Camera camera;
    camera.position = probe.position;
    camera.target = probe.position + forward.at(face);
    camera.up = up.at(face);
    camera.fovY = glm::half_pi<float>();
    camera.near = std::min(usualNear, ofBox * glm::length(probe.box.size()));
    return camera;
}

namespace {

ProbeBlock blockOf(std::span<const Probe> probes, const ProbesSettings& settings) {
    ProbeBlock block{};
    block.count = static_cast<uint32_t>(std::min<size_t>(probes.size(), maxProbes));
    for (uint32_t i = 0; i < block.count; ++i) {
        const Aabb& box = probes[i].box;
        block.probes[i] = {.position = probes[i].position,
                           .blend = settings.reach * glm::length(box.size()),
                           .boxMin = box.min,
                           .parallax = static_cast<uint32_t>(ProbeParallax::depth),
                           .boxMax = box.max,
                           .radianceScale = 1.0F,
                           .parallaxMin = box.min,
                           .unused2 = 0.0F,
                           .parallaxMax = box.max};
    }
    return block;
}

template <class T>
void append(std::vector<std::byte>& bytes, const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    const auto more = std::as_bytes(std::span(&value, 1));
    bytes.insert(bytes.end(), more.begin(), more.end());
}

VkSampler probeSampler(gpu::Context& context) {
    return context.sampler({VK_FILTER_LINEAR, VK_FILTER_LINEAR, VK_SAMPLER_MIPMAP_MODE_LINEAR});
}

// Emitters move with the scene.
LampBlock withoutMotion(LampBlock lamps) {
    for (uint32_t i = 0; i < lamps.count; ++i) {
        if (lamps.lamps[i].type == lampEmitter) {
            lamps.lamps[i] = LampParams{.type = lampEmitter, .intensity = lamps.lamps[i].intensity};
        }
    }
    return lamps;
}

// Everything that the maps depend on, except for the scene, whose motion matters only with refresh moving. With refresh
// face, captures follow the lights by themselves.
std::vector<std::byte> keyOf(const ProbeBlock& block, const ViewInputs& in, const Settings& settings) {
    std::vector<std::byte> key;
    key.reserve(sizeof(block) + sizeof(in.lamps) + sizeof(settings));  // one allocation each frame
    append(key, block);
    append(key, settings.probes.refresh);
    append(key, settings.probes.resolution);
    if (settings.probes.refresh == ProbeRefresh::face) {
        return key;
    }
    append(key, settings.materials);
    append(key, settings.shadow);
    append(key, in.sunDirection);
    append(key, in.sunIrradiance);
    append(key, withoutMotion(in.lamps));
    append(key, settings.probes.refresh == ProbeRefresh::moving ? in.time : 0.0);
    append(key, settings.probes.bounces);
    if (settings.probes.bounces > 0) {
        append(key, in.environment.params);
        append(key, in.environment.texels.state);
    }
    return key;
}

}  // namespace

void Probes::makeMaps(gpu::Context& context, uint32_t resolution) {
    constexpr VkImageUsageFlags usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT |
                                        VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    const uint32_t side = std::bit_floor(resolution);
    const uint32_t layers = block_.count * probeFaces;
    const gpu::ImageInfo distance{VK_FORMAT_R32_SFLOAT, uvec2(side), 1, layers, usage, gpu::ViewKind::cubeArray};
    if (distance_.info() != distance) {
        map_ = CubeMap(context, side, block_.count, "probes");
        distance_ = gpu::Texture(context, distance, "probes.distance");
        const uvec2 all = side * uvec2(probeFaces, block_.count);
        atlas_ = gpu::Texture(context, {VK_FORMAT_R16G16B16A16_SFLOAT, all, 1, 1, usage}, "probes.atlas");
    }
    if (splits_ && !(matte_.sharp.info() == map_.sharp.info())) {
        matte_ = CubeMap(context, side, block_.count, "probes.matte");
    }
}

Probes::Captured Probes::makeCaptured(gpu::PassList& f) const {
    const auto scope = f.scope("probe");
    const uvec2 size = distance_.info().size;
    const uint32_t faces = block_.count * probeFaces;
    return {f.image("lit", VK_FORMAT_R16G16B16A16_SFLOAT, size, faces, true),
            f.image("surface", VK_FORMAT_R32G32B32A32_UINT, size, faces, true)};
}

gpu::Image Probes::captureFace(gpu::PassList& f, const Capture& capture, uint32_t face, gpu::Image lampShadowMap) {
    const auto scope = f.scope("probe");
    const uvec2 size = distance_.info().size;
    const ProbeParams& probe = block_.probes[face / probeFaces];
    ViewInputs in = capture.in;
    in.forProbe = true;
    in.view = makeViewParams(cubeFaceCamera({probe.position, {probe.boxMin, probe.boxMax}}, face % probeFaces), size,
                             in.view);
    const ViewImages images = directView(f, faces_, in, captureSettings(capture.settings), lampShadowMap);
    gpu::ComputePass pass = f.compute("capture_probe", "capture_probe.comp");
    bindSurfaces(f, pass, images.g);
    pass.constant("splits", splits_ ? 1U : 0U)
        .read("emissive", images.g.emissive)
        .read("depth", images.g.depth)
        .read("normal", images.g.normal)
        .read("baseColor", images.g.baseColor)
        .read("material", images.g.material)
        .read("ggxTable", in.ggxTable, f.context().sampler({VK_FILTER_LINEAR, VK_FILTER_LINEAR}))
        .read("direct", images.direct)
        .write("lit", capture.out.lit)
        .write("surface", capture.out.surface)
        .write("distance", distance_.mip(0))
        .params(CaptureProbeParams{in.view, face})
        .dispatch(size);
    return images.lampShadowMap;
}

void Probes::relight(gpu::PassList& f, const Capture& capture, const CubeFaces& faces, bool furtherLight) {
    const auto scope = f.scope("probe");
    const uvec2 size = distance_.info().size;
    gpu::ComputePass pass = f.compute("relight_probes", "relight_probes.comp");
    pass.params(capture.in.environment.params, "environment");  // without its texels, which are not used here
    bindEnvironmentLobes(pass, f.context(), capture.in.environment);
    pass.constant("furtherLight", furtherLight ? 1U : 0U)
        .constant("splits", splits_ ? 1U : 0U)
        .read("lit", capture.out.lit)
        .read("surface", capture.out.surface)
        .read("probeLobes", map_.lobes.image(), probeSampler(f.context()))
        .read("probeIrradiance", forDiffuse().irradiance.image())
        .read("probeDistance", distance_.image(), probeSampler(f.context()))
        .write("sharp", map_.sharp.mip(0))
        .write("matte",
               splits_ ? matte_.sharp.mip(0) : f.placeholder(VK_FORMAT_R16G16B16A16_SFLOAT, gpu::ViewKind::array))
        .write("atlas", atlas_.image())
        .params(RelightProbesParams{faces.first, block_})
        .dispatch(size.x, size.y, faces.count);
}

void Probes::filter(gpu::PassList& f, uint32_t firstCube, uint32_t count, CubeLobeSamples samples) {
    const auto scope = f.scope("probe");
    filterCubeMap(f, map_, firstCube, count, samples);
    if (splits_) {
        makeCubeMips(f, matte_, {6 * firstCube, 6 * count});
        projectCubeIrradiance(f, matte_, firstCube, count);
    }
}

void Probes::captureAll(gpu::PassList& f, const ViewInputs& in, const Settings& settings) {
    const Capture capture{in, settings, makeCaptured(f)};
    const CubeFaces faces{0, block_.count * probeFaces};
    gpu::Image lampShadowMap;
    for (uint32_t face = 0; face < faces.count; ++face) {
        lampShadowMap = captureFace(f, capture, face, lampShadowMap);
    }
    for (uint32_t bounce = 0; bounce <= settings.probes.bounces; ++bounce) {
        relight(f, capture, faces, bounce > 0);
        // Each bounce's lobes are seen by the next bounce alone, the last one's by the camera.
        filter(f, 0, block_.count, bounce < settings.probes.bounces ? CubeLobeSamples::few : CubeLobeSamples::all);
    }
}

void Probes::captureNextFace(gpu::PassList& f, const ViewInputs& in, const Settings& settings) {
    const uint32_t faces = block_.count * probeFaces;
    const uint32_t face = facesCaptured_ % faces;
    const Capture capture{in, settings, makeCaptured(f)};
    captureFace(f, capture, face);
    relight(f, capture, {face, 1}, settings.probes.bounces > 0 && facesCaptured_ >= faces);
    ++facesCaptured_;
    if (face % probeFaces == probeFaces - 1) {
        filter(f, face / probeFaces, 1, CubeLobeSamples::all);
    }
}

void Probes::restart(bool sceneMoves) {
    if (byFace_ || sceneMoves) {
        key_.clear();
    }
}

ProbeMaps Probes::update(gpu::PassList& f, const ViewInputs& in, std::span<const Probe> probes,
                         const Settings& settings) {
    if (settings.probes.enabled == 0 || probes.empty()) {
        return {};
    }
    block_ = blockOf(probes, settings.probes);
    std::vector<std::byte> key = keyOf(block_, in, settings);
    const bool changed = key != key_ || splits_ != anyEmitters(in.lamps);
    splits_ = anyEmitters(in.lamps);
    byFace_ = settings.probes.refresh == ProbeRefresh::face;
    key_ = std::move(key);
    if (changed) {
        makeMaps(f.context(), settings.probes.resolution);
        facesCaptured_ = 0;
    }
    if (byFace_) {
        if (changed) {  // nothing is captured yet
            f.clear(map_.lobes.image());
            f.clear(map_.irradiance.image());
            if (splits_) {
                f.clear(matte_.sharp.image());
                f.clear(matte_.irradiance.image());
            }
            f.clear(atlas_.image());
        }
        captureNextFace(f, in, settings);
    } else if (changed) {
        captureAll(f, in, settings);
    }
    return {map_.lobes.image(),
            splits_ ? matte_.sharp.image() : map_.lobes.image(),
            forDiffuse().irradiance.image(),
            distance_.image(),
            atlas_.image(),
            settings.probes.parallax,
            block_};
}

}  // namespace reflet
