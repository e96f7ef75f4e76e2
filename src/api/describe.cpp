// What the library understood of a frame, as text: sizes, camera, conventions, formats, and what contradicts itself.
#include "api/calls.h"
#include "api/frame.h"
#include "gpu/listing.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace reflet::api {

namespace {

using Lines = std::vector<std::string>;

std::string formatText(VkFormat format) {
    return gpu::formatName(format);
}

std::string imageText(const RefletImage& image, const char* absent) {
    if (image.image == VK_NULL_HANDLE) {
        return absent;
    }
    std::string text = fmt::format("{} {}x{}", formatText(image.format), image.width, image.height);
    if (image.offset[0] > 0 || image.offset[1] > 0) {
        text += fmt::format(" from ({}, {})", image.offset[0], image.offset[1]);
    }
    if (image.baseLayer > 0) {
        text += fmt::format(", layer {}", image.baseLayer);
    }
    if (image.baseLevel > 0) {
        text += fmt::format(", level {}", image.baseLevel);
    }
    return text;
}

std::string channelText(const RefletImage& image, uint32_t channel, const char* kind, const char* absent) {
    return image.image == VK_NULL_HANDLE ? absent
                                         : fmt::format("{}.{}, {}", formatText(image.format), "rgba"[channel], kind);
}

const char* normalText(RefletNormalKind kind) {
    constexpr const char* names[] = {"octahedral snorm", "octahedral unorm", "vector snorm", "vector unorm"};
    return names[kind];
}

std::string cameraText(const ViewParams& v, const RefletFrameInfo& info, bool perspective) {
    const vec3 eye(v.eye);
    const vec3 ahead(v.viewPlane);
    const auto at = [&](float depth) {
        return (v.depthToDistance.x + v.depthToDistance.y * depth) /
               (v.depthToDistance.z + v.depthToDistance.w * depth);
    };
    const float far = at(0.0F);
    const std::string farText = std::isfinite(far) && far < 1e12F ? fmt::format("{:.4g} m", far) : "infinite";
    const float tall =
        perspective ? glm::degrees(2.0F * std::atan(0.5F * v.pixelAngle * v.size.y)) : v.pixelAngle * v.size.y;
    return fmt::format(
        "camera: {}, {} {:.4g} {} tall, near plane {:.4g} m, far {}; {} ({:.4g}, {:.4g}, {:.4g}), looks along "
        "({:.3f}, {:.3f}, {:.3f}); view space is {}-handed",
        perspective ? "perspective" : "orthographic", perspective ? "field of view" : "", tall,
        perspective ? "degrees" : "m", at(1.0F), farText, perspective ? "at" : "toward", eye.x, eye.y, eye.z, ahead.x,
        ahead.y, ahead.z, info.viewToClip[11] < 0.0F ? "right" : "left");
}

// Which of the world's axes is up in the picture, as a direction and its name.
std::string upText(const ViewParams& v) {
    const mat4 rows = glm::transpose(v.worldToClip);
    const vec3 down = glm::normalize(vec3(rows[1]) - glm::dot(vec3(rows[1]), vec3(v.viewPlane)) * vec3(v.viewPlane));
    const vec3 up = -down;
    const int axis = std::abs(up.x) > std::max(std::abs(up.y), std::abs(up.z)) ? 0
                     : std::abs(up.y) > std::abs(up.z)                         ? 1
                                                                               : 2;
    return fmt::format("up in the picture is about {}{} of the world ({:.3f}, {:.3f}, {:.3f})",
                       up[axis] < 0.0F ? '-' : '+', "XYZ"[axis], up.x, up.y, up.z);
}

void describeSurfaces(Lines& lines, const RefletGBuffer& g) {
    constexpr const char* roughnessKinds[] = {"perceptual roughness", "alpha", "smoothness"};
    constexpr const char* motionKinds[] = {"uv", "NDC", "pixels"};
    lines.push_back(fmt::format("depth: {}, {}; back faces: {}", imageText(g.depth, ""),
                                g.depthKind == REFLET_DEPTH_REVERSED ? "reversed" : "standard",
                                imageText(g.backDepth, "absent, thickness is assumed")));
    lines.push_back(fmt::format("normal: {}, {}, {} space; geometric normal: {}", imageText(g.normal, ""),
                                normalText(g.normalKind), g.normalsInViewSpace != 0 ? "view" : "world",
                                imageText(g.geometricNormal, "absent, from depth")));
    const bool f0 = g.f0.image != VK_NULL_HANDLE;
    lines.push_back(
        fmt::format("material: roughness {}; {} {}; base colour {}{}",
                    channelText(g.roughness, g.roughnessChannel, roughnessKinds[g.roughnessKind], "absent, 1"),
                    f0 ? "F0" : "metallic",
                    f0 ? imageText(g.f0, "") : channelText(g.metallic, g.metallicChannel, "0 to 1", "absent, 0"),
                    imageText(g.baseColor, "absent, 0.5"),
                    g.baseColor.image == VK_NULL_HANDLE    ? ""
                    : g.baseColorKind == REFLET_COLOR_SRGB ? ", sRGB-encoded"
                                                           : ", linear when sampled"));
    const vec2 scale =
        g.motionScale[0] == 0.0F && g.motionScale[1] == 0.0F ? vec2(1.0F) : vec2(g.motionScale[0], g.motionScale[1]);
    lines.push_back(g.motion.image == VK_NULL_HANDLE
                        ? "motion: absent, that of the camera alone"
                        : fmt::format("motion: {}, {}, times ({:g}, {:g}), {} jitter", imageText(g.motion, ""),
                                      motionKinds[g.motionKind], scale.x, scale.y,
                                      g.motionIncludesJitter != 0 ? "with" : "without"));
    lines.back() += fmt::format("; masks: excluded {}, unlit {}, reactive {}",
                                channelText(g.excluded, g.excludedChannel, "0 to 1", "none"),
                                channelText(g.unlit, g.unlitChannel, "0 to 1", "none"),
                                channelText(g.reactive, g.reactiveChannel, "0 to 1", "none"));
}

std::string displayText(const Frame& frame) {
    if (!frame.display) {
        return "none so far";
    }
    constexpr const char* names[] = {"sRGB", "scRGB", "PQ"};
    const DisplayTarget& on = *frame.shownOn;
    std::string text = fmt::format("{}, {}", names[on.transfer], formatText(frame.display.format));
    if (on.transfer != transferSrgb) {
        text += fmt::format(", white {:g} nits, peak {:g} nits", on.paperWhite, on.peakNits);
    }
    return on.image ? text + ", in the host's image" : text;
}

bool isPqInBytes(const Frame& frame) {
    return frame.display && frame.shownOn->transfer == transferPq &&
           formatText(frame.display.format).find("8") == 1;  // R8…, B8…
}

bool isSnorm(VkFormat format) {
    const std::string name = formatText(format);
    return name.find("SNORM") != std::string::npos;
}
bool isUnorm(VkFormat format) {
    return formatText(format).find("UNORM") != std::string::npos;
}

// What can hardly be meant.
Lines contradictions(const Described& d, const ViewParams& v, const Frame& frame) {
    const RefletFrameInfo& info = d.info;
    const RefletGBuffer& g = d.gbuffer;
    const bool first = std::ranges::all_of(info.previousViewToClip, [](float value) { return value == 0.0F; });
    const bool moved = !first && std::memcmp(info.worldToView, info.previousWorldToView, sizeof info.worldToView) != 0;
    const bool snormKind = g.normalKind == REFLET_NORMAL_OCTAHEDRAL_SNORM || g.normalKind == REFLET_NORMAL_VECTOR_SNORM;
    const std::pair<bool, const char*> rules[] = {
        {snormKind && isUnorm(g.normal.format), "normalKind is a snorm one, and the format has no negative values"},
        {!snormKind && isSnorm(g.normal.format), "normalKind is a unorm one, and the format is snorm"},
        {g.baseColorKind == REFLET_COLOR_SRGB && formatText(g.baseColor.format).find("SRGB") != std::string::npos,
         "baseColorKind is REFLET_COLOR_SRGB, and the format decodes sRGB already"},
        {g.baseColorKind == REFLET_COLOR_SRGB && formatText(g.baseColor.format).find("FLOAT") != std::string::npos,
         "baseColorKind is REFLET_COLOR_SRGB, and the format is a float one"},
        {g.roughness.image != VK_NULL_HANDLE && g.roughness.image == g.metallic.image &&
             g.roughness.view == g.metallic.view && g.roughnessChannel == g.metallicChannel,
         "roughness and metallic are the same channel"},
        {info.restFrames > 0 && moved, "restFrames is above 0, and the camera has moved"},
        {d.frames > 0 && first, "the previous matrices are zero: motion of the camera is unknown"},
        {d.frames > 0 && info.frameIndex == d.lastIndex, "frameIndex is that of the last frame: noise does not settle"},
        {d.frames > 0 && info.jitter[0] == 0.0F && info.jitter[1] == 0.0F && v.size != vec2(d.outputSize),
         "there is no jitter, which temporal upscaling needs"},
        {d.frames > 0 && (info.previousJitter[0] != d.lastJitter[0] || info.previousJitter[1] != d.lastJitter[1]),
         "previousJitter is not the jitter of the last frame"},
        {isPqInBytes(frame), "PQ in 8 bits shows bands: use A2B10G10R10_UNORM_PACK32 or R16G16B16A16_SFLOAT"}};
    Lines found;
    for (const auto& [holds, text] : rules) {
        if (holds) {
            found.emplace_back(text);
        }
    }
    return found;
}

std::string describe(const RefletView_T& view) {
    const Described& d = *view.described;
    const RefletFrameInfo& info = d.info;
    const Frame& frame = view.frame ? *view.frame : *view.last;
    const ViewParams& v = frame.context.view;
    const bool perspective = v.eye.w != 0.0F;
    Lines lines;
    lines.push_back(fmt::format("view: {}x{}{}, output {}x{}, frame {} of {} recorded, at rest for {}; Reflet {}.{}.{}",
                                view.size.x, view.size.y,
                                frame.inLarger ? fmt::format(", this frame {}x{}", frame.size.x, frame.size.y) : "",
                                d.outputSize.x, d.outputSize.y, info.frameIndex, d.frames + 1, info.restFrames,
                                REFLET_VERSION_MAJOR, REFLET_VERSION_MINOR, REFLET_VERSION_PATCH));
    lines.push_back(cameraText(v, info, perspective));
    lines.push_back(fmt::format("clip space: y {}, depth {} to 1; {}", info.clipYUp != 0 ? "up" : "down",
                                info.clipDepthFromMinusOne != 0 ? "-1" : "0", upText(v)));
    lines.push_back(fmt::format("jitter: ({:.3f}, {:.3f}) pixels right and down, ({:.3f}, {:.3f}) before",
                                info.jitter[0], info.jitter[1], info.previousJitter[0], info.previousJitter[1]));
    describeSurfaces(lines, d.gbuffer);
    lines.push_back(fmt::format("pre-exposure: {:g}, {:g} before; display: {}", frame.preExposure,
                                d.frames > 0 ? d.lastPreExposure : frame.preExposure, displayText(frame)));
    const std::pair<bool, const char*> effects[] = {{bool(frame.sunVisibility), "sun shadow"},
                                                    {bool(frame.lampVisibility), "lamp shadows"},
                                                    {bool(frame.ambientOcclusion), "ambient occlusion"},
                                                    {frame.diffuse.has_value(), "diffuse lobe"},
                                                    {frame.specular.has_value(), "specular lobe"},
                                                    {bool(frame.composed), "composite"},
                                                    {bool(frame.antialiased), "temporal"},
                                                    {bool(frame.defocused), "depth of field"},
                                                    {bool(frame.blurred), "motion blur"},
                                                    {bool(frame.display), "tone map"}};
    Lines ran;
    for (const auto& [there, name] : effects) {
        if (there) {
            ran.emplace_back(name);
        }
    }
    lines.push_back(fmt::format("effects so far: {}; {:.1f} MB of device memory",
                                ran.empty() ? std::string("none") : fmt::format("{}", fmt::join(ran, ", ")),
                                static_cast<double>(view.owner.gpu->memory().read(view.memory)) * 1e-6));
    lines.push_back(fmt::format("light of the host: {} probes, {} planar views, {} image for rays without a hit",
                                frame.probes, frame.planarViews, frame.hasFallback ? "an" : "no"));
    const Lines wrong = contradictions(d, v, frame);
    lines.push_back(fmt::format("contradictions: {}",
                                wrong.empty() ? std::string("none found") : fmt::format("{}", fmt::join(wrong, "; "))));
    return fmt::format("{}\n", fmt::join(lines, "\n"));
}

}  // namespace

void noteContradictions(RefletView_T& view) {
    constexpr uint64_t firstFrames = 16;  // later frames are like these
    if (view.owner.log == nullptr || !view.described || view.described->frames >= firstFrames) {
        return;
    }
    Lines fresh = contradictions(*view.described, view.frame->context.view, *view.frame);
    std::erase_if(fresh, [&](const std::string& text) {
        return std::ranges::find(view.contradictions, text) != view.contradictions.end();
    });
    if (!fresh.empty()) {
        view.note = fmt::format("contradictions: {}", fmt::join(fresh, "; "));
        view.contradictions.insert(view.contradictions.end(), fresh.begin(), fresh.end());
    }
}

}  // namespace reflet::api

using namespace reflet;
using namespace reflet::api;

RefletResult refletDescribe(RefletView view, size_t* size, char* text) {
    return onView(view, [&] {
        if (size == nullptr) {
            failArgument("size: is NULL");
        }
        if (!view->described || !(view->frame || view->last)) {
            failArgument("view: no frame has been recorded yet");
        }
        const std::string told = describe(*view);
        if (text != nullptr && *size > 0) {
            const size_t fits = std::min(*size - 1, told.size());
            std::copy_n(told.begin(), fits, text);
            text[fits] = '\0';
        }
        *size = told.size() + 1;
    });
}
