// Records the captures of probes, and knows when they are out of date.
#include "render/probe/capture_probe.h"

#include "render/view_params.h"

#include <algorithm>
#include <array>

namespace reflet {

Camera cubeFaceCamera(const vec3& position, uint32_t face) {
    static constexpr std::array<vec3, probeFaces> forward{vec3(1, 0, 0),  vec3(-1, 0, 0), vec3(0, 1, 0),
                                                          vec3(0, -1, 0), vec3(0, 0, 1),  vec3(0, 0, -1)};
    static constexpr std::array<vec3, probeFaces> up{vec3(0, 1, 0), vec3(0, 1, 0), vec3(0, 0, -1),
                                                     vec3(0, 0, 1), vec3(0, 1, 0), vec3(0, 1, 0)};
    Camera camera;
    camera.position = position;
    camera.target = position + forward.at(face);
    camera.up = up.at(face);
    camera.fovY = glm::half_pi<float>();
    camera.near = 0.01F;
    return camera;
}

namespace {

ProbeBlock blockOf(std::span<const Probe> probes) {
    ProbeBlock block{};
    block.count = static_cast<uint32_t>(std::min<size_t>(probes.size(), maxProbes));
    for (uint32_t i = 0; i < block.count; ++i) {
        block.probes[i] = {probes[i].position, probes[i].box.min, probes[i].box.max};
    }
    return block;
}

// What shows in captures as much as in the picture, at the least cost.
Settings captureSettings(const Settings& settings) {
    Settings s = settings;
    s.depth = {};
    s.contact.distance = 0.0F;
    s.traceScreen.method = TraceMethod::linear;  // no pyramid
    s.traceScreen.thicknessFrom = ThicknessFrom::constant;
    if (s.shadow.filter != ShadowFilter::none) {
        s.shadow.filter = ShadowFilter::hard;
    }
    s.shadow.cascades = 1;
    s.shadow.resolution = std::min(s.shadow.resolution, 1024U);
    return s;
}

template <class T>
void append(std::vector<std::byte>& bytes, const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    std::ranges::copy(std::as_bytes(std::span(&value, 1)), std::back_inserter(bytes));
}

// All that the maps depend on but the scene, which does not change.
std::vector<std::byte> keyOf(const ProbeBlock& block, const ViewInputs& in, const Settings& settings) {
    std::vector<std::byte> key;
    append(key, block);
    append(key, settings.probes.resolution);
    append(key, settings.probes.refresh);
    append(key, settings.materials);
    append(key, settings.shadow);
    append(key, in.sunDirection);
    append(key, in.sunIrradiance);
    append(key, in.lamps);
    return key;
}

}  // namespace

void Probes::makeMaps(uint32_t resolution) {
    constexpr VkImageUsageFlags usage =
        VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    const uint32_t layers = block_.count * probeFaces;
    const gpu::ImageInfo radiance{VK_FORMAT_R16G16B16A16_SFLOAT, uvec2(resolution), 1, layers, usage,
                                  gpu::ViewKind::cubeArray};
    const gpu::ImageInfo distance{VK_FORMAT_R32_SFLOAT, uvec2(resolution), 1, layers, usage, gpu::ViewKind::cubeArray};
    if (!(radiance_.info() == radiance)) {
        radiance_ = gpu::Texture(device_, radiance, "probe_radiance");
        distance_ = gpu::Texture(device_, distance, "probe_distance");
    }
}

gpu::Image Probes::captureFace(gpu::Frame& f, const ViewInputs& in, const Settings& settings, uint32_t face,
                               gpu::Image lampShadowMap) {
    const auto scope = f.viewScope("probe");
    const vec3& position = block_.probes[face / probeFaces].position;
    ViewInputs seen = in;
    seen.view =
        makeViewParams(cubeFaceCamera(position, face % probeFaces), radiance_.info().size, in.view.frame, in.view.seed);
    seen.environment = vec3(0.0F);
    const ViewImages images = directView(f, seen, captureSettings(settings), lampShadowMap);
    f.compute("capture_probe", "capture_probe.comp")
        .read("depth", images.g.depth)
        .read("direct", images.direct)
        .write("radiance", radiance_.mip(0))
        .write("distance", distance_.mip(0))
        .params(CaptureProbeParams{seen.view, face})
        .dispatch(radiance_.info().size);
    return images.lampShadowMap;
}

// A frame for each probe: one holds only so many passes.
void Probes::captureAll(const ViewInputs& in, const Settings& settings) {
    gpu::Frame f(device_);
    for (uint32_t probe = 0; probe < block_.count; ++probe) {
        f.begin();
        gpu::Image lampShadowMap;
        for (uint32_t face = 0; face < probeFaces; ++face) {
            lampShadowMap = captureFace(f, in, settings, probe * probeFaces + face, lampShadowMap);
        }
        f.submit();
        f.wait();
    }
}

ProbeMaps Probes::update(gpu::Frame& f, const ViewInputs& in, std::span<const Probe> probes, const Settings& settings) {
    if (settings.probes.enabled == 0 || probes.empty()) {
        return {};
    }
    block_ = blockOf(probes);
    std::vector<std::byte> key = keyOf(block_, in, settings);
    const bool changed = key != key_;
    key_ = std::move(key);
    if (changed) {
        makeMaps(settings.probes.resolution);
    }
    if (settings.probes.refresh == ProbeRefresh::face) {
        if (changed) {
            f.clear(radiance_.image());
            f.clear(distance_.image());
            nextFace_ = 0;
        }
        captureFace(f, in, settings, nextFace_);
        nextFace_ = (nextFace_ + 1) % (block_.count * probeFaces);
    } else if (changed) {
        captureAll(in, settings);
    }
    return {radiance_.image(), distance_.image(), block_};
}

}  // namespace reflet
